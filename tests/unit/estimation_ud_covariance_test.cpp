#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "lib/estimation/ud_covariance.hpp"

namespace morepro {
namespace {

constexpr int kStateCount = 5;
constexpr int kParameters = 3;
using StateMatrix = Eigen::Matrix<double, kStateCount, kStateCount>;
using Ud = UdCovariance<double, kStateCount>;

// 1e-12: some hundred operations in double on numbers of order one.
constexpr double kTolerance = 1.0e-12;

class Randomly {
 public:
  explicit Randomly(unsigned seed) : random_(seed) {}
  double operator()() { return normal_(random_); }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

StateMatrix dense(const Ud& ud) {
  StateMatrix p;
  for (std::size_t i = 0; i < kStateCount; ++i)
    for (std::size_t j = 0; j < kStateCount; ++j)
      p(static_cast<int>(i), static_cast<int>(j)) = ud.covariance(i, j);
  return p;
}

struct Transition {
  std::array<std::array<double, 2>, 2> f;
  std::array<std::array<double, kParameters>, 2> g;
  std::array<double, 2> q;
};

Transition random_transition(Randomly& random) {
  Transition t{};
  for (auto& row : t.f)
    for (double& x : row) x = random();
  for (auto& row : t.g)
    for (double& x : row) x = random();
  for (double& x : t.q) x = 0.1 + std::abs(random());
  return t;
}

StateMatrix dense_prediction(const StateMatrix& p, const Transition& t) {
  StateMatrix phi = StateMatrix::Identity();
  StateMatrix q = StateMatrix::Zero();
  for (std::size_t r = 0; r < 2; ++r) {
    const int row = static_cast<int>(r);
    for (std::size_t c = 0; c < 2; ++c) phi(row, static_cast<int>(c)) = t.f[r][c];
    for (std::size_t c = 0; c < kParameters; ++c) phi(row, static_cast<int>(c) + 2) = t.g[r][c];
    q(row, row) = t.q[r];
  }
  return phi * p * phi.transpose() + q;
}

TEST(UdCovariance, PredictsAndUpdatesLikeTheDenseFilter) {
  Randomly random(1);
  Ud ud({1.0, 2.0, 0.5, 0.3, 4.0});
  StateMatrix p = dense(ud);
  for (int k = 0; k < 50; ++k) {
    const Transition t = random_transition(random);
    ud.predict(t.f, t.g, t.q);
    p = dense_prediction(p, t);
    ASSERT_LE((dense(ud) - p).norm(), kTolerance * p.norm()) << "step " << k;

    const std::size_t measured = static_cast<std::size_t>(k % 2);
    const int m = static_cast<int>(measured);
    const double variance = 0.5;
    const auto update = measured == 0 ? ud.update<0>(variance) : ud.update<1>(variance);
    const double s = p(m, m) + variance;
    const Eigen::Matrix<double, kStateCount, 1> gain = p.col(m) / s;
    p -= gain * s * gain.transpose();
    ASSERT_NEAR(update.innovation_variance, s, kTolerance * s);
    for (std::size_t i = 0; i < kStateCount; ++i)
      ASSERT_NEAR(update.gain[i], gain(static_cast<int>(i)), kTolerance * (1.0 + gain.norm()));
    ASSERT_LE((dense(ud) - p).norm(), kTolerance * (1.0 + p.norm()) * 10.0);
  }
}

TEST(UdCovariance, AddsARankOneMatrix) {
  Randomly random(2);
  Ud ud({1.0, 2.0, 0.5, 0.3, 4.0});
  const Transition t = random_transition(random);
  ud.predict(t.f, t.g, t.q);
  const StateMatrix before = dense(ud);
  Ud::Vector a{};
  Eigen::Matrix<double, kStateCount, 1> column = Eigen::Matrix<double, kStateCount, 1>::Zero();
  for (std::size_t i = 0; i < 4; ++i) column(static_cast<int>(i)) = a[i] = random();
  ud.add_rank_one(a, 3, 0.7);
  EXPECT_LE((dense(ud) - before - 0.7 * column * column.transpose()).norm(), kTolerance * before.norm());
}

TEST(UdCovariance, RestartsOneElementAndLeavesTheOthersAsTheyWere) {
  Randomly random(3);
  for (std::size_t j = 0; j < kStateCount; ++j) {
    Ud ud({1.0, 2.0, 0.5, 0.3, 4.0});
    const Transition t = random_transition(random);
    ud.predict(t.f, t.g, t.q);
    (void)ud.update<0>(0.5);
    StateMatrix expected = dense(ud);
    expected.row(static_cast<int>(j)).setZero();
    expected.col(static_cast<int>(j)).setZero();
    expected(static_cast<int>(j), static_cast<int>(j)) = 9.0;
    ud.restart(j, 9.0);
    EXPECT_LE((dense(ud) - expected).norm(), kTolerance * expected.norm()) << "element " << j;
  }
}

TEST(UdCovariance, StaysPositiveInFloat32WithoutExcitation) {
  // Only the first two elements are ever seen: where Joseph's form turns negative after some 20,000 steps.
  UdCovariance<float, 4> ud({1.0F, 1.0F, 1.0e-2F, 1.0e-2F});
  for (int k = 0; k < 1000000; ++k) {
    ud.predict({{{0.96F, 0.11F}, {-0.15F, 0.54F}}}, {{{1.0e-3F, 0.0F}, {0.0F, 1.0e-3F}}}, {1.0e-6F, 1.0e-6F});
    (void)ud.update<0>(0.25F);
    (void)ud.update<1>(0.01F);
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(ud.variance(i), 0.0F) << i;
}

}  // namespace
}  // namespace morepro
