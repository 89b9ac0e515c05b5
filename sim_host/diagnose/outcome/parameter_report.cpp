#include "sim_host/diagnose/outcome/parameter_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/gap_watch_finding.hpp"

namespace morepro::host {
namespace {

constexpr const char* kWithOffset =
    "only together with contact_offset_n, which is taken for the datasheet's; it needs different engagements";

// Torque constant, friction and inertia have one common factor, which nothing but the contact torque fixes.
constexpr const char* kGivenContact = "as far as the contact torque of the machine file is right";
constexpr const char* kWithoutContact =
    "without a contact nothing but the effects in the model fixes the common factor of torque, friction and "
    "inertia";
constexpr const char* kOneFactor =
    "torque, friction and inertia have one common factor until a known contact load fixes it";
constexpr const char* kNeedsVoltage = "it needs the armature voltage, which is not recorded";
constexpr const char* kBent = "what the model leaves of the gap may have bent it";
constexpr const char* kOfAnotherShape = "another shape of a law in the model would change it";
constexpr double kOneMotor = 0.05;  // by which the two constants of a motor may differ

struct Named {
  const char* name;
  double datasheet;
  double refit;
  const char* advice;
};

std::vector<Named> named(const AxisFit& fit) {
  const auto& s = fit.model().machine.spindle;
  const auto& s0 = fit.datasheet().machine.spindle;
  const auto& f = fit.model().machine.feed;
  const auto& f0 = fit.datasheet().machine.feed;
  if (fit.axis() == Axis::kSpindle)
    return {
        {"torque_constant_nm_a", s0.torque_constant_nm_a, s.torque_constant_nm_a, kOneFactor},
        {"viscous_friction_nms_rad", s0.viscous_friction_nms_rad, s.viscous_friction_nms_rad,
         "it needs different speeds without contact"},
        {"inertia_kgm2", s0.inertia_kgm2, s.inertia_kgm2, "it needs accelerations and a known contact load"},
        {"resistance_ohm", s0.resistance_ohm, s.resistance_ohm,
         "it needs currents that vary apart from the speed, such as contact on and off"},
        {"back_emf_constant_vs_rad", s0.back_emf_constant_vs_rad, s.back_emf_constant_vs_rad,
         "it needs speeds that vary apart from the current"},
        {"inductance_h", s0.inductance_h, s.inductance_h,
         "it needs steps of the voltage, sampled within L/R"}};
  return {{"mass_kg", f0.mass_kg, f.mass_kg, "it needs accelerations of the axis"},
          {"viscous_friction_ns_m", f0.viscous_friction_ns_m, f.viscous_friction_ns_m,
           "it needs different feed speeds"},
          {"contact_force_n", f0.contact_force_n, f.contact_force_n, "it needs contact on and off"}};
}

bool is_electric(const AxisFit& fit, std::size_t index) {
  return fit.axis() == Axis::kSpindle && index >= static_cast<std::size_t>(kTorqueParameters);
}

/// Part of a balance that cannot be judged.
bool is_unseen(const AxisFit& fit, std::size_t index) {
  return fit.signals().is_current_driven && is_electric(fit, index);
}

/// Of one number per parameter column, those of a load in N and all others relative: a value's.
double of_value(const AxisFit& fit, const Eigen::VectorXd& columns, std::size_t index, double refit) {
  if (static_cast<Eigen::Index>(index) >= columns.size()) return 0.0;
  const bool is_load = fit.axis() == Axis::kFeed && index == 2;
  if (is_load) return columns(fit.tells_engaged_load() ? 3 : 2);
  return columns(static_cast<Eigen::Index>(index)) * std::fabs(refit);
}

double standard_error_of(const AxisFit& fit, std::size_t index, double refit) {
  const double error = of_value(fit, fit.standard_error(), index, refit);
  const bool is_unknown = is_unseen(fit, index) || !std::isfinite(error);
  return is_unknown ? gap::kDatasheetSpread * std::fabs(refit) : error;
}

/// Does it act on what the balance of this value shows?
bool is_beside(gap::Effect effect, const AxisFit& fit, std::size_t index) {
  const bool has_one_balance = fit.axis() == Axis::kFeed || !fit.signals().has_electrics();
  if (has_one_balance || gap::is_in_sensor(effect)) return true;
  const auto acted_on = static_cast<gap::Balance>(gap::info_of(effect).group);
  return (acted_on == gap::Balance::kArmatureVoltage) == is_electric(fit, index);
}

/// Standard error by what the model lacks: what other shapes of its laws and wrong sizes take of a value
/// along, and what lies in its own direction of what is left, as much as in any other.
double error_by_model(const AxisFit& fit, const ShapeErrors& by_shape, const UnnamedError& unnamed,
                      std::size_t index, double refit) {
  if (is_unseen(fit, index)) return 0.0;
  double along = of_value(fit, by_shape.of_value, index, refit);
  double noises = is_electric(fit, index) ? unnamed.of_voltage : unnamed.of_motion;
  for (const ShapeError& error : by_shape.of_effect) {
    along =
        std::hypot(along, error.of_size * of_value(fit, fit.parameters_along(error.effect), index, refit));
    if (is_beside(error.effect, fit, index)) noises = std::max(noises, error.of_noise);
  }
  const double most = gap::kDatasheetSpread * std::fabs(refit);
  const double error = std::hypot(along, noises * standard_error_of(fit, index, refit));
  return error < most ? error : most;
}

/// What a value that the recording tells rests on beside the recording.
std::string assumption_of(const AxisFit& fit, std::size_t index) {
  if (fit.axis() == Axis::kFeed) return index == 2 && !fit.tells_engaged_load() ? kWithOffset : "";
  if (is_electric(fit, index)) return "";
  if (!fit.signals().has_been_in_contact()) return kWithoutContact;
  if (!fit.signals().has_electrics()) return kGivenContact;
  const auto& s = fit.model().machine.spindle;
  const double ratio = s.torque_constant_nm_a / s.back_emf_constant_vs_rad;
  const bool is_one_motor = std::fabs(ratio - 1.0) < kOneMotor;
  if (index > 0 || is_one_motor) return kGivenContact;
  return fmt::format("{}: it is {:.3g} times the back-EMF constant, and of one motor both are the same",
                     kGivenContact, ratio);
}

/// What would tell a value that the recording does not tell.
std::string advice_for(const AxisFit& fit, std::size_t index, const Named& value) {
  const bool is_torque = fit.axis() == Axis::kSpindle && !is_electric(fit, index);
  return is_torque && !fit.signals().has_been_in_contact() ? kOneFactor : value.advice;
}

}  // namespace

std::vector<ParameterResult> parameters_of(const AxisFit& fit, const ShapeErrors& by_shape,
                                           const UnnamedError& unnamed) {
  std::vector<ParameterResult> results;
  const auto all = named(fit);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double by_noise = standard_error_of(fit, i, all[i].refit);
    const double error = std::hypot(by_noise, error_by_model(fit, by_shape, unnamed, i, all[i].refit));
    const double most = kTold * std::fabs(all[i].refit);
    const std::string reason = is_unseen(fit, i) ? kNeedsVoltage
                               : error < most    ? assumption_of(fit, i)
                               : of_value(fit, by_shape.of_value, i, all[i].refit) > most ? kOfAnotherShape
                               : by_noise < most                                          ? kBent
                                                 : advice_for(fit, i, all[i]);
    results.push_back({all[i].name, all[i].datasheet, all[i].refit, error, error < most, reason});
  }
  return results;
}

double spread_of(const AxisFit& fit) {
  constexpr double kDrift = 0.005;
  double sum = 0.0;
  const auto all = named(fit);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double value = std::fabs(all[i].refit);
    const double error = value > 0.0 ? standard_error_of(fit, i, value) / value : 0.0;
    const bool is_fitted = error > 0.0;
    sum += std::log(is_fitted ? std::min(error, gap::kDatasheetSpread) : gap::kDatasheetSpread);
  }
  return std::max(kDrift, std::exp(sum / static_cast<double>(all.size())));
}

bool is_excited(const AxisFit& fit) {
  return fit.known_directions() >= (fit.axis() == Axis::kSpindle ? 2 : 1);
}

}  // namespace morepro::host
