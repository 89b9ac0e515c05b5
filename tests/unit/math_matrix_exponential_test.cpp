#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "lib/math/matrix_exponential.hpp"

namespace morepro {
namespace {

using math::ExponentialStep2;
using math::Matrix2;

double largest(const Matrix2& a) {
  return std::max({std::abs(a.a00), std::abs(a.a01), std::abs(a.a10), std::abs(a.a11)});
}

double distance(const Matrix2& a, const Matrix2& b) {
  return largest({a.a00 - b.a00, a.a01 - b.a01, a.a10 - b.a10, a.a11 - b.a11});
}

/// exp and its integral of the matrix with eigenvalues p, q and eigenvectors (1, 1), (1, -1), from scalar
/// functions.
ExponentialStep2 closed_form(double p, double q, double h) {
  const auto mixed = [](double f, double g) {
    return Matrix2{(f + g) / 2.0, (f - g) / 2.0, (f - g) / 2.0, (f + g) / 2.0};
  };
  const auto integral = [h](double rate) { return rate == 0.0 ? h : std::expm1(rate * h) / rate; };
  return {mixed(std::exp(p * h), std::exp(q * h)), mixed(integral(p), integral(q))};
}

Matrix2 matrix_with(double p, double q) {
  return {(p + q) / 2.0, (p - q) / 2.0, (p - q) / 2.0, (p + q) / 2.0};
}

// Doubling a step multiplies its rounding error by 2; |A h| = 10 takes five doublings: 1e-14 of the norm.
TEST(MatrixExponential, MatchesTheClosedFormForRealEigenvalues) {
  for (const auto& [p, q] : {std::pair{-1.0, -2.0}, {0.0, -3.0}, {-10.0, -0.1}, {1.0, -1.0}, {-5.0, -5.0}}) {
    for (const double h : {1.0e-6, 0.01, 0.3, 1.0}) {
      const ExponentialStep2 step = math::exponential_step(matrix_with(p, q), h);
      const ExponentialStep2 exact = closed_form(p, q, h);
      EXPECT_LE(distance(step.exp, exact.exp), 1.0e-14 * std::max(1.0, largest(exact.exp))) << p << ' ' << h;
      EXPECT_LE(distance(step.integral, exact.integral), 1.0e-14 * h) << p << ' ' << h;
    }
  }
}

TEST(MatrixExponential, RotatesForImaginaryEigenvalues) {
  for (const double angle : {1.0e-3, 0.4, 1.5, 6.0}) {
    const ExponentialStep2 step = math::exponential_step(Matrix2{0.0, -1.0, 1.0, 0.0}, angle);
    EXPECT_NEAR(step.exp.a00, std::cos(angle), 1.0e-14);
    EXPECT_NEAR(step.exp.a10, std::sin(angle), 1.0e-14);
    EXPECT_NEAR(step.integral.a00, std::sin(angle), 1.0e-14 * angle);
    EXPECT_NEAR(step.integral.a10, 1.0 - std::cos(angle), 1.0e-14 * angle);
  }
}

TEST(MatrixExponential, TakesAMatrixWithOneEigenvector) {
  const ExponentialStep2 step = math::exponential_step(Matrix2{-2.0, 1.0, 0.0, -2.0}, 0.7);
  EXPECT_NEAR(step.exp.a00, std::exp(-1.4), 1.0e-15);
  EXPECT_NEAR(step.exp.a01, 0.7 * std::exp(-1.4), 1.0e-15);
  EXPECT_EQ(step.exp.a10, 0.0);
}

TEST(MatrixExponential, IntegralAndExponentialBelongTogether) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> entry(-4.0e3, 4.0e3);
  for (int k = 0; k < 1000; ++k) {
    const Matrix2 a{-std::abs(entry(generator)), entry(generator), entry(generator),
                    -std::abs(entry(generator))};
    const ExponentialStep2 step = math::exponential_step(a, 1.0e-4);
    EXPECT_LE(distance((a * step.integral).plus_identity(), step.exp),
              1.0e-14 * std::max(1.0, largest(step.exp)));
  }
}

TEST(MatrixExponential, FloatIsWithinTenRoundingsOfDouble) {
  const Matrix2 a{-300.0, 1500.0, -2000.0, -6000.0};
  for (const double h : {5.0e-5, 1.0e-4, 1.0e-3}) {
    const auto exact = math::exponential_step(a, h);
    const auto rounded = math::exponential_step(
        math::BasicMatrix2<float>{-300.0F, 1500.0F, -2000.0F, -6000.0F}, static_cast<float>(h));
    const auto& r = rounded.integral;
    EXPECT_LE(distance({double{r.a00}, double{r.a01}, double{r.a10}, double{r.a11}}, exact.integral),
              6.0e-7 * h);
  }
}

TEST(MatrixExponential, ZeroMatrixIsAnIntegrator) {
  const ExponentialStep2 step = math::exponential_step(Matrix2{}, 0.25);
  EXPECT_EQ(step.exp.a00, 1.0);
  EXPECT_EQ(step.exp.a01, 0.0);
  EXPECT_EQ(step.integral.a11, 0.25);
}

TEST(MatrixExponential, EndsAndSaysNanForWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(math::exponential_step(Matrix2{infinity, 0.0, 0.0, 0.0}, 1.0).exp.a00));
  EXPECT_TRUE(std::isnan(math::exponential_step(Matrix2{-1.0, 0.0, 0.0, 0.0}, std::nan("")).exp.a00));
}

}  // namespace
}  // namespace morepro
