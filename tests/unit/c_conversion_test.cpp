#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "lib/c/configuration_conversion.hpp"
#include "lib/c/health_conversion.hpp"
#include "lib/c/morepro.h"
#include "lib/frame/frame_flag.hpp"
#include "lib/gap/effect_catalogue.hpp"
#include "lib/monitor/configuration_error.hpp"
#include "lib/monitor/reason.hpp"

namespace morepro {
namespace {

// Both declare the same fields in the same order, and all but a few are doubles: what is written to one by
// its place must be in the same place of the other, whatever the conversion by names does in between.
static_assert(sizeof(morepro_configuration) == sizeof(MonitorConfiguration));
constexpr std::size_t kSlots = sizeof(MonitorConfiguration) / sizeof(double);

template <class T>
std::vector<double> slots_of(const T& value) {
  std::vector<double> slots(kSlots);
  std::memcpy(slots.data(), &value, sizeof value);
  return slots;
}

/// Every double has another value; the rest is what a monitor could have.
morepro_configuration numbered() {
  std::vector<double> slots(kSlots);
  for (std::size_t i = 0; i < kSlots; ++i) slots[i] = static_cast<double>(i + 1);
  morepro_configuration c;
  std::memcpy(&c, slots.data(), sizeof c);
  c.machine.contact.form = MOREPRO_CONTACT_THESIS;
  c.grid.count = 7;
  for (std::uint8_t i = 0; i < MOREPRO_MOST_EFFECTS; ++i) {
    auto& effect = c.effects.effect[i];
    effect.effect = static_cast<std::uint8_t>(10 + i);
    effect.kind = static_cast<std::uint8_t>(20 + i);
    effect.parts = static_cast<std::uint8_t>(30 + i);
    effect.shape = static_cast<float>(40 + i);
  }
  c.effects.count = 3;
  for (morepro_gap_limits* limits : {&c.gap.spindle, &c.gap.feed}) {
    const auto first = static_cast<std::uint8_t>(limits == &c.gap.feed ? 10 : 0);
    for (std::uint8_t i = 0; i < MOREPRO_MOST_FORMS; ++i) {
      const auto number = static_cast<std::uint8_t>(first + i);
      limits->forms.form[i] = {number, static_cast<std::uint8_t>(number + 1),
                               static_cast<std::uint8_t>(number + 2), static_cast<float>(number + 3)};
    }
    limits->forms.count = static_cast<std::uint32_t>(first + 4);
  }
  c.rule = MOREPRO_RULE_BAYESIAN;
  return c;
}

bool is_double_in(std::size_t slot) {
  const auto place = [](std::size_t offset) { return offset / sizeof(double); };
  std::set<std::size_t> others{place(offsetof(morepro_configuration, machine.contact.form)),
                               place(offsetof(morepro_configuration, grid.count)),
                               place(offsetof(morepro_configuration, effects.count)),
                               place(offsetof(morepro_configuration, rule))};
  for (std::size_t i = 0; i < MOREPRO_MOST_EFFECTS; ++i)
    others.insert(place(offsetof(morepro_configuration, effects) + i * sizeof(morepro_effect)));
  for (const std::size_t limits :
       {offsetof(morepro_configuration, gap.spindle.forms), offsetof(morepro_configuration, gap.feed.forms)})
    for (std::size_t i = 0; i < sizeof(morepro_gap_limits::forms); i += 4) others.insert(place(limits + i));
  return !others.contains(slot);
}

TEST(CConversion, PutsEveryNumberOfAConfigurationInItsPlace) {
  const morepro_configuration c = numbered();
  const MonitorConfiguration cpp = c::to_cpp(c);
  const auto wanted = slots_of(c);
  const auto got = slots_of(cpp);
  for (std::size_t i = 0; i < kSlots; ++i) {
    if (is_double_in(i)) {
      EXPECT_EQ(got[i], wanted[i]) << "slot " << i;
    }
  }
  EXPECT_EQ(cpp.machine.contact.form, ContactForm::kThesis);
  EXPECT_EQ(cpp.grid.count, 7U);
  EXPECT_EQ(cpp.effects.count, 3U);
  EXPECT_EQ(cpp.rule, DecisionRule::kBayesian);
  for (const unsigned first : {0U, 10U}) {
    const gap::MachineForms& forms = first == 0 ? cpp.gap.spindle.forms : cpp.gap.feed.forms;
    EXPECT_EQ(forms.count, first + 4);
    for (std::uint8_t i = 0; i < MOREPRO_MOST_FORMS; ++i) {
      EXPECT_EQ(gap::index_of(forms.form[i].effect), first + i);
      EXPECT_EQ(forms.form[i].kind, first + i + 1);
      EXPECT_EQ(forms.form[i].parts, first + i + 2);
      EXPECT_EQ(forms.form[i].shape, static_cast<float>(first + i + 3));
    }
  }
  for (std::size_t i = 0; i < MOREPRO_MOST_EFFECTS; ++i) {
    const auto& form = cpp.effects.effect[i].form;
    EXPECT_EQ(gap::index_of(form.effect), 10 + i);
    EXPECT_EQ(form.kind, 20 + i);
    EXPECT_EQ(form.parts, 30 + i);
    EXPECT_EQ(form.shape, static_cast<float>(40 + i));
  }
}

TEST(CConversion, GivesABuiltInConfigurationBackAsItIs) {
  for (const auto& built_in : {reference_configuration(), thesis_configuration()}) {
    const morepro_configuration c = c::to_c(built_in);
    const auto wanted = slots_of(built_in);
    const auto got = slots_of(c);
    const std::size_t effects = offsetof(morepro_configuration, effects) / sizeof(double);
    for (std::size_t i = 0; i < effects; ++i) {
      if (is_double_in(i)) {
        EXPECT_EQ(got[i], wanted[i]) << "slot " << i;
      }
    }
    EXPECT_EQ(c.machine.contact.form, static_cast<std::uint8_t>(built_in.machine.contact.form));
    EXPECT_EQ(c.grid.count, built_in.grid.count);
    EXPECT_EQ(c.effects.count, 0U);
    EXPECT_EQ(c.gap.spindle.forms.count + c.gap.feed.forms.count, 0U);
    EXPECT_EQ(c.rule, static_cast<std::uint8_t>(built_in.rule));
  }
  EXPECT_EQ(morepro_thesis_machine().spindle.torque_constant_nm_a, 1.5);
  EXPECT_EQ(morepro_reference_machine().feed.mass_kg, 3.0);
  EXPECT_EQ(morepro_thesis_configuration().grid.step_mm, 0.1);
  EXPECT_EQ(morepro_reference_configuration().grid.step_mm, 0.01);
}

TEST(CConversion, PutsEveryNumberOfAGapFindingInItsPlace) {
  const gap::GapFinding finding{.verdict = gap::GapVerdict::kEffect,
                                .where = gap::EffectGroup::kFeedForce,
                                .effect = gap::Effect::kFeedSpring,
                                .alias_count = 2,
                                .alias = {gap::Effect::kFeedBacklash, gap::Effect::kFeedPresliding},
                                .confidence = 0.75F,
                                .evidence = 31.0F};
  morepro_gap c{};
  c::copy_gap_finding(finding, c);
  EXPECT_EQ(c.verdict, MOREPRO_GAP_EFFECT);
  EXPECT_EQ(c.where, MOREPRO_FEED_FORCE);
  EXPECT_STREQ(morepro_effect_name(c.effect), "feed_spring");
  EXPECT_EQ(c.alias_count, 2);
  EXPECT_STREQ(morepro_effect_name(c.alias[0]), "feed_backlash");
  EXPECT_STREQ(morepro_effect_name(c.alias[1]), "feed_presliding");
  EXPECT_EQ(c.confidence, 0.75F);
  EXPECT_EQ(c.evidence, 31.0F);
}

TEST(CConversion, NamesEveryEffectAndFindsItAgain) {
  for (const auto& info : gap::kEffects) {
    const int number = morepro_effect_named(info.name.data());
    EXPECT_EQ(number, static_cast<int>(gap::index_of(info.effect)));
    EXPECT_EQ(morepro_effect_name(number), info.name);
  }
  EXPECT_EQ(morepro_effect_named("nothing"), -1);
  EXPECT_EQ(morepro_effect_named(nullptr), -1);
  for (const int number : {-1, 45, 46, 1000}) EXPECT_STREQ(morepro_effect_name(number), "unnamed");
}

TEST(CConversion, EveryErrorHasATextOfItsOwn) {
  std::set<std::string> texts;
  for (int error = MOREPRO_OK; error <= MOREPRO_ERROR_EFFECT_DELAY; ++error) {
    texts.insert(morepro_error_text(error));
    EXPECT_EQ(morepro_error_text(error), text_of(static_cast<ConfigurationError>(error)));
  }
  for (int error = MOREPRO_ERROR_NULL_POINTER; error <= MOREPRO_ERROR_STEP; ++error)
    texts.insert(morepro_error_text(error));
  EXPECT_EQ(texts.size(), 20U);
  for (const int number : {-1, 15, 99, 105})
    EXPECT_STREQ(morepro_error_text(number), "no error has this number");
}

TEST(CConversion, ReasonsHaveTheirTexts) {
  const morepro_reason stuck = morepro_reason_of(202);
  EXPECT_STREQ(stuck.name, "SENSOR_STUCK");
  EXPECT_EQ(stuck.sentence, text_of(ReasonCode::kSensorStuck).sentence);
  EXPECT_EQ(stuck.cause, text_of(ReasonCode::kSensorStuck).cause);
  EXPECT_EQ(stuck.next_step, text_of(ReasonCode::kSensorStuck).next_step);
  EXPECT_STREQ(morepro_reason_of(9999).name, "NONE");
}

// The numbers of C are those of C++.
template <class E>
constexpr int number(E value) {
  return static_cast<int>(value);
}
static_assert(MOREPRO_CONTACT_CONSISTENT == number(ContactForm::kConsistent));
static_assert(MOREPRO_ARMATURE_VOLTAGE_V == number(Channel::kArmatureVoltage));
static_assert(MOREPRO_FEED_FORCE_N == number(Channel::kFeedForce));
static_assert(MOREPRO_CONTACT == number(Channel::kContact));
static_assert(MOREPRO_ENGAGEMENT == number(Channel::kEngagement));
static_assert(MOREPRO_SPINDLE_SPEED_RAD_S == number(Channel::kSpindleSpeed));
static_assert(MOREPRO_SPINDLE_ANGLE_RAD == number(Channel::kSpindleAngle));
static_assert(MOREPRO_FEED_SPEED_M_S == number(Channel::kFeedSpeed));
static_assert(MOREPRO_FEED_POSITION_M == number(Channel::kFeedPosition));
static_assert(MOREPRO_ARMATURE_CURRENT_A == number(Channel::kArmatureCurrent));
static_assert(MOREPRO_TOOL_TEMPERATURE_DEGC == number(Channel::kToolTemperature));
static_assert(MOREPRO_WINDING_TEMPERATURE_DEGC == number(Channel::kWindingTemperature));
static_assert(MOREPRO_CHIP_LOAD_MM == number(Channel::kChipLoad));
static_assert(MOREPRO_SPINDLE_ACCELERATION_RAD_S2 == number(Channel::kSpindleAcceleration));
static_assert(MOREPRO_FEED_ACCELERATION_M_S2 == number(Channel::kFeedAcceleration));
static_assert(MOREPRO_RULE_BAYESIAN == number(DecisionRule::kBayesian));
static_assert(MOREPRO_RULE_THESIS == number(DecisionRule::kThesis));
static_assert(MOREPRO_NOT_ENOUGH_DATA == number(HealthState::kNotEnoughData));
static_assert(MOREPRO_HEALTHY == number(HealthState::kHealthy));
static_assert(MOREPRO_WATCH == number(HealthState::kWatch));
static_assert(MOREPRO_REPLACE == number(HealthState::kReplace));
static_assert(MOREPRO_SENSOR_FAULT == number(HealthState::kSensorFault));
static_assert(MOREPRO_MODEL_GAP == number(HealthState::kModelGap));
static_assert(MOREPRO_FRAME_DUPLICATE == number(FrameFlag::kDuplicate));
static_assert(MOREPRO_FRAME_OLD == number(FrameFlag::kOld));
static_assert(MOREPRO_FRAME_MISSING_BEFORE == number(FrameFlag::kMissingBefore));
static_assert(MOREPRO_FRAME_TIME_JUMP == number(FrameFlag::kTimeJump));
static_assert(MOREPRO_FRAME_NOT_FINITE == number(FrameFlag::kNotFinite));
static_assert(MOREPRO_FRAME_OUT_OF_RANGE == number(FrameFlag::kOutOfRange));
static_assert(MOREPRO_FRAME_INNOVATION_GATE == number(FrameFlag::kInnovationGate));
static_assert(MOREPRO_FRAME_STUCK == number(FrameFlag::kStuck));
static_assert(MOREPRO_FRAME_ESTIMATOR_RESET == number(FrameFlag::kEstimatorReset));
static_assert(MOREPRO_FRAME_SPEED_LOW == number(FrameFlag::kSpeedLow));
static_assert(MOREPRO_FRAME_SPEED_HIGH == number(FrameFlag::kSpeedHigh));
static_assert(MOREPRO_FRAME_NO_INPUT == number(FrameFlag::kNoInput));
static_assert(MOREPRO_FRAME_SEQUENCE_RESET == number(FrameFlag::kSequenceReset));
static_assert(MOREPRO_FRAME_JUMP == number(FrameFlag::kJump));
static_assert(MOREPRO_TORQUE_CONSTANT_NM_A == number(Parameter::kTorqueConstant));
static_assert(MOREPRO_INERTIA_KGM2 == number(Parameter::kInertia));
static_assert(MOREPRO_MASS_KG == number(Parameter::kMass));
static_assert(MOREPRO_CONTACT_FORCE_N == number(Parameter::kContactForce));
static_assert(MOREPRO_INDUCTANCE_H == number(Parameter::kInductance));
static_assert(MOREPRO_RESISTANCE_OHM == number(Parameter::kResistance));
static_assert(MOREPRO_BACK_EMF_CONSTANT_VS_RAD == number(Parameter::kBackEmfConstant));
static_assert(MOREPRO_PARAMETER_NO_SIGNAL == number(ParameterStatus::kNoSignal));
static_assert(MOREPRO_PARAMETER_NO_EXCITATION == number(ParameterStatus::kNoExcitation));
static_assert(MOREPRO_PARAMETER_CORRELATED == number(ParameterStatus::kCorrelated));
static_assert(MOREPRO_PARAMETER_MODEL_MISMATCH == number(ParameterStatus::kModelMismatch));
static_assert(MOREPRO_PARAMETER_SAMPLING_TOO_SLOW == number(ParameterStatus::kSamplingTooSlow));
static_assert(MOREPRO_PARAMETER_IDENTIFIABLE == number(ParameterStatus::kIdentifiable));
static_assert(MOREPRO_PARTNER_CONTACT_OFFSET_N == number(Partner::kContactOffset));
static_assert(MOREPRO_PARTNER_NONE == number(Partner::kNone));
static_assert(MOREPRO_GAP_NOT_ENOUGH_DATA == number(gap::GapVerdict::kNotEnoughData));
static_assert(MOREPRO_GAP_NONE == number(gap::GapVerdict::kNoGap));
static_assert(MOREPRO_GAP_INSUFFICIENT_EXCITATION == number(gap::GapVerdict::kInsufficientExcitation));
static_assert(MOREPRO_GAP_PARAMETER_ERROR == number(gap::GapVerdict::kParameterError));
static_assert(MOREPRO_GAP_UNEXPLAINED == number(gap::GapVerdict::kUnexplained));
static_assert(MOREPRO_GAP_EFFECT == number(gap::GapVerdict::kEffect));
static_assert(MOREPRO_SPINDLE_TORQUE == number(gap::EffectGroup::kSpindleTorque));
static_assert(MOREPRO_FEED_FORCE == number(gap::EffectGroup::kFeedForce));
static_assert(MOREPRO_ARMATURE_VOLTAGE == number(gap::EffectGroup::kArmatureVoltage));
static_assert(MOREPRO_SENSOR == number(gap::EffectGroup::kSensor));
static_assert(MOREPRO_SAMPLING == number(gap::EffectGroup::kSampling));

}  // namespace
}  // namespace morepro
