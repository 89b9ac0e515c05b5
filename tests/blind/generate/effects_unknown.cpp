#include <cmath>

#include "effect_parts.hpp"

namespace blind {
namespace {

using Made = std::unique_ptr<Effect>;

// An overhanging part of the feed axis, shaken by the unbalance of the spindle.
Made feed_resonance(Random& random, const Machine& m) {
  const double natural = 6.2832 * random.uniform(12.0, 60.0), reference = m.working_speed();
  return dynamic<2>(
      [=](const Point& p, double, const double* z, double* dz) {
        const double shake =
            std::pow(p.w / reference, 2) * std::cos(p.angle) + 0.02 * p.feed_rate + p.v / 0.1;
        dz[0] = z[1];
        dz[1] = natural * natural * (shake - z[0]) - 0.06 * natural * z[1];
      },
      [](const Point&, double s, const double* z, Loads& l) { l.force_n += s * z[0]; });
}

Made place_friction(Random&, const Machine&) {
  return instant([](const Point& p, double s, Loads& l) { l.force_n -= s * (p.x / 0.05) * (p.v / 0.1); });
}

Made current_hysteresis(Random& random, const Machine& m) {
  const double reach = m.working_current() * random.uniform(0.5, 1.0);
  return dynamic<1>(
      [reach](const Point& p, double, const double* z, double* dz) {
        dz[0] =
            (p.current_rate - 0.6 * std::abs(p.current_rate) * z[0] - 0.4 * p.current_rate * std::abs(z[0])) /
            reach;
      },
      [](const Point&, double s, const double* z, Loads& l) { l.torque_nm -= s * z[0]; });
}

Made subharmonic(Random& random, const Machine&) {
  const double phase = random.uniform(0.0, 6.28);
  return instant(
      [phase](const Point& p, double s, Loads& l) { l.torque_nm += s * std::sin(0.37 * p.angle + phase); });
}

Made feed_coupling(Random&, const Machine& m) {
  const double reference = m.working_speed();
  return instant([reference](const Point& p, double s, Loads& l) {
    l.torque_nm -= s * (p.v / 0.1) * (p.w / reference);
  });
}

Made speed_square_voltage(Random&, const Machine& m) {
  const double reference = m.working_speed(), current = 0.1 * m.working_current();
  return instant([=](const Point& p, double s, Loads& l) {
    l.voltage_v -= s * std::pow(p.w / reference, 2) * soft_sign(p.i, current);
  });
}

Made periodic_in_time(Random& random, const Machine&) {
  const double phase = random.uniform(0.0, 6.28);
  return instant([phase](const Point& p, double s, Loads& l) {
    l.torque_nm += s * std::tanh(2.0 * std::sin(6.2832 * 7.3 * p.t + phase));
  });
}

Made bump_in_the_way(Random& random, const Machine&) {
  const double place = random.uniform(-0.03, 0.03), width = random.uniform(0.006, 0.015);
  return instant([=](const Point& p, double s, Loads& l) {
    l.force_n -= 2.0 * s * std::exp(-std::pow((p.x - place) / width, 2));
  });
}

Made place_inertia(Random& random, const Machine&) {
  const double phase = random.uniform(0.0, 6.28);
  return instant(
      [phase](const Point& p, double s, Loads& l) { l.mass *= 1.0 + s * std::sin(p.x / 0.02 + phase); });
}

Made contact_memory(Random& random, const Machine&) {
  const double memory_s = random.uniform(0.05, 0.15);
  return dynamic<1>([memory_s](const Point& p, double, const double* z,
                               double* dz) { dz[0] = (p.in.contact - z[0]) / memory_s; },
                    [](const Point& p, double s, const double* z, Loads& l) {
                      l.torque_nm -= s * z[0] * (1.0 - z[0]) * 4.0 * std::tanh(p.w);
                    });
}

Made feed_crosstalk(Random&, const Machine&) {
  return instant([](const Point& p, double s, Loads& l) { l.voltage_v += s * p.v * std::abs(p.v) / 0.01; });
}

Made swinging_load(Random& random, const Machine&) {
  const double natural = 6.2832 * random.uniform(3.0, 9.0);
  return dynamic<2>(
      [natural](const Point& p, double, const double* z, double* dz) {
        dz[0] = z[1];
        dz[1] = natural * natural * (p.v / 0.1 - z[0] - 0.3 * z[0] * z[0] * z[0]) - 0.1 * natural * z[1];
      },
      [](const Point&, double s, const double* z, Loads& l) { l.force_n -= s * z[0]; });
}

}  // namespace

const std::vector<EffectKind>& unknown_structures() {
  static const auto mass_guess = [](const Machine&) { return 0.1; };
  static const std::vector<EffectKind> kinds = {
      {"feed_resonance", kFeedForce, "N", force_scale, feed_resonance},
      {"place_friction", kFeedForce, "N", force_scale, place_friction},
      {"current_hysteresis", kSpindleTorque, "N m", torque_scale, current_hysteresis},
      {"subharmonic_torque", kSpindleTorque, "N m", torque_scale, subharmonic},
      {"feed_spindle_coupling", kSpindleTorque, "N m", torque_scale, feed_coupling},
      {"speed_square_voltage", kArmatureVoltage, "V", voltage_scale, speed_square_voltage},
      {"periodic_in_time", kSpindleTorque, "N m", torque_scale, periodic_in_time},
      {"bump_in_the_way", kFeedForce, "N", force_scale, bump_in_the_way},
      {"place_dependent_mass", kFeedForce, "1", mass_guess, place_inertia, 8.0},
      {"contact_memory", kSpindleTorque, "N m", torque_scale, contact_memory},
      {"feed_voltage_crosstalk", kArmatureVoltage, "V", voltage_scale, feed_crosstalk},
      {"swinging_load", kFeedForce, "N", force_scale, swinging_load},
  };
  return kinds;
}

}  // namespace blind
