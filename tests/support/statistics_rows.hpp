#pragma once
#include <Eigen/Dense>
#include <random>

#include "lib/gap/square_root_statistics.hpp"

/// Random rows, and what the textbook says of them.
namespace morepro::test {

inline constexpr std::size_t kColumns = 6;
template <class Real>
using Statistics = gap::SquareRootStatistics<Real, kColumns>;

inline Eigen::MatrixXd random_rows(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd rows(count, kColumns + 1);
  for (double& x : rows.reshaped()) x = normal(random);
  rows.col(3) += 2.0 * rows.col(0);
  rows.col(6) += 0.5 * rows.col(4) - 0.3 * rows.col(1);
  return rows;
}

template <class Real>
Statistics<Real> collected(const Eigen::MatrixXd& rows) {
  Statistics<Real> statistics;
  for (const auto& row : rows.rowwise()) {
    typename Statistics<Real>::Row taken;
    for (std::size_t j = 0; j <= kColumns; ++j)
      taken[j] = static_cast<Real>(row(static_cast<Eigen::Index>(j)));
    statistics.add(taken);
  }
  return statistics;
}

/// What columns `active` leave of the others, by the textbook.
inline Eigen::MatrixXd schur(const Eigen::MatrixXd& rows, Eigen::Index active) {
  const Eigen::MatrixXd m = rows.transpose() * rows;
  const auto rest = m.cols() - active;
  return m.bottomRightCorner(rest, rest) -
         m.bottomLeftCorner(rest, active) *
             m.topLeftCorner(active, active).ldlt().solve(m.topRightCorner(active, rest));
}

}  // namespace morepro::test
