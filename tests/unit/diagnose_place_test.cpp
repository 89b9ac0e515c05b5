// What follows the place of the feed axis: a spring that rests anywhere, a screw with its harmonics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/driven_axis.hpp"

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
  const auto pulled = {effect(Effect::kFeedSpring, 120.0), effect(Effect::kFeedForceOffset, -6.0)};
  const auto result = diagnosed(record({.effects = pulled}), datasheet(0.15));
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

/// 10 mm a turn, 8 s.
DiagnosisResult diagnosed_with_a_screw(const std::vector<gap::AppliedEffect>& screw) {
  MachineDescription sheet = datasheet(0.15);
  MonitorConfiguration machine = reference_configuration();
  sheet.configuration.machine.feed.screw_pitch_m = machine.machine.feed.screw_pitch_m = 0.01;
  return diagnosed(record({.effects = screw, .duration_s = 8.0, .configuration = machine}), sheet);
}

double left_of_feed_force(const DiagnosisResult& result) {
  for (const auto& balance : result.where)
    if (balance.balance == gap::Balance::kFeedForce) return balance.residual_ratio_after;
  return 0.0;
}

constexpr double kOnceN = 2.35;

// Twice a turn was without a name: more than the noise was left of the gap.
TEST(Screw, HasHarmonics) {
  const auto result =
      diagnosed_with_a_screw({with_parts(Effect::kFeedScrewPeriodic, {kOnceN, 0.0, 0.9, 1.1})});
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedScrewPeriodic);
  EXPECT_NEAR(result.which.front().magnitude, kOnceN, 3.0 * result.which.front().standard_error);
  // A floor that is known to some percent.
  EXPECT_NEAR(left_of_feed_force(result), 1.0, 0.05);
}

// Three times a turn has no name. 24 samples at 10 kHz predict nearly all of a force of 5 Hz.
TEST(Screw, KeepsItsNameBesideNoiseThatLasts) {
  const auto result =
      diagnosed_with_a_screw({with_parts(Effect::kFeedScrewPeriodic, {kOnceN, 0.0}),
                              with_parts(Effect::kFeedScrewPeriodic, {0.3, 0.36}, 0.01F / 3.0F)});
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, kOnceN, 0.05 * kOnceN);
}

// What brakes both ways in one place is no force there on average, and no straight line along the way follows
// it: such a guide passed for random forces. The bells along the way are 14 mm apart.
TEST(Guide, ThatIsTightInOnePlaceIsUnexplained) {
  constexpr double kPlaceM = 0.01;
  DrivenAxis axis;
  axis.viscosity_at = [](double place_m) {
    const double away = (place_m - kPlaceM) / 0.01;
    return 1.0 + 0.02 * std::exp(-away * away);
  };
  const DiagnosisResult result = diagnosed(record(axis), datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  EXPECT_TRUE(result.which.empty()) << said(result);
  ASSERT_FALSE(result.unexplained_follows.empty());
  const std::string& best = result.unexplained_follows.front().signal;
  const std::size_t near = best.find(" near ");
  ASSERT_NE(near, std::string::npos) << best;
  EXPECT_NEAR(std::stod(best.substr(near + 6)), kPlaceM, 0.007) << best;
}

}  // namespace
}  // namespace morepro::diagnose_test
