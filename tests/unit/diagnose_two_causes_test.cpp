// Two causes of one axis, of which each hides the other: its size, its beginning, or that it is there at all.
#include <gtest/gtest.h>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

const host::EffectResult* find(const DiagnosisResult& result, Effect effect) {
  for (const auto& found : result.which)
    if (names(found, effect)) return &found;
  return nullptr;
}

// The magnet explained most where the offset was least, from two seconds on; a speed's bias and structure
// without a name made up for the rest.
TEST(TwoCauses, BeginWithTheRecordingWhereOneSeemedToSetIn) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kMagnetTemperatureDrift, 8.0e-4),
                                                    effect(Effect::kSupplyVoltageOffset, 0.5)},
                                        .duration_s = 8.0,
                                        .rate_hz = 5000.0,
                                        .seed = 1,
                                        .process_noise = 1.0}),
                                datasheet(0.0));
  ASSERT_EQ(result.which.size(), 2U) << said(result);
  const auto* magnet = find(result, Effect::kMagnetTemperatureDrift);
  const auto* offset = find(result, Effect::kSupplyVoltageOffset);
  ASSERT_TRUE(magnet != nullptr && offset != nullptr) << said(result);
  // Three standard errors.
  EXPECT_NEAR(magnet->magnitude, 8.0e-4, 3.0 * magnet->standard_error);
  EXPECT_NEAR(offset->magnitude, 0.5, 3.0 * offset->standard_error);
}

// Worth a thirtieth of the sensor's bandwidth, and nothing that another shape of that one would leave: the
// torque had twice its noise left, and the verdict was that the bandwidth explains it all.
TEST(TwoCauses, AreBothNamedWhereOneIsFastAndWorthMuch) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kCurrentBandwidth, 2.8e-4),
                                                    effect(Effect::kSpindleCoulombFriction, 0.0235)},
                                        .duration_s = 16.0,
                                        .rate_hz = 2500.0,
                                        .seed = 13}),
                                datasheet(0.0));
  ASSERT_EQ(result.which.size(), 2U) << said(result);
  ASSERT_NE(find(result, Effect::kCurrentBandwidth), nullptr) << said(result);
  const auto* friction = find(result, Effect::kSpindleCoulombFriction);
  ASSERT_NE(friction, nullptr) << said(result);
  EXPECT_NEAR(friction->magnitude, 0.0235, 3.0 * friction->standard_error);
}

// It might be what the shape of the other one leaves, and both what a cause without a name looks like; as
// strong as the other one it is sure.
TEST(TwoCauses, OfWhichOneIsWeakAreBelievedLess) {
  const auto with_windage = [](double windage_nms2_rad2) {
    return diagnosed(record({.effects = {effect(Effect::kToolWearRamp, 0.05),
                                         effect(Effect::kSpindleWindage, windage_nms2_rad2)},
                             .duration_s = 6.0}),
                     datasheet(0.0));
  };
  const auto weak = with_windage(3.0e-8);
  ASSERT_EQ(weak.which.size(), 2U) << said(weak);
  EXPECT_NEAR(weak.which[0].confidence, 0.7 * 0.98, 0.01) << said(weak);
  EXPECT_NEAR(weak.which[1].confidence, 0.25 * 0.98, 0.01) << said(weak);
  const auto strong = with_windage(2.0e-7);
  ASSERT_EQ(strong.which.size(), 2U) << said(strong);
  for (const auto& found : strong.which) EXPECT_GT(found.confidence, 0.95) << said(strong);
}

// Saturation of the motor's torque, at 98 % beside a bandwidth that is worth 350 times as much: what is left
// of 240,000 where the observer's filter is not quite the sensor's.
TEST(TwoCauses, AreOneWhereAFastOneLeavesAThousandth) {
  const auto result = diagnosed(
      record({.effects = {effect(Effect::kCurrentBandwidth, 2.0e-4)}, .duration_s = 8.0, .seed = 23}),
      wrong_datasheet(23));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_TRUE(names(result.which.front(), Effect::kCurrentBandwidth)) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
