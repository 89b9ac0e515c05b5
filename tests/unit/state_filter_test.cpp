#include "lib/estimation/state_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <random>

#include "lib/plant/built_in_machines.hpp"

namespace morepro {
namespace {

constexpr double kFilterPeriodS = 1.0e-4;

template <class Real>
typename StateFilter<Real>::Covariances covariances() {
  using Vector = typename StateFilter<Real>::Vector;
  return {.initial = Vector(Real(1), Real(4.0e-6), Real(2.5e-3)).asDiagonal(),
          .process = Vector(Real(4.0e-4), Real(1.0e-8), Real(1.0e-4)).asDiagonal(),
          .measurement = Vector(Real(1), Real(4.0e-6), Real(2.5e-3)).asDiagonal()};
}

PlantState<double> operating_point() { return {577.7, 0.02, 2.226}; }

template <class Real>
PlantState<Real> rounded(const PlantState<double>& x) {
  return {static_cast<Real>(x.speed_rad_s), static_cast<Real>(x.feed_speed_m_s),
          static_cast<Real>(x.current_a)};
}

template <class Real>
StateFilter<Real> filter_at_operating_point() {
  return StateFilter<Real>(reference_machine(), kFilterPeriodS, rounded<Real>(operating_point()),
                           covariances<Real>());
}

template <class Real>
PlantInput<Real> cutting() {
  return {.armature_voltage_v = Real(48),
          .feed_force_n = Real(26),
          .contact = Real(1),
          .engagement = Real(1),
          .chip_load_mm = Real(0.05),
          .tool_temperature_degc = Real(500)};
}

/// The machine with the noise that the filter expects.
class NoisyMachine {
 public:
  explicit NoisyMachine(unsigned seed) : generator_(seed) {}

  void step(const PlantInput<double>& input) {
    x_ = disturbed(integrator_.step(x_, input), {0.02, 1.0e-4, 0.01});
  }
  PlantState<double> measured() { return disturbed(x_, {1.0, 0.002, 0.05}); }
  const PlantState<double>& truth() const { return x_; }

 private:
  PlantState<double> disturbed(const PlantState<double>& x, const PlantState<double>& sigma) {
    const double w = x.speed_rad_s + sigma.speed_rad_s * normal_(generator_);
    const double v = x.feed_speed_m_s + sigma.feed_speed_m_s * normal_(generator_);
    return {w, v, x.current_a + sigma.current_a * normal_(generator_)};
  }

