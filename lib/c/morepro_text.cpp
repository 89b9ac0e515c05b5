#include <array>
#include <cstddef>
#include <string_view>

#include "lib/c/configuration_conversion.hpp"
#include "lib/c/morepro.h"
#include "lib/gap/effect_catalogue.hpp"
#include "lib/monitor/configuration_error.hpp"
#include "lib/monitor/reason.hpp"

namespace {

// Every string_view of the library that comes here is a whole literal, so a zero follows it.

/// Only the names of the catalogue, so that a board need not hold its equations.
constexpr auto kEffectNames = [] {
  std::array<const char*, morepro::gap::kEffectCount> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = morepro::gap::kEffects[i].name.data();
  return names;
}();

}  // namespace

const char* morepro_error_text(morepro_error error) {
  switch (error) {
    case MOREPRO_ERROR_NULL_POINTER:
      return "a pointer is NULL; pass the address of an object";
    case MOREPRO_ERROR_NOT_CREATED:
      return "the memory holds no monitor; call morepro_monitor_create first";
    case MOREPRO_ERROR_MISALIGNED:
      return "the memory does not begin where a monitor can; declare it as a morepro_monitor";
    case MOREPRO_ERROR_UNKNOWN_CHOICE:
      return "a choice has none of its possible values; use a constant of the header";
    case MOREPRO_ERROR_STEP:
      return "a step must be between 0 and 1 s, both excluded";
    default:
      break;
  }
  if (error < MOREPRO_OK || error > MOREPRO_ERROR_EFFECT_DELAY) return "no error has this number";
  return text_of(static_cast<morepro::ConfigurationError>(error)).data();
}

morepro_reason morepro_reason_of(uint16_t reason) {
  const auto& text = text_of(static_cast<morepro::ReasonCode>(reason));
  return {text.name.data(), text.sentence.data(), text.cause.data(), text.next_step.data()};
}

int morepro_effect_named(const char* name) {
  if (name == nullptr) return -1;
  for (std::size_t i = 0; i < kEffectNames.size(); ++i)
    if (std::string_view(kEffectNames[i]) == name) return static_cast<int>(i);
  return -1;
}

const char* morepro_effect_name(int effect) {
  if (effect < 0 || static_cast<std::size_t>(effect) >= kEffectNames.size()) return "unnamed";
  return kEffectNames[static_cast<std::size_t>(effect)];
}

morepro_machine morepro_reference_machine(void) { return morepro::c::to_c(morepro::reference_machine()); }

morepro_machine morepro_thesis_machine(void) { return morepro::c::to_c(morepro::thesis_machine()); }

morepro_configuration morepro_reference_configuration(void) {
  return morepro::c::to_c(morepro::reference_configuration());
}

morepro_configuration morepro_thesis_configuration(void) {
  return morepro::c::to_c(morepro::thesis_configuration());
}
