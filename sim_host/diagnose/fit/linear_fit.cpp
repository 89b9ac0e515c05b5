#include "sim_host/diagnose/fit/linear_fit.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace morepro::host {
namespace {

Eigen::MatrixXd block(const Eigen::MatrixXd& moments, const std::vector<Eigen::Index>& rows) {
  return moments(rows, rows);
}

struct Normalised {
  Eigen::VectorXd scale;
  Eigen::LDLT<Eigen::MatrixXd> factor;
};

// Columns differ by many powers of ten: factor them at unit length.
Normalised factor_of(Eigen::MatrixXd a) {
  Normalised n;
  n.scale = a.diagonal().cwiseMax(1.0e-300).cwiseSqrt().cwiseInverse();
  a = n.scale.asDiagonal() * a * n.scale.asDiagonal();
  a.diagonal().array() += 1.0e-12;
  n.factor.compute(a);
  return n;
}

Eigen::MatrixXd solve(const Normalised& n, const Eigen::MatrixXd& b) {
  return n.scale.asDiagonal() * n.factor.solve(n.scale.asDiagonal() * b);
}

}  // namespace

LinearFit fit(const Eigen::MatrixXd& moments, const std::vector<Eigen::Index>& active,
              const Eigen::VectorXd& precision, const Eigen::VectorXd& target) {
  const Eigen::Index y = moments.cols() - 1;
  LinearFit result{.active = active};
  Eigen::MatrixXd a = block(moments, active);
  Eigen::VectorXd b = moments(active, y);
  a.diagonal() += precision(active);
  b += precision(active).cwiseProduct(target(active));
  const Normalised factor = factor_of(a);
  result.coefficient = solve(factor, b);
  result.covariance = solve(factor, Eigen::MatrixXd::Identity(a.rows(), a.cols()));
  result.rss = rss_of(moments, result);
  return result;
}

double rss_of(const Eigen::MatrixXd& moments, const LinearFit& fit) {
  const Eigen::Index y = moments.cols() - 1;
  const auto& c = fit.coefficient;
  return moments(y, y) - 2.0 * c.dot(Eigen::VectorXd(moments(fit.active, y))) +
         c.dot(block(moments, fit.active) * c);
}

Remainder remainder(const Eigen::MatrixXd& moments, const std::vector<Eigen::Index>& active,
                    const Eigen::VectorXd& precision, const Eigen::VectorXd& target) {
  Eigen::MatrixXd a = block(moments, active);
  a.diagonal() += precision(active);
  Eigen::MatrixXd across = moments(active, Eigen::all);
  across.col(moments.cols() - 1) += precision(active).cwiseProduct(target(active));
  Remainder rest;
  rest.moments = moments - across.transpose() * solve(factor_of(a), across);
  rest.rss = rest.moments(moments.cols() - 1, moments.cols() - 1);
  return rest;
}

double gain_of(const Remainder& remainder, const Eigen::MatrixXd& moments, Eigen::Index first,
               Eigen::Index count, Eigen::VectorXd& coefficient) {
  const Eigen::Index y = moments.cols() - 1;
  coefficient = Eigen::VectorXd::Zero(count);
  Eigen::MatrixXd a = remainder.moments.block(first, first, count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double own = moments(first + i, first + i);
    if (!(own > 0.0) || !(a(i, i) > kLeastNew * own)) return 0.0;
  }
  const Eigen::VectorXd b = remainder.moments.block(first, y, count, 1);
  const Normalised factor = factor_of(a);
  coefficient = solve(factor, b);
  const double gain = coefficient.dot(b);
  return std::isfinite(gain) && gain > 0.0 ? gain : 0.0;
}

}  // namespace morepro::host
