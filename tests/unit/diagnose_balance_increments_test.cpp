// Balances have a row for every sampling interval that is measured at both ends.
#include <gtest/gtest.h>

#include "sim_host/diagnose/balances/balance_increments.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::Axis;
using host::AxisFit;
using host::BalanceIncrements;

class Increments : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<BalanceIncrements> of(Axis axis, const RecordingSignals& signals) const {
    const AxisFit fit(axis, signals, gap_model(datasheet(0.0), signals));
    return host::balance_increments({.fit = fit, .nominal = fit});
  }
};

/// The first and the last row of a balance that are measured.
std::pair<Eigen::Index, Eigen::Index> measured(const BalanceIncrements& balance) {
  Eigen::Index first = 0;
  Eigen::Index last = balance.columns.rows() - 1;
  while (first < last && !balance.columns.row(first).allFinite()) ++first;
  while (last > first && !balance.columns.row(last).allFinite()) --last;
  return {first, last};
}

// A production's run-up is over in the first window: with its first row missing all of it was.
TEST_F(Increments, BeginWithTheFirstInterval) {
  const RecordingSignals signals = record({.duration_s = 0.5});
  for (const Axis axis : {Axis::kSpindle, Axis::kFeed})
    for (const BalanceIncrements& balance : of(axis, signals)) {
      const auto [first, last] = measured(balance);
      EXPECT_EQ(first, 0);
      EXPECT_EQ(last, static_cast<Eigen::Index>(signals.rows) - 2);
    }
}

// A speed that was not recorded takes three positions.
TEST_F(Increments, BeginWithTheSecondPosition) {
  RecordingSignals signals = record({.duration_s = 0.5});
  leave_out(signals, Channel::kFeedSpeed);
  ASSERT_TRUE(signals.has(Channel::kFeedPosition));
  const auto [first, last] = measured(of(Axis::kFeed, signals).front());
  EXPECT_EQ(first, 1);
  EXPECT_EQ(last, static_cast<Eigen::Index>(signals.rows) - 2);
}

}  // namespace
}  // namespace morepro::diagnose_test
