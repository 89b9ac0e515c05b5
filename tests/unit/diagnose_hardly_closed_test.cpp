#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim_host/diagnose/balances/share_closed.hpp"

namespace morepro::host {
namespace {

constexpr auto kFeed = static_cast<std::size_t>(gap::Balance::kFeedForce);

BalanceResult balance(double ratio_after) {
  return {.balance = gap::Balance::kFeedForce,
          .is_evaluated = true,
          .residual_ratio = 8.0,
          .residual_ratio_after = ratio_after};
}

/// Shares of the gap closed up to `most`; errors of the refitted model and of that with effects, in noise
/// floors.
Shrinkage shrinkage(double most, double refit, double with_effect) {
  Shrinkage result;
  result.share_closed = 0.9 * most;
  result.interval90 = {0.5 * most, most};
  result.one_step_nrmse[kFeed] = ModelComparison{.datasheet = {9.0},
                                                 .refit = {refit},
                                                 .with_effect = {with_effect},
                                                 .noise_floor = 1.0,
                                                 .sensor_floor = 1.0};
  return result;
}

TEST(HardlyClosed, IsAGapOfWhichNamesTakeAHalf) {
  EXPECT_TRUE(is_hardly_closed(shrinkage(0.67, 4.7, 5.6), std::array{balance(4.2)}));
  EXPECT_TRUE(is_hardly_closed(shrinkage(0.56, 4.4, 4.2), std::array{balance(1.23)}));
}

/// The same with errors of a free run.
Shrinkage run_free(Shrinkage steps, double refit, double with_effect) {
  steps.free_run_nrmse[kFeed] = ModelComparison{.datasheet = {9.0},
                                                .refit = {refit, {0.95 * refit, 1.05 * refit}},
                                                .with_effect = {with_effect},
                                                .noise_floor = 1.0,
                                                .sensor_floor = 1.0};
  return steps;
}

// However well a model predicts a step in which there was hardly anything to predict.
TEST(HardlyClosed, IsAGapOfWhichSurelyNothingIsClosed) {
  const Shrinkage nothing = shrinkage(0.14, 1.0, 1.0);
  EXPECT_TRUE(is_hardly_closed(run_free(nothing, 2.7, 3.0), std::array{balance(1.52)}));
  EXPECT_FALSE(is_hardly_closed(run_free(nothing, 1.2, 1.0), std::array{balance(2.52)}));
}

// A mass that is not the same everywhere was a force that saturates, at 98 %, with 1.06 times the noise left.
TEST(HardlyClosed, IsAFaintGapOfWhichSurelyNothingIsClosed) {
  const Shrinkage nothing = run_free(shrinkage(0.26, 1.0, 1.0), 1.036, 1.03);
  EXPECT_TRUE(is_hardly_closed(nothing, std::array{balance(1.06)}));
  EXPECT_FALSE(is_hardly_closed(nothing, std::array{balance(1.02)})) << "noise that lasts";
  EXPECT_FALSE(is_hardly_closed(run_free(nothing, 1.036, 1.01), std::array{balance(1.06)})) << "runs better";
  EXPECT_FALSE(is_hardly_closed(run_free(shrinkage(0.4, 1.0, 1.0), 1.036, 1.03), std::array{balance(1.06)}))
      << "some of it is closed";
  EXPECT_FALSE(is_hardly_closed(run_free(nothing, 1.036, 1.036), std::array{balance(1.06)}))
      << "where no effect acts";
}

// However little a step shows of it.
TEST(HardlyClosed, IsAGapOfWhichAFreeRunIsNoBetter) {
  const Shrinkage little = shrinkage(0.67, 1.001, 1.0);
  const std::array shown{balance(1.05)};
  EXPECT_TRUE(is_hardly_closed(run_free(little, 2.7, 3.0), shown));
  EXPECT_TRUE(is_hardly_closed(run_free(little, 2.7, 2.65), shown));
  EXPECT_FALSE(is_hardly_closed(run_free(little, 2.7, 2.5), shown));
  EXPECT_FALSE(is_hardly_closed(run_free(little, 2.7, 2.7), shown)) << "where no effect acts";
  EXPECT_FALSE(is_hardly_closed(run_free(shrinkage(0.71, 1.001, 1.0), 2.7, 3.0), shown));
  EXPECT_FALSE(is_hardly_closed(run_free(little, 1.1, 1.2), shown)) << "noise";
  Shrinkage shaken = run_free(little, 2.7, 2.65);
  shaken.free_run_nrmse[kFeed]->noise_floor = 2.6;
  EXPECT_FALSE(is_hardly_closed(shaken, shown)) << "random forces";
  shaken.free_run_nrmse[kFeed]->noise_floor = 2.0;
  EXPECT_FALSE(is_hardly_closed(shaken, shown)) << "nearer to them";
  shaken.free_run_nrmse[kFeed]->with_effect = {2.68};
  EXPECT_TRUE(is_hardly_closed(shaken, shown)) << "beyond them, and no nearer";
  Shrinkage elsewhere = run_free(little, 2.7, 3.0);
  elsewhere.free_run_nrmse[static_cast<std::size_t>(gap::Balance::kSpindleTorque)] =
      ModelComparison{.datasheet = {9.0},
                      .refit = {2.7, {2.5, 2.9}},
                      .with_effect = {1.2},
                      .noise_floor = 1.0,
                      .sensor_floor = 1.0};
  EXPECT_FALSE(is_hardly_closed(elsewhere, shown));
}

// Random forces that act only while an axis moves were a shaking clock, a Stribeck curve and a delay, at 97
// and 98 %, with nothing closed.
TEST(NothingClosed, IsNoneOfItInRowsNorInAFreeRun) {
  EXPECT_TRUE(closes_nothing(run_free(shrinkage(0.0, 1.0, 1.0), 1.4, 1.42)));
  EXPECT_FALSE(closes_nothing(run_free(shrinkage(0.0, 1.0, 1.0), 2.7, 1.4)));
  EXPECT_FALSE(closes_nothing(run_free(shrinkage(0.5, 1.0, 1.0), 1.4, 1.42)));
}

TEST(HardlyClosed, IsNoGapThatIsMostlyGone) {
  EXPECT_FALSE(is_hardly_closed(shrinkage(0.83, 1.12, 1.07), std::array{balance(1.32)}));
}

TEST(HardlyClosed, IsNoGapThatAModelWithThePartsPredicts) {
  EXPECT_FALSE(is_hardly_closed(shrinkage(0.67, 4.7, 1.5), std::array{balance(4.2)}));
  EXPECT_FALSE(is_hardly_closed(shrinkage(0.67, 1.0, 1.0), std::array{balance(4.2)}));
}

TEST(HardlyClosed, IsNoGapThatNoBalanceShows) {
  EXPECT_FALSE(is_hardly_closed(shrinkage(0.0, 4.7, 5.6), std::array{balance(1.05)}));
}

/// A balance before and after.
BalanceResult gap_of(double before, double after) {
  return {.balance = gap::Balance::kFeedForce,
          .is_evaluated = true,
          .residual_ratio = before,
          .residual_ratio_after = after};
}

// A tenth of it, and of one that shows.
TEST(KeptGap, IsMoreThanShapesLeave) {
  const Shrinkage wrong = run_free({}, 2.7, 2.0);
  EXPECT_TRUE(keeps_a_gap(wrong, std::array{gap_of(32.0, 32.0)}));
  EXPECT_TRUE(keeps_a_gap(wrong, std::array{gap_of(11.0, 2.1)}));
  EXPECT_FALSE(keeps_a_gap(wrong, std::array{gap_of(11.0, 1.9)}));
  EXPECT_FALSE(keeps_a_gap(wrong, std::array{gap_of(1.14, 1.14)})) << "hardly shows";
  EXPECT_TRUE(keeps_a_gap(wrong, std::array{gap_of(50.0, 1.0), gap_of(1.4, 1.4)})) << "any";
  BalanceResult unevaluated = gap_of(11.0, 11.0);
  unevaluated.is_evaluated = false;
  EXPECT_FALSE(keeps_a_gap(wrong, std::array{unevaluated}));
}

// A bump in the way that had the names of three parts of a friction: less is to be seen, but more of it.
TEST(KeptGap, OfWhichLittleIsSeenIsMuchOfIt) {
  const std::array little{gap_of(1.7, 1.2)};
  EXPECT_TRUE(keeps_a_gap(run_free({}, 2.7, 2.0), little));
  EXPECT_FALSE(keeps_a_gap(run_free({}, 2.7, 1.8), little)) << "runs better";
  EXPECT_FALSE(keeps_a_gap(run_free({}, 2.7, 2.0), std::array{gap_of(1.9, 1.2)})) << "a shape";
}

// Rows at 1 kHz were five times their noise beside a bias that explained everything.
TEST(KeptGap, IsNoneOfAModelThatRunsRight) {
  const std::array shown{gap_of(6.1, 5.9)};
  EXPECT_FALSE(keeps_a_gap(run_free({}, 5.6, 1.4), shown));
  EXPECT_TRUE(keeps_a_gap(run_free({}, 5.6, 1.7), shown));
  Shrinkage away = run_free({}, 5.6, std::nan(""));
  EXPECT_TRUE(keeps_a_gap(away, shown)) << "diverges";
  away.free_run_nrmse[kFeed]->noise_floor = away.free_run_nrmse[kFeed]->sensor_floor = std::nan("");
  EXPECT_TRUE(keeps_a_gap(away, shown)) << "as it is stated then";
}

TEST(KeptGap, IsAShareOfIt) {
  EXPECT_DOUBLE_EQ(share_kept(gap_of(11.0, 3.5)), 0.25);
  EXPECT_DOUBLE_EQ(share_kept(gap_of(2.0, 2.5)), 1.0) << "not more than all";
  EXPECT_DOUBLE_EQ(share_kept(gap_of(2.0, 1.2)), 0.0);
}

}  // namespace
}  // namespace morepro::host
