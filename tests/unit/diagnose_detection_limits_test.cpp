// What a recording would have shown, and what it cannot show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim_host/diagnose/result/diagnosis_json.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

const host::DetectionLimit* limit_of(const DiagnosisResult& result, Effect effect) {
  const auto found = std::ranges::find(result.not_found, effect, &host::DetectionLimit::effect);
  return found != result.not_found.end() ? &*found : nullptr;
}

DiagnosisResult with(std::vector<gap::AppliedEffect> effects, double process_noise,
                     host::ProfileKind profile = host::ProfileKind::kRich) {
  return diagnosed(record({.effects = std::move(effects),
                           .duration_s = 5.0,
                           .seed = 5,
                           .profile = profile,
                           .process_noise = process_noise}),
                   datasheet(0.1));
}

// A hundredth of the size is a ten-thousandth of the evidence.
TEST(DetectionLimits, AreFromWhereOnAnEffectHasItsName) {
  for (const double process_noise : {0.0, 1.0}) {
    const DiagnosisResult right = with({}, process_noise);
    for (const Effect one : {Effect::kSpindleWindage, Effect::kFeedForceOffset, Effect::kDriveLag}) {
      const auto* limit = limit_of(right, one);
      ASSERT_NE(limit, nullptr) << gap::name_of(one);
      const auto found = with({effect(one, limit->size)}, process_noise);
      EXPECT_TRUE(std::ranges::any_of(found.which, [one](const auto& each) { return names(each, one); }))
          << gap::name_of(one) << ' ' << limit->size << said(found);
      EXPECT_EQ(limit_of(found, one), nullptr) << "it has a size of its own";
      EXPECT_TRUE(with({effect(one, 0.01 * limit->size)}, process_noise).which.empty()) << gap::name_of(one);
    }
  }
}

TEST(DetectionLimits, AreNoneOfWhatARecordingCannotShow) {
  const DiagnosisResult result = with({}, 0.3, host::ProfileKind::kCommissioning);
  const auto* chip_load = limit_of(result, Effect::kContactChipLoadDependence);
  ASSERT_NE(chip_load, nullptr) << "the cut keeps its chip load";
  EXPECT_TRUE(std::isinf(chip_load->size));
  EXPECT_NE(host::diagnosis_json(result).find("\"needs\": \"chip load varied in contact\""),
            std::string::npos);
  EXPECT_NE(host::diagnosis_text(result).find("contact_chip_load_dependence (chip load varied in contact)"),
            std::string::npos);
  EXPECT_EQ(limit_of(result, Effect::kFeedViscousFriction), nullptr) << "a parameter";
  EXPECT_EQ(limit_of(result, Effect::kClockJitter), nullptr) << "no law";
}

// A further name needs a share of the evidence of the strongest one. What the names cannot be told from is
// not "not found".
TEST(DetectionLimits, AreHigherBesideAStrongName) {
  const auto alone = with({}, 0.0);
  const auto beside =
      with({effect(Effect::kBrushVoltageDrop, 3.0), effect(Effect::kFeedCoulombFriction, 5.0)}, 0.0);
  const auto* usual = limit_of(alone, Effect::kInductanceSaturation);
  const auto* higher = limit_of(beside, Effect::kInductanceSaturation);
  ASSERT_TRUE(usual != nullptr && higher != nullptr) << said(beside);
  // 0.08 of an evidence of 100,000, for the 0.02 per row of one that is alone, of other moments: five times.
  EXPECT_GT(higher->size, 4.0 * usual->size);
  for (const host::EffectResult& named : beside.which)
    for (const Effect alias : named.alias_set)
      EXPECT_EQ(limit_of(beside, alias), nullptr) << gap::name_of(alias);
  EXPECT_EQ(limit_of(beside, Effect::kFeedPresliding), nullptr) << "part of a friction";
}

TEST(DetectionLimits, AreNoneOfASensorThatIsNotThere) {
  RecordingSignals signals = record({.duration_s = 3.0, .seed = 5});
  leave_out(signals, Channel::kArmatureCurrent);
  const auto result = diagnosed(signals, datasheet(0.1));
  EXPECT_EQ(limit_of(result, Effect::kCurrentBias), nullptr);
  EXPECT_EQ(limit_of(result, Effect::kResistanceTemperatureDrift), nullptr) << "no winding would show it";
}

TEST(DetectionLimits, AreNotToldWhereSomethingHasNoName) {
  const auto signals = record({.effects = {effect(Effect::kFeedCoulombFriction, 20.0)}, .rate_hz = 5000.0});
  const auto result =
      diagnosed(signals, datasheet(0.1),
                {Effect::kFeedCoulombFriction, Effect::kFeedStribeckFriction, Effect::kFeedPresliding});
  ASSERT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  EXPECT_TRUE(result.not_found.empty());
}

}  // namespace
}  // namespace morepro::diagnose_test
