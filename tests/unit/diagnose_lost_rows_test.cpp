// What drove the machine while rows were lost nobody knows.
#include <gtest/gtest.h>

#include <cmath>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

/// Dither of 12 V every millisecond, of which every thirtieth is not recorded.
RecordingSignals thirtieth_lost() {
  return record(
      {.effects = {effect(Effect::kSampleDropout, 0.03)}, .duration_s = 10.0, .rate_hz = 1000.0, .seed = 6});
}

// The voltage of the row before stood for the lost one: "unexplained", in four of four recordings.
TEST(LostRows, AreAFaultOfTheSamplingAndNoStructure) {
  const auto result = diagnosed(thirtieth_lost(), datasheet(0.1));
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kSampleDropout);
}

// Squares of innovations over their variances, after a lost row: one on average, as everywhere.
TEST(LostRows, AreFollowedByInnovationsThatTheObserverExpects) {
  RecordingSignals signals = thirtieth_lost();
  const auto power = [&signals] {
    double squares = 0.0;
    double count = 0.0;
    host::run_observer(host::Axis::kSpindle, signals, gap_model(datasheet(0.0), signals), 0, signals.rows,
                       [&](const host::Innovation& v) {
                         if (v.sensor != 1 || v.row == 0 || !host::is_missing(signals, v.row - 1)) return;
                         squares += v.value * v.value / v.variance;
                         count += 1.0;
                       });
    return squares / count;
  };
  EXPECT_GT(power(), 100.0);
  host::doubt_lost_inputs(signals);
  // 290 rows of a voltage that is one of two: their squares are known to a sixth.
  EXPECT_NEAR(power(), 1.0, 0.3);
}

}  // namespace
}  // namespace morepro::diagnose_test
