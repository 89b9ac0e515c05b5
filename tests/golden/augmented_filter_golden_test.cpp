#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "lib/plant/dynamics.hpp"
#include "lib/plant/integrators.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using nlohmann::json;
using test::golden_machine;

constexpr int kStates = 10;
using State = Eigen::Matrix<double, kStates, 1>;
using Matrix = Eigen::Matrix<double, kStates, kStates>;

template <class Wanted>
Wanted matrix_of(const json& numbers) {
  Wanted m;
  for (int i = 0; i < m.size(); ++i)
    m(i / m.cols(), i % m.cols()) = numbers.at(static_cast<std::size_t>(i)).get<double>();
  return m;
}

MachineParameters machine_of(const json& step) {
  MachineParameters machine = golden_machine(step["set"]);
  const auto theta = [&](std::size_t j) { return step["theta"][j].get<double>(); };
  machine.spindle.torque_constant_nm_a = theta(0);
  machine.spindle.inertia_kgm2 = theta(1);
  machine.feed.mass_kg = theta(2);
  machine.feed.contact_force_n = theta(3);
  machine.spindle.inductance_h = theta(4);
  machine.spindle.resistance_ohm = theta(5);
  machine.spindle.back_emf_constant_vs_rad = theta(6);
  return machine;
}

/// One step of the dense filter over [w, v, i, logarithms of the seven parameters]: what the library's two
/// smaller filters are blocks of. Its transition is made of the plant's own Jacobians.
class AugmentedStep {
 public:
  explicit AugmentedStep(const json& step)
      : machine_(machine_of(step)), plant_(machine_), h_(step["h"].get<double>()) {
    x_ = {step["x"][0].get<double>(), step["x"][1].get<double>(), step["x"][2].get<double>()};
    u_ = {.armature_voltage_v = step["u"][0].get<double>(),
          .feed_force_n = step["u"][1].get<double>(),
          .contact = step["u"][2].get<double>(),
          .engagement = machine_.feed.engagement,
          .chip_load_mm = machine_.tool.chip_load_mm,
          .tool_temperature_degc = machine_.thermal.tool_degc};
  }

  [[nodiscard]] Matrix transition() const {
    using Matrix3 = Eigen::Matrix3d;
    const Matrix3 z = h_ * plant_.state_jacobian(x_, u_);
    const Matrix3 one = Matrix3::Identity();
    const Matrix3 z2 = z * z, z3 = z2 * z, z4 = z3 * z;
    Eigen::Matrix<double, 7, 1> theta;
    for (int j = 0; j < 7; ++j) theta(j) = plant_.theta()[static_cast<std::size_t>(j)];
    Matrix phi = Matrix::Identity();
    phi.topLeftCorner<3, 3>() = one + z + z2 / 2.0 + z3 / 6.0 + z4 / 24.0;
    phi.topRightCorner<3, 7>() =
        h_ * (one + z / 2.0 + z2 / 6.0 + z3 / 24.0) * plant_.parameter_jacobian(x_, u_) * theta.asDiagonal();
    return phi;
  }

  [[nodiscard]] Eigen::Vector3d predicted() const {
    const auto x = Rk4Integrator<double>(machine_, h_).step(x_, u_);
    return {x.speed_rad_s, x.feed_speed_m_s, x.current_a};
  }

 private:
  MachineParameters machine_;
  Plant<double> plant_;
  double h_;
  PlantState<double> x_;
  PlantInput<double> u_;
};

void expect_step(const json& step) {
  const AugmentedStep filter(step);
  const Matrix phi = filter.transition();
  EXPECT_LE((phi - matrix_of<Matrix>(step["Phi"])).cwiseAbs().maxCoeff(),
            1.0e-10 * phi.cwiseAbs().maxCoeff());
  const Eigen::Vector3d x = filter.predicted();
  const Matrix p = phi * matrix_of<Matrix>(step["P"]) * phi.transpose() + matrix_of<Matrix>(step["Q"]);
  const Eigen::Matrix3d s = p.topLeftCorner<3, 3>() + matrix_of<Eigen::Matrix3d>(step["R"]);
  const Eigen::Matrix<double, kStates, 3> gain = p.leftCols<3>() * s.inverse();
  const Eigen::Vector3d innovation = matrix_of<Eigen::Vector3d>(step["y"]) - x;
  const State moved = gain * innovation;
  for (int k = 0; k < 3; ++k) {
    const double expected = step["x_post"][static_cast<std::size_t>(k)];
    EXPECT_NEAR(x(k) + moved(k), expected, 1.0e-10 * (1.0 + std::abs(expected)));
  }
  for (std::size_t j = 0; j < 7; ++j) {
    const double expected = step["theta_post"][j];
    const double found = step["theta"][j].get<double>() * std::exp(moved(static_cast<int>(j) + 3));
    EXPECT_NEAR(found, expected, 1.0e-10 * std::abs(expected));
  }
  const Matrix after = p - gain * p.topRows<3>();
  const auto expected = matrix_of<Matrix>(step["P_post"]);
  for (int i = 0; i < kStates; ++i)
    for (int j = 0; j < kStates; ++j)
      EXPECT_NEAR(after(i, j), expected(i, j), 1.0e-9 * std::sqrt(expected(i, i) * expected(j, j)))
          << i << " " << j;
}

TEST(AugmentedFilterGolden, StepsMatchInDouble) {
  int count = 0;
  for (const json& step : test::golden_json("ekf_steps.json")) {
    if (step["type"] != "augmented_ekf10") continue;
    SCOPED_TRACE(step["set"].get<std::string>() + " " + std::to_string(count++));
    expect_step(step);
  }
  EXPECT_EQ(count, 8);
}

}  // namespace
}  // namespace morepro
