#include <gtest/gtest.h>

#include "sim_host/diagnose/balances/significance.hpp"

namespace morepro::host {
namespace {

// The mean of n squares of unit normal numbers is 1 +- sqrt(2 / n): of 200, 1.1645 is 1.645 deviations too
// much.
TEST(Significance, IsFivePercentAtItsQuantile) {
  EXPECT_NEAR(p_value_of(1.1645, 200.0), 0.05, 0.001);
  EXPECT_NEAR(p_value_of(1.0, 200.0), 0.5, 1.0e-12);
  EXPECT_EQ(p_value_of(3.0, 0.0), 1.0);
}

// Holm: 0.01 * 3, then max(0.03, 0.02 * 2), then max(0.04, 0.5 * 1).
TEST(Significance, IsCorrectedForTheNumberOfCells) {
  std::vector<GapCell> cells{{"time", 0, 1, 2.0, 0.5}, {"time", 1, 2, 2.0, 0.01}, {"time", 2, 3, 2.0, 0.02}};
  correct_for_number(cells);
  EXPECT_DOUBLE_EQ(cells[0].p_value, 0.5);
  EXPECT_DOUBLE_EQ(cells[1].p_value, 0.03);
  EXPECT_DOUBLE_EQ(cells[2].p_value, 0.04);
}

TEST(Significance, NeverExceedsOne) {
  std::vector<GapCell> cells(5, {"time", 0, 1, 1.0, 0.9});
  correct_for_number(cells);
  for (const GapCell& cell : cells) EXPECT_EQ(cell.p_value, 1.0);
}

}  // namespace
}  // namespace morepro::host
