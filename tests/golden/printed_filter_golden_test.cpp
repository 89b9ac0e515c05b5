#include <gtest/gtest.h>

#include <cmath>

#include "sim_host/thesis/printed_parameter_filter.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using Filter = host::thesis::PrintedParameterFilter;

Filter::Theta theta_of(const nlohmann::json& values) { return test::golden_matrix<Filter::Theta>(values); }

TEST(PrintedFilterGolden, AStepOfTheThesisFilterMatchesWithItsNaiveCovariance) {
  int cases = 0;
  for (const auto& step : test::golden_json("ekf_steps.json")) {
    if (step["type"] != "param_ekf7") continue;
    const MachineParameters machine = test::golden_machine(step["set"]);
    const Eigen::Matrix3d r = test::golden_matrix<Eigen::Matrix3d>(step["R"]);
    Filter filter(machine, theta_of(step["theta"]), test::golden_matrix<Filter::Covariance>(step["P"]),
                  test::golden_matrix<Filter::Covariance>(step["Q"]), r.diagonal());
    const auto& x = step["x"];
    const auto& u = step["u"];
    filter.step({x[0], x[1], x[2]},
                {.armature_voltage_v = u[0],
                 .feed_force_n = u[1],
                 .contact = u[2],
                 .engagement = machine.feed.engagement,
                 .chip_load_mm = machine.tool.chip_load_mm,
                 .tool_temperature_degc = machine.thermal.tool_degc},
                test::golden_matrix<Filter::Output>(step["y"]));
    const Filter::Theta theta = theta_of(step["theta_post"]);
    const Filter::Covariance p = test::golden_matrix<Filter::Covariance>(step["P_post_naive"]);
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
