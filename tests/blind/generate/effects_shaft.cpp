#include <algorithm>
#include <cmath>

#include "effect_parts.hpp"

namespace blind {
namespace {

std::unique_ptr<Effect> coulomb_torque(Random& random, const Machine&) {
  if (random.chance(0.5)) {
    const double scale = random.uniform(1.0, 4.0);
    return instant([scale](const Point& p, double s, Loads& l) { l.torque_nm -= s * soft_sign(p.w, scale); });
  }
  const double bristle_rad = random.uniform(0.05, 0.15);
  return dynamic<1>([bristle_rad](const Point& p, double, const double* z,
                                  double* dz) { dz[0] = (p.w - std::abs(p.w) * z[0]) / bristle_rad; },
                    [](const Point&, double s, const double* z, Loads& l) { l.torque_nm -= s * z[0]; });
}

std::unique_ptr<Effect> stribeck_torque(Random& random, const Machine& m) {
  const double speed = m.working_speed() * random.uniform(0.05, 0.15), power = random.uniform(0.5, 1.5);
  return instant([=](const Point& p, double s, Loads& l) {
    l.torque_nm -= s * soft_sign(p.w, 2.0) * std::exp(-std::pow(std::abs(p.w) / speed, power));
  });
}

std::unique_ptr<Effect> windage(Random& random, const Machine& m) {
  const double power = random.uniform(1.8, 2.2), reference = m.working_speed();
  return instant([=](const Point& p, double s, Loads& l) {
    l.torque_nm -= s * reference * p.w * std::pow(std::abs(p.w) / reference, power - 1.0);
  });
}

std::unique_ptr<Effect> cogging(Random& random, const Machine&) {
  const double order = 5.0 + random.pick(3), phase = random.uniform(0.0, 6.28),
               second = random.uniform(0.1, 0.4);
  return instant([=](const Point& p, double s, Loads& l) {
    const double a = order * p.angle + phase;
    l.torque_nm += s * (std::sin(a) + second * std::sin(2.0 * a + 0.7) + 0.15 * std::sin(3.0 * a + 1.9));
  });
}

std::unique_ptr<Effect> viscous_temperature(Random& random, const Machine&) {
  const double sign = random.sign();
  return instant([sign](const Point& p, double s, Loads& l) {
    l.viscous *= std::exp(std::min(3.0, sign * s * (p.hot_spot_c() - 25.0)));
  });
}

std::unique_ptr<Effect> torque_saturation(Random& random, const Machine&) {
  const bool is_tanh = random.chance(0.5);
  return instant([is_tanh](const Point& p, double s, Loads& l) {
    const double ratio = std::sqrt(3.0 * s) * std::abs(p.i);
    l.torque_constant *= is_tanh && ratio > 1e-6 ? std::tanh(ratio) / ratio : 1.0 / (1.0 + s * p.i * p.i);
  });
}

// The measured speed is the motor's; the cut loads the other end of the shaft.
std::unique_ptr<Effect> compliance(Random& random, const Machine& m) {
  const double far_share = random.uniform(0.3, 0.5), damping = random.uniform(0.02, 0.06);
  const double far = far_share * m.inertia, near = m.inertia - far;
  auto shaft_torque = [=](double w, double s, const double* z) {
    const double stiffness = 1.0 / s;
    return stiffness * z[0] + 2.0 * damping * std::sqrt(stiffness * near * far / (near + far)) * (w - z[1]);
  };
  return dynamic<2>(
      [=](const Point& p, double s, const double* z, double* dz) {
        dz[0] = p.w - z[1];
        dz[1] = (shaft_torque(p.w, s, z) - p.in.contact * p.contact_torque) / far;
      },
      [=](const Point& p, double s, const double* z, Loads& l) {
        l.inertia *= 1.0 - far_share;
        l.shaft_contact = 0.0;
        l.torque_nm -= shaft_torque(p.w, s, z);
      });
}

}  // namespace

double soft_sign(double value, double scale) { return 0.63661977236758 * std::atan(value / scale); }

std::vector<EffectKind> shaft_effects() {
  auto windage_guess = [](const Machine& m) { return torque_scale(m) / std::pow(m.working_speed(), 2); };
  auto relative_guess = [](const Machine&) { return 0.005; };
  auto saturation_guess = [](const Machine& m) { return 0.02 / std::pow(m.working_current(), 2); };
  auto softness_guess = [](const Machine& m) { return 1.0 / (4e6 * m.inertia); };
  return {
      {"spindle_coulomb_friction", kSpindleTorque, "N m", torque_scale, coulomb_torque},
      {"spindle_stribeck_friction", kSpindleTorque, "N m", torque_scale, stribeck_torque},
      {"spindle_windage", kSpindleTorque, "N m s2/rad2", windage_guess, windage},
      {"spindle_cogging", kSpindleTorque, "N m", torque_scale, cogging},
      {"viscous_temperature_dependence", kSpindleTorque, "1/K", relative_guess, viscous_temperature, 10.0},
      {"torque_constant_saturation", kSpindleTorque, "1/A2", saturation_guess, torque_saturation, 50.0},
      {"shaft_compliance", kSpindleTorque, "N m/rad", softness_guess, compliance, 25.0, true, false},
  };
}

}  // namespace blind
