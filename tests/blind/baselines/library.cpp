#include "library.hpp"

#include <cmath>
#include <functional>

namespace blind {
namespace {

using Value = std::function<double(std::size_t)>;

double sign(double value) { return value > 0.0 ? 1.0 : value < 0.0 ? -1.0 : 0.0; }

class Library {
 public:
  explicit Library(const Measured& measured) : m_(measured), c_(measured.columns) {}

  void add(const char* text, const char* effect, const Value& value) {
    Term term{text, effect, {}};
    term.integrated.resize(c_.size() - 1);
    for (std::size_t k = 0; k + 1 < c_.size(); ++k)
      term.integrated[k] = 0.5 * c_.sample_s * (value(k) + value(k + 1));
    terms.push_back(std::move(term));
  }

  void spindle(double teeth) {
    const auto &w = c_.w, &i = c_.i, &cut = c_.contact, angle = spindle_angle();
    add("1", "current_bias", [](std::size_t) { return 1.0; });
    add("sign w", "spindle_coulomb_friction", [&](std::size_t k) { return sign(w[k]); });
    add("w |w|", "spindle_windage", [&](std::size_t k) { return w[k] * std::abs(w[k]); });
    add("w^3", "", [&](std::size_t k) { return w[k] * w[k] * w[k]; });
    add("w^2", "", [&](std::size_t k) { return w[k] * w[k]; });
    add("i^2", "", [&](std::size_t k) { return i[k] * i[k]; });
    add("i |i|", "current_nonlinearity", [&](std::size_t k) { return i[k] * std::abs(i[k]); });
    add("i^3", "torque_constant_saturation", [&](std::size_t k) { return i[k] * i[k] * i[k]; });
    add("w i", "", [&](std::size_t k) { return w[k] * i[k]; });
    add("w Tw", "viscous_temperature_dependence", [&](std::size_t k) { return w[k] * m_.winding_c[k]; });
    add("i Tw", "magnet_temperature_drift", [&](std::size_t k) { return i[k] * m_.winding_c[k]; });
    add("Fc w", "contact_speed_dependence", [&](std::size_t k) { return cut[k] * w[k]; });
    add("Fc sign w CL", "contact_chip_load_dependence",
        [&](std::size_t k) { return cut[k] * sign(w[k]) * c_.chip_load[k]; });
    add("Fc sign w T", "contact_temperature_dependence",
        [&](std::size_t k) { return cut[k] * sign(w[k]) * c_.tool_c[k]; });
    add("Fc sign w t", "tool_wear_ramp", [&](std::size_t k) { return cut[k] * sign(w[k]) * m_.cut_s[k]; });
    for (double order : {5.0, 6.0, 7.0, 8.0}) harmonic("spindle_cogging", order, angle, false);
    harmonic("tooth_passing_torque", teeth, angle, true);
  }

  void feed(double teeth, double pitch) {
    const auto &v = c_.v, &x = m_.x, &w = c_.w, &f = c_.force, &cut = c_.contact, angle = spindle_angle();
    add("1", "feed_force_offset", [](std::size_t) { return 1.0; });
    add("v", "feed_viscous_friction", [&](std::size_t k) { return v[k]; });
    add("sign v", "feed_coulomb_friction", [&](std::size_t k) { return sign(v[k]); });
    add("|v|", "feed_asymmetric_friction", [&](std::size_t k) { return std::abs(v[k]); });
    add("v |v|", "", [&](std::size_t k) { return v[k] * std::abs(v[k]); });
    add("v^3", "", [&](std::size_t k) { return v[k] * v[k] * v[k]; });
    add("x", "feed_spring", [&](std::size_t k) { return x[k]; });
    add("x^2", "", [&](std::size_t k) { return x[k] * x[k]; });
    add("x v", "", [&](std::size_t k) { return x[k] * v[k]; });
    add("F^3", "feed_force_saturation", [&](std::size_t k) { return f[k] * f[k] * f[k]; });
    add("F |F|", "", [&](std::size_t k) { return f[k] * std::abs(f[k]); });
    add("Fc |w|", "feed_cutting_speed_dependence", [&](std::size_t k) { return cut[k] * std::abs(w[k]); });
    add("Fc t", "feed_contact_drift", [&](std::size_t k) { return cut[k] * m_.cut_s[k]; });
    add("Fc T", "", [&](std::size_t k) { return cut[k] * c_.tool_c[k]; });
    std::vector<double> turn(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) turn[k] = pitch > 0.0 ? 6.283185307 * x[k] / pitch : 0.0;
    harmonic("feed_screw_periodic", 1.0, turn, false);
    harmonic("feed_tooth_passing_force", teeth, angle, true);
  }

  void voltage() {
    const auto &w = c_.w, &i = c_.i, &v = c_.voltage;
    add("1", "supply_voltage_offset", [](std::size_t) { return 1.0; });
    add("sign i", "brush_voltage_drop", [&](std::size_t k) { return sign(i[k]); });
    add("i Tw", "resistance_temperature_drift", [&](std::size_t k) { return i[k] * m_.winding_c[k]; });
    add("w Tw", "magnet_temperature_drift", [&](std::size_t k) { return w[k] * m_.winding_c[k]; });
    add("w |i|", "armature_reaction", [&](std::size_t k) { return w[k] * std::abs(i[k]); });
    add("i |i|", "current_nonlinearity", [&](std::size_t k) { return i[k] * std::abs(i[k]); });
    add("i^2", "", [&](std::size_t k) { return i[k] * i[k]; });
    add("i^3", "", [&](std::size_t k) { return i[k] * i[k] * i[k]; });
    add("w i", "", [&](std::size_t k) { return w[k] * i[k]; });
    add("w^2", "", [&](std::size_t k) { return w[k] * w[k]; });
    add("w |w|", "", [&](std::size_t k) { return w[k] * std::abs(w[k]); });
    add("V |V|", "", [&](std::size_t k) { return v[k] * std::abs(v[k]); });
    add("V i^2", "inductance_saturation", [&](std::size_t k) { return v[k] * i[k] * i[k]; });
  }

  std::vector<Term> terms;

 private:
  void harmonic(const char* effect, double order, const std::vector<double>& angle, bool in_contact) {
    auto gate = [this, in_contact](std::size_t k) { return in_contact ? c_.contact[k] : 1.0; };
    add("sin", effect, [&](std::size_t k) { return gate(k) * std::sin(order * angle[k]); });
    add("cos", effect, [&](std::size_t k) { return gate(k) * std::cos(order * angle[k]); });
  }
  std::vector<double> spindle_angle() const {
    std::vector<double> angle(c_.size(), 0.0);
    for (std::size_t k = 1; k < angle.size(); ++k)
      angle[k] = angle[k - 1] + 0.5 * c_.sample_s * (c_.w[k] + c_.w[k - 1]);
    return angle;
  }

  const Measured& m_;
  const Columns& c_;
};

}  // namespace

std::vector<Term> term_library(const Measured& measured, const Machine& machine, Balance balance) {
  Library library(measured);
  if (balance == kSpindleTorque)
    library.spindle(machine.teeth);
  else if (balance == kFeedForce)
    library.feed(machine.teeth, machine.screw_pitch);
  else
    library.voltage();
  return library.terms;
}

}  // namespace blind
