#include <algorithm>
#include <cmath>

#include "effect_parts.hpp"

namespace blind {
namespace {

std::unique_ptr<Effect> tooth_torque(Random& random, const Machine& m) {
  const double teeth = m.teeth, run_out = random.uniform(0.05, 0.25), phase = random.uniform(0.0, 6.28);
  const int sharpness = 1 + random.pick(3);
  return instant([=](const Point& p, double s, Loads& l) {
    const double tooth = pulse(teeth * p.angle + phase, sharpness) * (1.0 + run_out * std::cos(p.angle));
    l.torque_nm -= 2.0 * s * p.in.contact * tooth;
  });
}

std::unique_ptr<Effect> tooth_force(Random& random, const Machine& m) {
  const double teeth = m.teeth, run_out = random.uniform(0.05, 0.25), phase = random.uniform(0.0, 6.28);
  const int sharpness = 1 + random.pick(3);
  return instant([=](const Point& p, double s, Loads& l) {
    const double tooth = pulse(teeth * p.angle + phase, sharpness) * (1.0 + run_out * std::cos(p.angle));
    l.force_n -= 2.0 * s * p.in.contact * tooth;
  });
}

std::unique_ptr<Effect> speed_dependence(Random& random, const Machine& m) {
  const double power = random.uniform(0.6, 1.4), sign = random.sign(), reference = m.working_speed();
  return instant([=](const Point& p, double s, Loads& l) {
    const double change = std::pow(std::abs(p.w) / reference, power) - 0.6;
    l.torque_nm -= sign * s * p.in.contact * change * std::tanh(p.w / p.machine.speed_scale);
  });
}

std::unique_ptr<Effect> chip_dependence(Random& random, const Machine& m) {
  const double power = random.uniform(0.6, 0.85), sign = random.sign(), reference = m.chip_load_mm;
  return instant([=](const Point& p, double s, Loads& l) {
    const double change = std::pow(p.in.chip_load_mm / reference, power) - 1.0;
    l.torque_nm -= sign * s * p.in.contact * change * std::tanh(p.w / p.machine.speed_scale);
  });
}

std::unique_ptr<Effect> temperature_dependence(Random& random, const Machine&) {
  const double power = random.uniform(0.8, 1.5);
  return instant([power](const Point& p, double s, Loads& l) {
    const double change = std::pow(std::max(0.0, p.tool_c - 20.0) / 480.0, power) - 0.6;
    l.torque_nm += s * p.in.contact * change * std::tanh(p.w / p.machine.speed_scale);
  });
}

std::unique_ptr<Effect> wear(Random& random, const Machine&) {
  const double bend = random.uniform(-0.3, 0.4);
  return instant([bend](const Point& p, double s, Loads& l) {
    const double ramp = p.cut_s * (1.0 + bend * p.cut_s / 10.0);
    l.torque_nm -= s * p.in.contact * ramp * std::tanh(p.w / p.machine.speed_scale);
  });
}

std::unique_ptr<Effect> feed_speed_law(Random& random, const Machine& m) {
  const double power = random.uniform(0.6, 1.4), sign = random.sign(), reference = m.working_speed();
  return instant([=](const Point& p, double s, Loads& l) {
    l.force_n -= sign * s * p.in.contact * (std::pow(std::abs(p.w) / reference, power) - 0.6);
  });
}

std::unique_ptr<Effect> feed_drift(Random& random, const Machine&) {
  const double scale_s = random.uniform(2.0, 5.0);
  return instant([scale_s](const Point& p, double s, Loads& l) {
    l.force_n -= s * p.in.contact * (1.0 - std::exp(-p.cut_s / scale_s));
  });
}

}  // namespace

double pulse(double phase, int sharpness) {
  static constexpr double kMean[] = {1.0, 0.5, 0.375, 0.3125};
  return std::pow(0.5 + 0.5 * std::cos(phase), sharpness) - kMean[sharpness];
}

std::vector<EffectKind> cutting_effects() {
  auto wear_guess = [](const Machine& m) { return 0.3 * torque_scale(m); };
  return {
      {"tooth_passing_torque", kSpindleTorque, "N m", torque_scale, tooth_torque},
      {"contact_speed_dependence", kSpindleTorque, "N m", torque_scale, speed_dependence},
      {"contact_chip_load_dependence", kSpindleTorque, "N m", torque_scale, chip_dependence},
      {"contact_temperature_dependence", kSpindleTorque, "N m", torque_scale, temperature_dependence},
      {"tool_wear_ramp", kSpindleTorque, "N m/s", wear_guess, wear},
      {"feed_cutting_speed_dependence", kFeedForce, "N", force_scale, feed_speed_law},
      {"feed_tooth_passing_force", kFeedForce, "N", force_scale, tooth_force},
      {"feed_contact_drift", kFeedForce, "N", force_scale, feed_drift},
  };
}

}  // namespace blind