  std::mt19937 generator_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  Rk4Integrator<double> integrator_{reference_machine(), kFilterPeriodS};
  PlantState<double> x_ = operating_point();
};

Eigen::Vector3d error_of(const PlantState<float>& estimate, const PlantState<double>& truth) {
  return {double{estimate.speed_rad_s} - truth.speed_rad_s,
          double{estimate.feed_speed_m_s} - truth.feed_speed_m_s,
          double{estimate.current_a} - truth.current_a};
}

// Means of 20000 squares with 3 degrees of freedom: sigma sqrt(6/20000) = 0.017 for the white innovations;
// the state errors are correlated over about 30 steps: 0.1. Five sigma.
TEST(StateFilter, InnovationsAndErrorsHaveTheClaimedSize) {
  constexpr int kSteps = 20000;
  constexpr unsigned kSeed = 5;
  NoisyMachine machine(kSeed);
  StateFilter<float> filter = filter_at_operating_point<float>();
  double nis = 0.0;
  double nees = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    machine.step(cutting<double>());
    filter.predict(cutting<float>());
    const auto result = filter.update(rounded<float>(machine.measured()));
    ASSERT_EQ(result.status, UpdateStatus::kAccepted);
    nis += double{result.nis} / kSteps;
    const Eigen::Vector3d error = error_of(filter.state(), machine.truth());
    nees += error.dot(filter.covariance().cast<double>().llt().solve(error)) / kSteps;
  }
  EXPECT_NEAR(nis, 3.0, 0.09) << "seed " << kSeed;
  EXPECT_NEAR(nees, 3.0, 0.5) << "seed " << kSeed;
}

TEST(StateFilter, CovarianceStaysSymmetricAndPositiveInFloat) {
  StateFilter<float> filter = filter_at_operating_point<float>();
  for (int k = 0; k < 100000; ++k) {
    PlantInput<float> input = cutting<float>();
    input.contact = k % 2000 < 1000 ? 1.0F : 0.0F;
    filter.predict(input);
    ASSERT_EQ(filter.update(filter.state()).status, UpdateStatus::kAccepted);
    const auto& p = filter.covariance();
    ASSERT_EQ((p - p.transpose()).cwiseAbs().maxCoeff(), 0.0F);
    ASSERT_TRUE((math::Ldl<float, 3>(p).is_positive())) << "step " << k;
  }
}

TEST(StateFilter, LeavesItsStateAloneForAMeasurementThatIsNotFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    StateFilter<float> filter = filter_at_operating_point<float>();
    filter.predict(cutting<float>());
    const PlantState<float> before = filter.state();
    const auto covariance = filter.covariance();
    PlantState<float> measured = before;
    measured.current_a = bad;
    EXPECT_EQ(filter.update(measured).status, UpdateStatus::kNotFinite);
    EXPECT_EQ(filter.state().speed_rad_s, before.speed_rad_s);
    EXPECT_EQ(filter.covariance(), covariance);
  }
}

TEST(StateFilter, GatesWhatIsTooFarAndSaysHowFar) {
  StateFilter<float> filter = filter_at_operating_point<float>();
  filter.predict(cutting<float>());
  const PlantState<float> before = filter.state();
  PlantState<float> spike = before;
  spike.speed_rad_s += 100.0F;
  const auto result = filter.update(spike, 25.0F);
  EXPECT_EQ(result.status, UpdateStatus::kGated);
  EXPECT_NEAR(double{result.nis}, 100.0 * 100.0 / (1.0 + 1.0), 0.05 * 5000.0);
  EXPECT_EQ(result.innovation(kSpeedIndex), 100.0F);
  EXPECT_EQ(filter.state().speed_rad_s, before.speed_rad_s);
  EXPECT_EQ(filter.update(before, 25.0F).status, UpdateStatus::kAccepted);
}

TEST(StateFilter, SaysWhenItsCovarianceIsNotPositive) {
  auto broken = covariances<float>();
  broken.initial(0, 0) = -5.0F;
  StateFilter<float> filter(reference_machine(), kFilterPeriodS, {}, broken);
  EXPECT_EQ(filter.update({}).status, UpdateStatus::kNotPositive);
  EXPECT_EQ(filter.covariance()(0, 0), -5.0F);
}

TEST(StateFilter, VarianceGrowsWithoutMeasurements) {
  StateFilter<float> filter = filter_at_operating_point<float>();
  for (int k = 0; k < 5000; ++k) {
    filter.predict(cutting<float>());
    (void)filter.update(filter.state());
  }
  const auto fed = filter.covariance();
  for (int k = 0; k < 200; ++k) filter.predict(cutting<float>());
  for (int i = 0; i < 3; ++i) EXPECT_GT(filter.covariance()(i, i), 1.5F * fed(i, i)) << i;
}

TEST(StateFilter, ThesisOutputsAreTheModelsAccelerationAndTheCurrent) {
  const StateFilter<double> filter = filter_at_operating_point<double>();
  const auto output = filter.thesis_output(cutting<double>());
  EXPECT_EQ(output.current_a, operating_point().current_a);
  EXPECT_EQ(output.acceleration_rad_s2, Plant<double>(reference_machine())
                                            .derivative(operating_point(), cutting<double>())
                                            .acceleration_rad_s2);
}

}  // namespace
}  // namespace morepro
