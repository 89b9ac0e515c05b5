#include <algorithm>
#include <cmath>

#include "effect_parts.hpp"

namespace blind {
namespace {

std::unique_ptr<Effect> brush_drop(Random& random, const Machine& m) {
  const double scale = m.working_current() * random.uniform(0.03, 0.1);
  return instant([scale](const Point& p, double s, Loads& l) {
    l.voltage_v -= s * std::copysign(1.0 - std::exp(-std::abs(p.i) / scale), p.i);
  });
}

std::unique_ptr<Effect> resistance_drift(Random&, const Machine&) {
  return instant(
      [](const Point& p, double s, Loads& l) { l.resistance *= 1.0 + s * (p.hot_spot_c() - 25.0); });
}

std::unique_ptr<Effect> inductance_saturation(Random& random, const Machine&) {
  const bool is_square = random.chance(0.5);
  return instant([is_square](const Point& p, double s, Loads& l) {
    const double drive = s * p.i * p.i;
    l.inductance *= is_square ? 1.0 / (1.0 + drive) : std::max(0.25, 1.0 - std::tanh(drive));
  });
}

std::unique_ptr<Effect> supply_offset(Random& random, const Machine&) {
  const double sign = random.sign(), ripple = random.uniform(0.0, 0.05), rate = random.uniform(0.3, 1.0);
  return instant([=](const Point& p, double s, Loads& l) {
    l.voltage_v += sign * s * (1.0 + ripple * std::sin(rate * p.t));
  });
}

std::unique_ptr<Effect> drive_lag(Random&, const Machine&) {
  return std::make_unique<Lag>(&Inputs::voltage_v, &Loads::applied_voltage_v);
}

// Less flux: less torque and less back-EMF.
std::unique_ptr<Effect> armature_reaction(Random& random, const Machine& m) {
  const double power = random.uniform(0.9, 1.3), reference = m.working_current();
  return instant([=](const Point& p, double s, Loads& l) {
    const double flux = std::max(0.3, 1.0 - s * reference * std::pow(std::abs(p.i) / reference, power));
    l.back_emf *= flux;
    l.torque_constant *= flux;
  });
}

std::unique_ptr<Effect> magnet_drift(Random&, const Machine&) {
  return instant([](const Point& p, double s, Loads& l) {
    const double flux = std::max(0.3, 1.0 - s * (0.8 * p.slow_heat_k + p.fast_heat_k));
    l.back_emf *= flux;
    l.torque_constant *= flux;
  });
}

}  // namespace

std::vector<EffectKind> voltage_effects() {
  auto copper_guess = [](const Machine&) { return 0.002; };
  auto magnet_guess = [](const Machine&) { return 5e-4; };
  auto saturation_guess = [](const Machine& m) { return 0.01 / std::pow(m.working_current(), 2); };
  auto lag_guess = [](const Machine& m) { return m.is_thesis ? 2e-5 : 5e-5; };
  auto reaction_guess = [](const Machine& m) { return 0.01 / m.working_current(); };
  return {
      {"brush_voltage_drop", kArmatureVoltage, "V", voltage_scale, brush_drop},
      {"resistance_temperature_drift", kArmatureVoltage, "1/K", copper_guess, resistance_drift, 10.0},
      {"inductance_saturation", kArmatureVoltage, "1/A2", saturation_guess, inductance_saturation, 50.0},
      {"supply_voltage_offset", kArmatureVoltage, "V", voltage_scale, supply_offset},
      {"drive_lag", kArmatureVoltage, "s", lag_guess, drive_lag, 40.0, false, false},
      {"armature_reaction", kArmatureVoltage, "1/A", reaction_guess, armature_reaction, 15.0},
      {"magnet_temperature_drift", kArmatureVoltage, "1/K", magnet_guess, magnet_drift, 10.0},
  };
}

}  // namespace blind
