#pragma once
#include <Eigen/Core>
#include <vector>

namespace morepro::host {

/// Weighted least squares from second moments [columns | y], some columns active, with a Gaussian prior.
struct LinearFit {
  std::vector<Eigen::Index> active;
  Eigen::VectorXd coefficient{};  ///< of the active columns
  Eigen::MatrixXd covariance{};   ///< of the coefficients, for rows of unit variance
  double rss = 0.0;               ///< of the rows, without the prior
};

/// `precision` and `target`: per column of `moments` (0: no prior); the prior pulls a coefficient to its
/// target.
LinearFit fit(const Eigen::MatrixXd& moments, const std::vector<Eigen::Index>& active,
              const Eigen::VectorXd& precision, const Eigen::VectorXd& target);

/// Residual sum of squares of other rows with these coefficients.
double rss_of(const Eigen::MatrixXd& moments, const LinearFit& fit);

/// What is left of the columns that are not active when the active ones have explained what they can.
struct Remainder {
  Eigen::MatrixXd moments;  ///< Schur complement of the active block, zero in its rows and columns
  double rss = 0.0;
};
Remainder remainder(const Eigen::MatrixXd& moments, const std::vector<Eigen::Index>& active,
                    const Eigen::VectorXd& precision, const Eigen::VectorXd& target);

/// Columns of which less than this share is new are combinations of the active ones.
inline constexpr double kLeastNew = 1.0e-6;

/// What the columns [first, first + count) would take from the remainder's residual; 0 where they are a
/// combination of the active ones. Fills `coefficient`.
double gain_of(const Remainder& remainder, const Eigen::MatrixXd& moments, Eigen::Index first,
               Eigen::Index count, Eigen::VectorXd& coefficient);

}  // namespace morepro::host
