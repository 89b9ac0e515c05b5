// A run that begins within a recording, of a model with a bristle: what rests there is held by what it came
// from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "sim_host/diagnose/fit/bristle_lead.hpp"
#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::Axis;
using host::GapModel;
using host::lead_of_bristles;

constexpr double kRateHz = 1000.0;
constexpr std::size_t kRows = 32000;
constexpr std::size_t kSlides = 20000;  ///< until then; it rests from there on
constexpr double kSpeedMS = 0.01;
constexpr double kYieldM = 1.0e-4;

/// A slide that moves and then rests.
RecordingSignals resting(bool has_speed) {
  RecordingSignals signals;
  signals.rate_hz = kRateHz;
  signals.rows = kRows;
  for (std::size_t row = 0; row < kRows; ++row) {
    const double slid = static_cast<double>(std::min(row, kSlides));
    if (has_speed) show(signals, Channel::kFeedSpeed, row < kSlides ? kSpeedMS : 0.0);
    show(signals, Channel::kFeedPosition, slid / kRateHz * kSpeedMS);
  }
  return signals;
}

GapModel with_bristle(double yield_m) {
  GapModel model;
  model.effects = {{.form = {.effect = Effect::kFeedPresliding, .shape = static_cast<float>(yield_m)}}};
  return model;
}

TEST(BristleLead, ReachesBackToWhereTheAxisSlid) {
  for (const bool has_speed : {true, false}) {
    const RecordingSignals signals = resting(has_speed);
    const std::size_t lead = lead_of_bristles(Axis::kFeed, signals, with_bristle(kYieldM), kSlides + 1000);
    EXPECT_LE(lead, kSlides - 50) << "five yields of 0.1 mm at 10 um per row";
    EXPECT_GT(lead, kSlides - 60);
  }
}

TEST(BristleLead, OfALongRestIsASixteenthOfTheRecordingAtMost) {
  EXPECT_EQ(lead_of_bristles(Axis::kFeed, resting(true), with_bristle(kYieldM), kSlides + 5000),
            kSlides + 5000 - kRows / 16);
  EXPECT_EQ(lead_of_bristles(Axis::kFeed, resting(true), with_bristle(1.0), 500), 0U);
}

TEST(BristleLead, IsNoneWithoutABristleOfTheAxis) {
  const RecordingSignals signals = resting(true);
  EXPECT_EQ(lead_of_bristles(Axis::kFeed, signals, {}, kSlides + 1000), kSlides + 1000);
  EXPECT_EQ(lead_of_bristles(Axis::kSpindle, signals, with_bristle(kYieldM), kSlides + 1000), kSlides + 1000);
}

// Rows of the lead are none of the stretch's.
TEST(BristleLead, TellsNothingOfTheRowsBefore) {
  const RecordingSignals signals =
      record({.effects = {effect(Effect::kFeedPresliding, 4.0)}, .duration_s = 1.0});
  GapModel model = gap_model(datasheet(0.0), signals);
  model.effects = {effect(Effect::kFeedPresliding, 4.0)};
  const std::size_t first = signals.rows / 2;
  ASSERT_LT(lead_of_bristles(Axis::kFeed, signals, model, first), first);
  std::size_t earliest = signals.rows;
  host::run_observer(Axis::kFeed, signals, model, first, signals.rows,
                     [&](const host::Innovation& v) { earliest = std::min(earliest, v.row); });
  EXPECT_EQ(earliest, first);
}

}  // namespace
}  // namespace morepro::diagnose_test
