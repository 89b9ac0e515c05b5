#pragma once
#include <cstdint>
#include <string_view>

namespace morepro {

/// Why a configuration was refused; nothing of it was taken.
enum class ConfigurationError : std::uint8_t {
  kNone = 0,
  kNotFinite = 1,
  kNotPositive = 2,
  kNegative = 3,
  kSamplingRate = 4,
  kHypothesisCount = 5,
  kHypothesisOutsideLaw = 6,
  kThermalRange = 7,
  kNotAProbability = 8,
  kMagnitude = 9,
  kEffectCount = 10,
  kEffectUnknown = 11,
  kEffectParts = 12,
  kEffectShape = 13,
  kEffectDelay = 14,
};

/// The refusal, and the key of the machine file that it is about.
struct ConfigurationResult {
  ConfigurationError error = ConfigurationError::kNone;
  std::string_view key;

  [[nodiscard]] bool ok() const { return error == ConfigurationError::kNone; }
};

/// One sentence: what is wrong and what to do.
std::string_view text_of(ConfigurationError error);

}  // namespace morepro
