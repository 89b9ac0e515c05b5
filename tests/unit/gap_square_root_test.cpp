#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "lib/gap/square_root_statistics.hpp"
#include "tests/support/statistics_rows.hpp"

namespace morepro::gap {
namespace {

using test::collected;
using test::kColumns;
using test::random_rows;
using test::schur;
template <class Real>
using Statistics = test::Statistics<Real>;

TEST(SquareRootStatistics, HoldTheProductsOfTheirRows) {
  const Eigen::MatrixXd rows = random_rows(50, 1);
  const Eigen::MatrixXd products = rows.transpose() * rows;
  const auto statistics = collected<double>(rows);
  for (std::size_t a = 0; a <= kColumns; ++a)
    for (std::size_t b = 0; b <= kColumns; ++b)
      EXPECT_NEAR(statistics.left(a, b, 0),
                  products(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)),
                  1.0e-12 * products.norm());
  EXPECT_EQ(statistics.rows(), 50U);
}

TEST(SquareRootStatistics, LeaveWhatTheFirstColumnsDoNotExplain) {
  const Eigen::MatrixXd rows = random_rows(80, 2);
  const auto statistics = collected<double>(rows);
  const Eigen::MatrixXd rest = schur(rows, 2);
  EXPECT_NEAR(statistics.residual(2), rest(4, 4), 1.0e-12 * rest.norm());
  EXPECT_NEAR(statistics.left(3, 5, 2), rest(1, 3), 1.0e-12 * rest.norm());
  EXPECT_NEAR(statistics.correlation(3, 5, 2), rest(1, 3) / std::sqrt(rest(1, 1) * rest(3, 3)), 1.0e-12);
}

TEST(SquareRootStatistics, DrawACoefficientToZeroByItsPrior) {
  const Eigen::MatrixXd rows = random_rows(40, 5);
  auto statistics = collected<double>(rows);
  for (std::size_t j = 0; j < 2; ++j) statistics.expect_small(j, 3.0);
  Eigen::MatrixXd with_prior = Eigen::MatrixXd::Zero(42, kColumns + 1);
  with_prior.topRows(40) = rows;
  with_prior(40, 0) = with_prior(41, 1) = 3.0;
  EXPECT_NEAR(statistics.residual(2), schur(with_prior, 2)(4, 4), 1.0e-11);
  EXPECT_EQ(statistics.rows(), 40U);
}

TEST(SquareRootStatistics, TakeARowPieceByPiece) {
  const Eigen::MatrixXd rows = random_rows(1, 6);
  Statistics<double>::Insertion insertion;
  for (std::size_t j = 0; j <= kColumns; ++j) insertion.row[j] = rows(0, static_cast<Eigen::Index>(j));
  insertion.next = 0;
  Statistics<double> statistics;
  for (std::size_t j = 0; j < kColumns; ++j) EXPECT_FALSE(statistics.advance(insertion));
  EXPECT_EQ(statistics.rows(), 0U);
  EXPECT_TRUE(statistics.advance(insertion));
  EXPECT_TRUE(insertion.is_done());
  EXPECT_EQ(statistics.factor(0, 6), collected<double>(rows).factor(0, 6));
}

TEST(SquareRootStatistics, CountAQuarterAfterFading) {
  auto statistics = collected<double>(random_rows(80, 7));
  const double before = statistics.residual(2);
  statistics.fade();
  EXPECT_EQ(statistics.residual(2), 0.25 * before);
  EXPECT_EQ(statistics.rows(), 20U);
}

}  // namespace
}  // namespace morepro::gap
