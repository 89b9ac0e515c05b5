// What a long recording without random forces is sure of, and nobody sees in any balance, is no effect.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

/// Every third row, with the mean of the force until the next one: a controller faster than what is recorded
/// changes the force within an interval.
RecordingSignals recorded_slowly(const RecordingSignals& all) {
  constexpr std::size_t kTimes = 3;
  RecordingSignals slow = all;
  slow.rate_hz = all.rate_hz / kTimes;
  slow.rows = all.rows / kTimes;
  for (auto& column : slow.value) column.clear();
  for (std::size_t row = 0; row < slow.rows; ++row) {
    for (const Channel channel : {Channel::kFeedSpeed, Channel::kFeedPosition})
      slow.value[index_of(channel)].push_back(all.value[index_of(channel)][kTimes * row]);
    const auto first = all.value[index_of(Channel::kFeedForce)].begin() + static_cast<long>(kTimes * row);
    double sum = 0.0;
    std::for_each_n(first, kTimes, [&sum](float force) { sum += static_cast<double>(force); });
    slow.value[index_of(Channel::kFeedForce)].push_back(static_cast<float>(sum / kTimes));
  }
  return slow;
}

TEST(Invisible, WhatAForceDoesWithinAnInterval) {
  const auto signals = recorded_slowly(record(DrivenAxis{.rate_hz = 10000.0, .rows = 400000}));
  const DiagnosisResult result = diagnosed(signals, datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << said(result);
  EXPECT_TRUE(result.which.empty()) << said(result);
}

// Two steps late: no balance shows it, and no solver does it.
TEST(Invisible, IsNoLagOfMoreThanAStep) {
  const DiagnosisResult result =
      diagnosed(record(SimulatedRun{.effects = {effect(Effect::kFeedDriveLag, 4.0e-4)},
                                    .duration_s = 20.0,
                                    .profile = host::ProfileKind::kProduction}),
                datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedDriveLag);
  EXPECT_NEAR(result.which.front().magnitude, 4.0e-4, 4.0 * result.which.front().standard_error);
}

}  // namespace
}  // namespace morepro::diagnose_test
