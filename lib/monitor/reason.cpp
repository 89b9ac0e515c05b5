#include "lib/monitor/reason.hpp"

#include <array>

#include "lib/monitor/configuration_error.hpp"

namespace morepro {
namespace {

constexpr std::array kTexts{
    ReasonText{ReasonCode::kNone, "NONE", "Nothing to say.", "", ""},
    ReasonText{ReasonCode::kSensorMissing, "SENSOR_MISSING",
               "A signal that the judgement of the tool needs is not there.",
               "Armature voltage, contact, spindle speed or armature current is not recorded, or a sensor "
               "went silent.",
               "Connect or record the missing sensor."},
    ReasonText{ReasonCode::kSensorStuck, "SENSOR_STUCK", "A sensor that used to change repeats one value.",
               "A frozen converter or a broken line.",
               "Check the sensor's cable and supply, then restart the board."},
    ReasonText{ReasonCode::kSensorNotFinite, "SENSOR_NOT_FINITE", "A sensor gives no numbers.",
               "A failed conversion or a corrupted driver.", "Check the driver of the sensor's input."},
    ReasonText{
        ReasonCode::kSensorOutOfRange, "SENSOR_OUT_OF_RANGE", "A sensor gives values that it cannot measure.",
        "A wrong scale, a short circuit or a saturated input.", "Check scale and wiring of the sensor."},
    ReasonText{ReasonCode::kSensorJump, "SENSOR_JUMP", "A sensor jumps away from what the machine can do.",
               "Interference, a loose contact or a failing sensor.",
               "Check shielding and connectors of the sensor."},
    ReasonText{ReasonCode::kModelResidual, "MODEL_RESIDUAL", "The spindle does not behave as its model says.",
               "Datasheet values that are wrong, or an effect that the model does not have.",
               "Compare the identified parameters with the datasheet, then diagnose the recording."},
    ReasonText{ReasonCode::kModelFeedResidual, "MODEL_FEED_RESIDUAL",
               "The feed axis does not behave as its model says.",
               "Datasheet values that are wrong, or friction that the model does not have.",
               "Compare the identified parameters with the datasheet, then diagnose the recording."},
    ReasonText{ReasonCode::kModelOutsideLaw, "MODEL_OUTSIDE_LAW",
               "The cut is outside of the contact law's range.",
               "Cutting speed or feed beyond what the law was fitted to.",
               "Cut within the range, or give the machine another law."},
    ReasonText{ReasonCode::kModelEffect, "MODEL_EFFECT",
               "The machine has an effect that its model does not have.",
               "The effect that is named with the gap, or an alias of it.",
               "Diagnose a recording of the machine: it says how large the effect is."},
    ReasonText{ReasonCode::kModelUnexplained, "MODEL_UNEXPLAINED",
               "The machine differs from its model by more than its noise, and no known effect explains it.",
               "An effect that the board does not know, or a machine that is more random than it was told.",
               "Diagnose a recording and write what it finds to the machine file."},
    ReasonText{ReasonCode::kWearNoContact, "WEAR_NO_CONTACT",
               "The tool does not cut, so nothing is known of its wear.", "Idle, or cutting air.",
               "Judge during a cut."},
    ReasonText{ReasonCode::kWearSettling, "WEAR_SETTLING", "The cut is too young for a judgement.",
               "Contact or commanded chip load changed a moment ago.",
               "Wait for some tens of milliseconds of cutting."},
    ReasonText{ReasonCode::kWearAsCommanded, "WEAR_AS_COMMANDED",
               "The tool needs the torque that its chip load should need.", "A sharp tool.",
               "Nothing to do."},
    ReasonText{ReasonCode::kWearLoadRaised, "WEAR_LOAD_RAISED",
               "The tool needs clearly more torque than its commanded chip load.",
               "The edge is getting blunt.", "Plan a tool change and watch the trend."},
    ReasonText{ReasonCode::kWearLoadHigh, "WEAR_LOAD_HIGH",
               "The tool needed far more torque than its commanded chip load.", "The edge is worn.",
               "Change the tool, then tell the monitor so."},
    ReasonText{ReasonCode::kWearNoReference, "WEAR_NO_REFERENCE",
               "The chip load is above the machine's nominal one.",
               "Wear, or a programmed change: the commanded chip load is not recorded.",
               "Record chip_load_mm to tell them apart."},
    ReasonText{ReasonCode::kWearLoadLow, "WEAR_LOAD_LOW",
               "The tool needs clearly less torque than its commanded chip load.",
               "A broken tooth, a part that is not where it should be, or a wrong command.",
               "Inspect tool and clamping."},
};

struct RefusalText {
  ConfigurationError error;
  std::string_view sentence;
};

constexpr std::array kRefusals{
    RefusalText{ConfigurationError::kNone, "accepted"},
    RefusalText{ConfigurationError::kNotFinite, "the value is not a finite number"},
    RefusalText{ConfigurationError::kNotPositive, "the value must be greater than 0"},
    RefusalText{ConfigurationError::kNegative, "the value is below the least one possible"},
    RefusalText{ConfigurationError::kSamplingRate, "the sampling rate must be between 100 and 20000 Hz"},
    RefusalText{ConfigurationError::kHypothesisCount,
                "the bank does not hold so many hypotheses; give at least 1 and at most its size"},
    RefusalText{ConfigurationError::kHypothesisOutsideLaw,
                "a chip load is outside of the contact law's range: teeth times chip load must be 0.08 to "
                "0.47 mm per revolution"},
    RefusalText{ConfigurationError::kThermalRange,
                "the melting temperature must be above the reference temperature"},
    RefusalText{ConfigurationError::kMagnitude, "no machine has a value of this magnitude; check its unit"},
    RefusalText{ConfigurationError::kNotAProbability, "the value must lie between 0 and 1, both excluded"},
    RefusalText{ConfigurationError::kEffectCount,
                "a monitor holds at most 4 effects; leave the smallest out"},
    RefusalText{ConfigurationError::kEffectUnknown, "an effect has no name in the catalogue"},
    RefusalText{ConfigurationError::kEffectParts, "an effect has 1 to 4 coefficients"},
    RefusalText{ConfigurationError::kEffectShape,
                "an effect of this name must have a shape greater than 0, and none may have one below"},
    RefusalText{ConfigurationError::kEffectDelay,
                "a monitor holds delays up to 12 sampling intervals; leave this effect out"},
};

}  // namespace

const ReasonText& text_of(ReasonCode code) {
  for (const auto& text : kTexts) {
    if (text.code == code) return text;
  }
  return kTexts[0];
}

std::string_view text_of(ConfigurationError error) {
  for (const auto& text : kRefusals) {
    if (text.error == error) return text.sentence;
  }
  return kRefusals[0].sentence;
}

}  // namespace morepro
