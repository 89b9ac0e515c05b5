#include "sim_host/replay/names.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>

#include "sim_host/machine/setting_key.hpp"

namespace morepro::host {
namespace {

template <std::size_t kCount>
std::string_view at(const std::array<std::string_view, kCount>& names, std::size_t index) {
  return index < kCount ? names[index] : std::string_view("unknown");
}

}  // namespace

std::string_view name_of(HealthState state) {
  constexpr std::array<std::string_view, 6> kNames{"NOT_ENOUGH_DATA", "HEALTHY",      "WATCH",
                                                   "REPLACE",         "SENSOR_FAULT", "MODEL_GAP"};
  return at(kNames, static_cast<std::size_t>(state));
}

std::string_view name_of(DecisionRule rule) { return at(kRuleNames, static_cast<std::size_t>(rule)); }

std::string_view name_of(ChipLoadState state) {
  return state == ChipLoadState::kValid ? "valid" : "undetermined";
}

std::string_view name_of(Parameter parameter) {
  constexpr std::array<std::string_view, kParameterCount> kNames{
      "torque_constant_nm_a",    "inertia_kgm2", "mass_kg",
      "contact_force_n",         "inductance_h", "resistance_ohm",
      "back_emf_constant_vs_rad"};
  return at(kNames, static_cast<std::size_t>(parameter));
}

std::string_view name_of(FrameFlag flag) {
  constexpr std::array<std::string_view, kFrameFlagCount> kNames{
      "duplicate",       "old",   "missing_before",  "time_jump", "not_finite", "out_of_range",
      "innovation_gate", "stuck", "estimator_reset", "speed_low", "speed_high", "no_input",
      "sequence_reset",  "jump"};
  return at(kNames, static_cast<std::size_t>(std::countr_zero(bits_of(flag))));
}

std::string_view name_of(Partner partner) {
  if (partner == Partner::kContactOffset) return "contact_offset_n";
  return is_parameter(partner) ? name_of(static_cast<Parameter>(partner)) : "another parameter";
}

std::string reason_of(const ParameterEstimate& estimate) {
  switch (estimate.status) {
    case ParameterStatus::kNoSignal:
      return "a signal that it needs is not recorded";
    case ParameterStatus::kNoExcitation:
      return "not excited in the frames that may teach it";
    case ParameterStatus::kCorrelated:
      return fmt::format("only a combination with {} is determined", name_of(estimate.partner));
    case ParameterStatus::kModelMismatch:
      return "the model does not fit the recording, so its parameters mean nothing";
    case ParameterStatus::kSamplingTooSlow:
      return "fewer than one sample within L/R; sample faster";
    case ParameterStatus::kIdentifiable:
      return "";
  }
  return "unknown";
}

double datasheet_value(const MachineParameters& machine, Parameter parameter) {
  switch (parameter) {
    case Parameter::kTorqueConstant:
      return machine.spindle.torque_constant_nm_a;
    case Parameter::kInertia:
      return machine.spindle.inertia_kgm2;
    case Parameter::kMass:
      return machine.feed.mass_kg;
    case Parameter::kContactForce:
      return machine.feed.contact_force_n;
    case Parameter::kInductance:
      return machine.spindle.inductance_h;
    case Parameter::kResistance:
      return machine.spindle.resistance_ohm;
    case Parameter::kBackEmfConstant:
      return machine.spindle.back_emf_constant_vs_rad;
  }
  return 0.0;
}

}  // namespace morepro::host
