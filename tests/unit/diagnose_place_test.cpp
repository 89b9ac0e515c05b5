// What follows the place of the feed axis: a spring that rests anywhere, a screw with its harmonics.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

gap::AppliedEffect with_parts(Effect name, std::initializer_list<double> coefficients, float shape = 0.0F) {
  gap::AppliedEffect one{
      .form = {.effect = name, .parts = static_cast<std::uint8_t>(coefficients.size()), .shape = shape}};
  std::copy(coefficients.begin(), coefficients.end(), one.coefficient.begin());
  return one;
}

// 120 N/m that pull towards a place 50 mm away were a force and a spring, the force first.
TEST(Spring, ThatRestsElsewhereIsOneCause) {
  const auto result =
      diagnosed(record({.effects = {with_parts(Effect::kFeedSpring, {120.0, -6.0})}}), datasheet(0.15));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedSpring);
  EXPECT_NEAR(result.which.front().magnitude, 120.0, 3.0 * result.which.front().standard_error);
}

TEST(Spring, IsNoneWhereAForceDoesNotFollowThePlace) {
  const auto result =
      diagnosed(record({.effects = {effect(Effect::kFeedForceOffset, -6.0)}}), datasheet(0.15));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedForceOffset) << said(result);
  EXPECT_FALSE(names(result.which.front(), Effect::kFeedSpring)) << "one that contains the force is no rival";
}

// Its second harmonic was noise that lasts, and with it the whole force. 10 mm a turn.
TEST(Screw, HasHarmonics) {
  constexpr double kOnceN = 2.35;
  MachineDescription sheet = datasheet(0.15);
  MonitorConfiguration machine = reference_configuration();
  sheet.configuration.machine.feed.screw_pitch_m = machine.machine.feed.screw_pitch_m = 0.01;
  const auto screw = with_parts(Effect::kFeedScrewPeriodic, {kOnceN, 0.0, 0.3, 0.36});
  const auto result = diagnosed(record({.effects = {screw}, .configuration = machine}), sheet);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedScrewPeriodic);
  EXPECT_NEAR(result.which.front().magnitude, kOnceN, 3.0 * result.which.front().standard_error);
  EXPECT_LT(result.unexplained_share, 0.01);
}

// Three times a turn has no name. 24 samples at 10 kHz predict nearly all of a force of 5 Hz, and what is
// left of it was worth less than noise that lasts may be; the gap closes with it, and is open without.
TEST(Screw, KeepsItsNameBesideNoiseThatLasts) {
  constexpr double kOnceN = 2.35;
  MachineDescription sheet = datasheet(0.15);
  MonitorConfiguration machine = reference_configuration();
  sheet.configuration.machine.feed.screw_pitch_m = machine.machine.feed.screw_pitch_m = 0.01;
  const auto once = with_parts(Effect::kFeedScrewPeriodic, {kOnceN, 0.0});
  const auto thrice = with_parts(Effect::kFeedScrewPeriodic, {0.3, 0.36}, 0.01F / 3.0F);
  const auto result =
      diagnosed(record({.effects = {once, thrice}, .duration_s = 8.0, .configuration = machine}), sheet);
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, kOnceN, 0.05 * kOnceN);
}

}  // namespace
}  // namespace morepro::diagnose_test
