#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "lib/gap/explained_columns.hpp"
#include "tests/support/statistics_rows.hpp"

namespace morepro::gap {
namespace {

using test::collected;
using test::kColumns;
using test::random_rows;
using test::schur;

template <class Real>
GroupGain<Real> gain(const Eigen::MatrixXd& rows, std::size_t first, std::size_t count) {
  return ExplainedColumns<Real, kColumns>(2).gain_of(collected<Real>(rows), first, count);
}

// 1e-12: some hundred additions of numbers with sixteen digits.
TEST(ExplainedColumns, KnowTheGainOfAGroup) {
  const Eigen::MatrixXd rows = random_rows(80, 3);
  const Eigen::MatrixXd rest = schur(rows, 2);
  for (const Eigen::Index count : {1, 2, 3, 4}) {
    const Eigen::VectorXd b = rest.block(0, 4, count, 1);
    const Eigen::VectorXd x = rest.topLeftCorner(count, count).ldlt().solve(b);
    const auto group = gain<double>(rows, 2, static_cast<std::size_t>(count));
    EXPECT_NEAR(group.gain, x.dot(b), 1.0e-12 * rest(4, 4)) << count;
    if (count == 1) {
      EXPECT_NEAR(group.coefficient, x(0), 1.0e-12);
    }
  }
}

TEST(ExplainedColumns, GainNothingFromACombinationOfTheFirstColumns) {
  Eigen::MatrixXd rows = random_rows(80, 4);
  rows.col(3) = 3.0 * rows.col(0) - rows.col(1);
  EXPECT_EQ(gain<double>(rows, 3, 1).gain, 0.0);
  EXPECT_EQ(gain<float>(rows, 3, 1).gain, 0.0F);
  rows.col(4).setZero();
  EXPECT_EQ(gain<float>(rows, 4, 1).gain, 0.0F);
}

TEST(ExplainedColumns, AreWhatARegressionWithThemLeaves) {
  Eigen::MatrixXd rows = random_rows(80, 5);
  rows.col(2) += 0.7 * rows.col(4) + 0.2 * rows.col(5);
  const auto statistics = collected<double>(rows);
  ExplainedColumns<double, kColumns> explained(2);
  explained.explain(statistics, 5);
  explained.explain(statistics, 3);
  Eigen::MatrixXd sorted = rows;
  sorted.col(2) = rows.col(5);
  sorted.col(5) = rows.col(2);
  const Eigen::MatrixXd rest = schur(sorted, 4);  // columns 4 and then 2 of the rows, and y
  EXPECT_NEAR(explained.left(statistics, 2, 4), rest(0, 1), 1.0e-12 * rest.norm());
  EXPECT_NEAR(explained.left(statistics, 6, 6), rest(2, 2), 1.0e-12 * rest.norm());
  EXPECT_NEAR(explained.gain_of(statistics, 2, 1).gain, rest(1, 2) * rest(1, 2) / rest(1, 1),
              1.0e-12 * rest(2, 2));
}

TEST(ExplainedColumns, GainNothingFromACombinationOfWhatIsExplained) {
  Eigen::MatrixXd rows = random_rows(80, 6);
  rows.col(4) = rows.col(0) + 2.0 * rows.col(3);
  const auto statistics = collected<float>(rows);
  ExplainedColumns<float, kColumns> explained(2);
  explained.explain(statistics, 3);
  EXPECT_EQ(explained.gain_of(statistics, 4, 1).gain, 0.0F);
  explained.explain(statistics, 4);  // changes nothing and takes no room
  EXPECT_TRUE(explained.has_room(explained.kMost - 1));
  EXPECT_FALSE(explained.has_room(explained.kMost));
}

}  // namespace
}  // namespace morepro::gap
