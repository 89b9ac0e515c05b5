#include <gtest/gtest.h>

#include <cmath>

#include "sim_host/thesis/printed_parameter_filter.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using Filter = host::thesis::PrintedParameterFilter;

/// A matrix of a golden file, by rows.
template <class Matrix>
Matrix matrix_of(const nlohmann::json& values) {
  Matrix matrix;
  for (Eigen::Index k = 0; k < matrix.size(); ++k)
    matrix(k / matrix.cols(), k % matrix.cols()) = values[static_cast<std::size_t>(k)];
  return matrix;
}

Filter::Theta theta_of(const nlohmann::json& values) { return matrix_of<Filter::Theta>(values); }

TEST(PrintedFilterGolden, AStepOfTheThesisFilterMatchesWithItsNaiveCovariance) {
  int cases = 0;
  for (const auto& step : test::golden_json("ekf_steps.json")) {
    if (step["type"] != "param_ekf7") continue;
    const MachineParameters machine = test::golden_machine(step["set"]);
    const Eigen::Matrix3d r = matrix_of<Eigen::Matrix3d>(step["R"]);
    Filter filter(machine, theta_of(step["theta"]), matrix_of<Filter::Covariance>(step["P"]),
                  matrix_of<Filter::Covariance>(step["Q"]), r.diagonal());
    const auto& x = step["x"];
    const auto& u = step["u"];
    filter.step({x[0], x[1], x[2]},
                {.armature_voltage_v = u[0],
                 .feed_force_n = u[1],
                 .contact = u[2],
                 .engagement = machine.feed.engagement,
                 .chip_load_mm = machine.tool.chip_load_mm,
                 .tool_temperature_degc = machine.thermal.tool_degc},
                matrix_of<Filter::Output>(step["y"]));
    const Filter::Theta theta = theta_of(step["theta_post"]);
    const Filter::Covariance p = matrix_of<Filter::Covariance>(step["P_post_naive"]);
    for (int i = 0; i < Filter::kCount; ++i) {
      // A handful of products of condition 1e3: 1e-10, as for the other steps.
      EXPECT_NEAR(filter.theta()(i), theta(i), 1.0e-10 * std::abs(theta(i))) << i;
      for (int j = 0; j < Filter::kCount; ++j)
        EXPECT_NEAR(filter.covariance()(i, j), p(i, j), 1.0e-10 * std::sqrt(p(i, i) * p(j, j)))
            << i << ", " << j;
    }
    ++cases;
  }
  EXPECT_GE(cases, 8);
}

}  // namespace
}  // namespace morepro
