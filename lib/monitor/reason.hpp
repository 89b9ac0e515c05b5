#pragma once
#include <cstdint>
#include <string_view>

namespace morepro {

/// Why the monitor says what it says. The hundreds are the families: 1 LINK, 2 SENSOR, 3 MODEL, 4 WEAR, 5
/// CONFIG, 6 RUNTIME, 7 IDENT. The numbers are fixed: recordings hold them.
enum class ReasonCode : std::uint16_t {
  kNone = 0,
  kSensorMissing = 201,
  kSensorStuck = 202,
  kSensorNotFinite = 203,
  kSensorOutOfRange = 204,
  kSensorJump = 205,
  kModelResidual = 301,
  kModelFeedResidual = 302,
  kModelOutsideLaw = 303,
  kModelEffect = 304,
  kModelUnexplained = 305,
  kWearNoContact = 401,
  kWearSettling = 402,
  kWearAsCommanded = 403,
  kWearLoadRaised = 404,
  kWearLoadHigh = 405,
  kWearNoReference = 406,
  kWearLoadLow = 407,
};

/// What a reason means to whoever reads it on a screen.
struct ReasonText {
  ReasonCode code;
  std::string_view name;       ///< as in messages, for example SENSOR_STUCK
  std::string_view sentence;   ///< what was seen
  std::string_view cause;      ///< the likely cause
  std::string_view next_step;  ///< what to do first
};

/// The text of a code; the text of kNone for a code that is not known.
const ReasonText& text_of(ReasonCode code);

}  // namespace morepro
