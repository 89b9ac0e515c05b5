// Dry friction beside random forces: each of the two hides the other.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/search/friction_shape.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using diagnose_test::datasheet;
using diagnose_test::diagnosed;
using diagnose_test::effect;
using diagnose_test::record;
using diagnose_test::said;
using diagnose_test::wrong_datasheet;
using gap::Effect;

struct Shaken {
  Effect friction;
  double process_noise;
  std::uint64_t seed;
  double tolerance;  ///< as a share of the size
};

class ShakenFriction : public testing::TestWithParam<Shaken> {};

// With friction at the estimated speed alone, as if that were the speed, 8 N came back as 6.9 N and as
// 3.2 N; without a search that begins with little process noise as 7.6 N and 6.7 N where there is none. A
// tenth: what random forces that last for ten samples leave (sim_host/diagnose/fit/README.md). Without them,
// of a Stribeck curve 6 %: its size is the friction at rest, from which range and bend extrapolate.
TEST_P(ShakenFriction, HasItsSize) {
  const auto& [friction, process_noise, seed, tolerance] = GetParam();
  constexpr double kSizeN = 8.0;
  const auto result = diagnosed(record({.effects = {effect(friction, kSizeN)},
                                        .duration_s = 10.0,
                                        .seed = seed,
                                        .process_noise = process_noise}),
                                datasheet(0.0));
  ASSERT_FALSE(result.which.empty()) << said(result);
  EXPECT_EQ(result.which.front().effect, friction) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, kSizeN, tolerance * kSizeN) << said(result);
}

INSTANTIATE_TEST_SUITE_P(Forces, ShakenFriction,
                         testing::Values(Shaken{Effect::kFeedCoulombFriction, 0.0, 8, 0.03},
                                         Shaken{Effect::kFeedStribeckFriction, 0.0, 8, 0.06},
                                         Shaken{Effect::kFeedCoulombFriction, 0.3, 7, 0.1},
                                         Shaken{Effect::kFeedStribeckFriction, 0.3, 7, 0.1},
                                         Shaken{Effect::kFeedStribeckFriction, 1.0, 7, 0.1}));

// An axis in production turns back three times: of a quarter of the recording its observer believed 2.5 times
// the mass and the viscous friction, and 8 N were "unexplained". A hundredth: what the sensors leave.
TEST(DryFriction, IsFoundInProduction) {
  constexpr double kSizeN = 8.0;
  const auto result = diagnosed(record({.effects = {effect(Effect::kFeedCoulombFriction, kSizeN)},
                                        .duration_s = 8.0,
                                        .seed = 14,
                                        .profile = ProfileKind::kProduction}),
                                wrong_datasheet(14));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedCoulombFriction) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, kSizeN, 0.01 * kSizeN) << said(result);
  EXPECT_GT(result.which.front().confidence, 0.9) << said(result);
  EXPECT_TRUE(result.board_agrees) << "although its column, which is linear, leaves 0.73 of the gap";
}

// A width that is 3 % off costs 1000 in a recording of 100,000 rows, and that was "more than noise remains",
// with a standard error four times as large. Widths in steps of a twentieth are as far off, from wherever
// they begin.
TEST(DryFriction, HasItsWidthAsFarAsARecordingTells) {
  constexpr double kSizeN = 8.0;
  const RecordingSignals signals = record(
      {.effects = {effect(Effect::kFeedCoulombFriction, kSizeN)}, .duration_s = 15.0, .rate_hz = 2000.0});
  const MachineDescription machine = datasheet(0.0);
  const GapModel model{.machine = machine.configuration.machine,
                       .point = reference_point_for(machine, signals),
                       .noise = usual_noise(machine.configuration.sensors)};
  for (const float beginning : {1.0F, 1.02F, 1.04F, 1.06F}) {
    AxisFit fit(Axis::kFeed, signals, model);
    gap::AppliedEffect friction = effect(Effect::kFeedCoulombFriction, kSizeN);
    friction.form.shape *= beginning;
    fit.change_model().effects.push_back(friction);
    fit.settle(2);
    fit.polish();
    sharpen_newest(fit, 1.0F);
    for (const float beside : {0.98F, 1.02F}) {
      AxisFit other = fit;
      other.change_model().effects.back().form.shape *= beside;
      other.polish();
      EXPECT_GT(other.unlikeliness(), fit.unlikeliness()) << beginning << " " << beside;
    }
  }
}

// A mass of 11 to 20 kg, for 3, hides the friction from every balance beside these random forces, and the
// name was dropped for that: of eight such recordings all were "parameter_error".
TEST(DryFriction, IsNotTakenForAMassThatIsFourTimesTheDatasheets) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kFeedCoulombFriction, 8.0)},
                                        .duration_s = 8.0,
                                        .seed = 1,
                                        .profile = ProfileKind::kProduction,
                                        .process_noise = 0.3}),
                                datasheet(0.2));
  EXPECT_EQ(result.verdict, Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedCoulombFriction) << said(result);
}

struct Curve {
  double size_n;
  std::uint64_t seed;
};

// It acts in few moments of a production, which process noise hides. Sharpened only where it had won, 4 N of
// seed 7 were believed at 0.64 beside a bristle; sought in a quarter of the recording, 8 N were 3 N beside
// dry friction. A twentieth: its size is the friction at rest, from which range and bend extrapolate.
TEST(StribeckCurve, IsFoundInProduction) {
  for (const auto& [size_n, seed] : {Curve{4.0, 7}, Curve{8.0, 3}}) {
    const auto result = diagnosed(record({.effects = {effect(Effect::kFeedStribeckFriction, size_n)},
                                          .duration_s = 8.0,
                                          .seed = seed,
                                          .profile = ProfileKind::kProduction}),
                                  datasheet(0.0));
    ASSERT_EQ(result.which.size(), 1U) << said(result);
    EXPECT_EQ(result.which.front().effect, Effect::kFeedStribeckFriction) << said(result);
    EXPECT_NEAR(result.which.front().magnitude, size_n, 0.05 * size_n) << said(result);
    EXPECT_GT(result.which.front().confidence, 0.9) << said(result);
  }
}

// What a spindle's droop in the cut, a hundredth of its speed, makes of a play of the slide that nobody looks
// for: 724 N where the load is 24 N, at 98 %.
TEST(CuttingSpeedDependence, IsNoneThatNoCutHas) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kFeedBacklash, 2.0e-4)},
                                        .duration_s = 8.0,
                                        .seed = 11,
                                        .profile = ProfileKind::kProduction}),
                                wrong_datasheet(11), {Effect::kFeedBacklash});
  EXPECT_FALSE(std::any_of(result.which.begin(), result.which.end(), [](const EffectResult& one) {
    return one.effect == Effect::kFeedCuttingSpeedDependence;
  })) << said(result);
}

}  // namespace
}  // namespace morepro::host
