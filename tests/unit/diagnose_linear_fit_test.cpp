#include <gtest/gtest.h>

#include "sim_host/diagnose/fit/linear_fit.hpp"

namespace morepro::host {
namespace {

using Indices = std::vector<Eigen::Index>;

// Rows [1, x, y] of the points (0, 1), (1, 3), (2, 4): the line is 7/6 + 3/2 x, its residuals -1/6, 1/3,
// -1/6.
Eigen::MatrixXd three_points() {
  Eigen::MatrixXd rows(3, 3);
  rows << 1, 0, 1, 1, 1, 3, 1, 2, 4;
  return rows.transpose() * rows;
}

Eigen::VectorXd none() { return Eigen::VectorXd::Zero(3); }

// The factorisation adds 1e-12 of a column's own square.
constexpr double kTolerance = 1.0e-10;

TEST(LinearFit, IsTheLineThroughThreePointsWorkedByHand) {
  const LinearFit line = fit(three_points(), Indices{0, 1}, none(), none());
  EXPECT_NEAR(line.coefficient(0), 7.0 / 6.0, kTolerance);
  EXPECT_NEAR(line.coefficient(1), 1.5, kTolerance);
  EXPECT_NEAR(line.rss, 1.0 / 6.0, kTolerance);
  EXPECT_NEAR(line.covariance(0, 0), 5.0 / 6.0, kTolerance);
  EXPECT_NEAR(line.covariance(0, 1), -0.5, kTolerance);
  EXPECT_NEAR(line.covariance(1, 1), 0.5, kTolerance);
}

TEST(LinearFit, LeavesColumnsAloneThatAreNotActive) {
  const LinearFit mean = fit(three_points(), Indices{0}, none(), none());
  EXPECT_NEAR(mean.coefficient(0), 8.0 / 3.0, kTolerance);
  EXPECT_NEAR(mean.rss, 26.0 - 64.0 / 3.0, kTolerance);
}

TEST(LinearFit, IsPulledToThePriorsTargetByItsPrecision) {
  const Eigen::Vector3d precision(2.0, 0.0, 0.0);
  const Eigen::Vector3d target(1.0, 0.0, 0.0);
  const LinearFit mean = fit(three_points(), Indices{0}, precision, target);
  EXPECT_NEAR(mean.coefficient(0), (8.0 + 2.0 * 1.0) / (3.0 + 2.0), kTolerance);
  // Of the rows alone: 26 - 2 c 8 + c^2 3 at c = 2.
  EXPECT_NEAR(mean.rss, 6.0, kTolerance);
}

TEST(LinearFit, SurvivesColumnsThatDifferByManyPowersOfTen) {
  const Eigen::VectorXd scale = Eigen::Vector3d(1.0e-9, 1.0e7, 1.0);
  const Eigen::MatrixXd moments = scale.asDiagonal() * three_points() * scale.asDiagonal();
  const LinearFit line = fit(moments, Indices{0, 1}, none(), none());
  EXPECT_NEAR(line.coefficient(0) * scale(0), 7.0 / 6.0, kTolerance);
  EXPECT_NEAR(line.coefficient(1) * scale(1), 1.5, kTolerance);
}

TEST(LinearFit, TellsTheResidualOfOtherRowsWithTheseCoefficients) {
  const LinearFit line = fit(three_points(), Indices{0, 1}, none(), none());
  Eigen::MatrixXd other(1, 3);
  other << 1, 4, 10;  // the line says 7/6 + 6
  const double left = 10.0 - 7.0 / 6.0 - 6.0;
  EXPECT_NEAR(rss_of(other.transpose() * other, line), left * left, kTolerance);
}

TEST(Remainder, OfAColumnTakesWhatAFullFitWouldTake) {
  const Eigen::MatrixXd moments = three_points();
  const Remainder rest = remainder(moments, Indices{0}, none(), none());
  EXPECT_NEAR(rest.rss, 14.0 / 3.0, kTolerance);
  Eigen::VectorXd slope;
  EXPECT_NEAR(gain_of(rest, moments, 1, 1, slope), 4.5, kTolerance);
  EXPECT_NEAR(slope(0), 1.5, kTolerance);
}

TEST(Remainder, OfACombinationOfTheActiveColumnsGainsNothing) {
  Eigen::MatrixXd rows(4, 4);
  rows << 1, 0, 2, 1, 1, 1, 5, 3, 1, 2, 8, 4, 1, 3, 11, 9;  // third = 2 first + 3 second
  const Eigen::MatrixXd moments = rows.transpose() * rows;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(4);
  Eigen::VectorXd coefficient;
  EXPECT_EQ(gain_of(remainder(moments, Indices{0, 1}, zero, zero), moments, 2, 1, coefficient), 0.0);
  EXPECT_EQ(coefficient(0), 0.0);
}

TEST(LinearFit, OfCollinearColumnsStillPredictsTheRows) {
  Eigen::MatrixXd rows(3, 3);
  rows << 1, 2, 1, 1, 2, 3, 1, 2, 4;
  const Eigen::MatrixXd moments = rows.transpose() * rows;
  const LinearFit mean = fit(moments, Indices{0, 1}, none(), none());
  // Half of the digits are lost where the matrix is singular to 1e-12.
  EXPECT_NEAR(mean.coefficient(0) + 2.0 * mean.coefficient(1), 8.0 / 3.0, 1.0e-6);
  EXPECT_NEAR(mean.rss, 14.0 / 3.0, 1.0e-6);
}

}  // namespace
}  // namespace morepro::host
