#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lib/estimation/state_filter.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using nlohmann::json;
using test::golden_machine;
using Matrix3 = Eigen::Matrix<double, 3, 3>;

template <class Real>
PlantState<Real> state_of(const json& x) {
  return {static_cast<Real>(x[0].get<double>()), static_cast<Real>(x[1].get<double>()),
          static_cast<Real>(x[2].get<double>())};
}

template <class Real>
PlantInput<Real> plant_input_of(const json& step) {
  const MachineParameters machine = golden_machine(step["set"]);
  return {.armature_voltage_v = static_cast<Real>(step["u"][0].get<double>()),
          .feed_force_n = static_cast<Real>(step["u"][1].get<double>()),
          .contact = static_cast<Real>(step["u"][2].get<double>()),
          .engagement = static_cast<Real>(machine.feed.engagement),
          .chip_load_mm = static_cast<Real>(machine.tool.chip_load_mm),
          .tool_temperature_degc = static_cast<Real>(machine.thermal.tool_degc)};
}

template <class Real>
StateFilter<Real> filter_of(const json& step) {
  return StateFilter<Real>(golden_machine(step["set"]), step["h"], state_of<Real>(step["x"]),
                           {.initial = test::golden_matrix<Matrix3>(step["P"]).cast<Real>(),
                            .process = test::golden_matrix<Matrix3>(step["Q"]).cast<Real>(),
                            .measurement = test::golden_matrix<Matrix3>(step["R"]).cast<Real>()});
}

template <class Real>
void expect_state(const PlantState<Real>& x, const json& expected, const Matrix3& scale, double tolerance) {
  const PlantState<double> y = state_of<double>(expected);
  EXPECT_NEAR(double(x.speed_rad_s), y.speed_rad_s,
              tolerance * (std::abs(y.speed_rad_s) + std::sqrt(scale(0, 0))));
  EXPECT_NEAR(double(x.feed_speed_m_s), y.feed_speed_m_s,
              tolerance * (std::abs(y.feed_speed_m_s) + std::sqrt(scale(1, 1))));
  EXPECT_NEAR(double(x.current_a), y.current_a, tolerance * (std::abs(y.current_a) + std::sqrt(scale(2, 2))));
}

/// Entries relative to sqrt(P_ii P_jj).
void expect_covariance(const Matrix3& p, const Matrix3& expected, double tolerance) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(p(i, j), expected(i, j), tolerance * std::sqrt(expected(i, i) * expected(j, j)));
    }
  }
}

struct StateTolerance {
  double estimate;    ///< of the state, relative to it plus its sigma, and of covariances
  double likelihood;  ///< of the normalised innovation squared, relative
};

// One step is about 300 operations in double and a well-conditioned 3x3 solution.
constexpr StateTolerance kStateDouble{1.0e-10, 1.0e-10};

// In float an estimate is within ten roundings of 6e-8. An innovation is a difference of two speeds near 600
// rad/s, each rounded to 3e-5 rad/s = 1e-4 sigma at worst; its square has twice that error relative to one
// sigma.
constexpr StateTolerance kStateFloat{1.0e-6, 1.0e-4};

template <class Real>
void expect_step(const json& step, const StateTolerance& tolerance) {
  StateFilter<Real> filter = filter_of<Real>(step);
  const PlantInput<Real> input = plant_input_of<Real>(step);
  filter.predict(input);
  const Matrix3 predicted = test::golden_matrix<Matrix3>(step["P_pred"]);
  expect_state(filter.state(), step["x_pred"], predicted, tolerance.estimate);
  expect_covariance(filter.covariance().template cast<double>(), predicted, tolerance.estimate);

  const UpdateResult<Real> result = filter.update(state_of<Real>(step["y"]));
  EXPECT_EQ(result.status, UpdateStatus::kAccepted);
  const Matrix3 posterior = test::golden_matrix<Matrix3>(step["P_post"]);
  expect_state(filter.state(), step["x_post"], posterior, tolerance.estimate);
  expect_covariance(filter.covariance().template cast<double>(), posterior, tolerance.estimate);
  EXPECT_NEAR(double(result.nis), step["NIS"], tolerance.likelihood * step["NIS"].get<double>());
  EXPECT_NEAR(double(result.log_likelihood), step["loglik"],
              tolerance.likelihood * (step["NIS"].get<double>() + 10.0));
}

TEST(StateFilterGolden, StepsMatchInDouble) {
  test::for_every_golden_step("state_ekf3",
                              [](const json& step) { expect_step<double>(step, kStateDouble); });
}

TEST(StateFilterGolden, StepsMatchInFloat) {
  test::for_every_golden_step("state_ekf3", [](const json& step) { expect_step<float>(step, kStateFloat); });
}

TEST(StateFilterGolden, TransitionMatchesInDouble) {
  test::for_every_golden_step("state_ekf3", [](const json& step) {
    const auto phi = filter_of<double>(step).transition(plant_input_of<double>(step));
    EXPECT_LE((phi - test::golden_matrix<Matrix3>(step["Phi"])).cwiseAbs().maxCoeff(), 1.0e-12);
  });
}

TEST(StateFilterGolden, ThesisOutputsMatchInDouble) {
  test::for_every_golden_step("state_ekf3", [](const json& step) {
    StateFilter<double> filter = filter_of<double>(step);
    filter.predict(plant_input_of<double>(step));
    ASSERT_EQ(filter.update(state_of<double>(step["y"])).status, UpdateStatus::kAccepted);
    const auto output = filter.thesis_output(plant_input_of<double>(step));
    const double acceleration = step["bank_out_dw_i"][0];
    EXPECT_NEAR(output.acceleration_rad_s2, acceleration, 1.0e-10 * std::abs(acceleration));
    EXPECT_NEAR(output.current_a, step["bank_out_dw_i"][1], 1.0e-10 * output.current_a);
  });
}

}  // namespace
}  // namespace morepro
