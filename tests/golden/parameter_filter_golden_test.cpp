#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "lib/identification/derivative_rows.hpp"
#include "lib/identification/ud_block.hpp"
#include "lib/plant/contact_law.hpp"
#include "lib/plant/parameter.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using nlohmann::json;
using test::golden_machine;

template <class Real>
using Seven = UdBlock<Real, kParameterCount>;
template <class Real>
using Vector = typename Seven<Real>::Vector;

template <class Real>
Vector<Real> vector_of(const json& numbers) {
  Vector<Real> v{};
  for (std::size_t j = 0; j < v.size(); ++j) v[j] = static_cast<Real>(numbers.at(j).get<double>());
  return v;
}

template <class Real>
typename Seven<Real>::Matrix matrix_of(const json& numbers) {
  typename Seven<Real>::Matrix m{};
  for (std::size_t k = 0; k < kParameterCount * kParameterCount; ++k)
    m[k / kParameterCount][k % kParameterCount] = static_cast<Real>(numbers.at(k).get<double>());
  return m;
}

template <class Real>
DerivativeInput<Real> input_of(const json& step) {
  const MachineParameters machine = golden_machine(step["set"]);
  const auto x = [&](std::size_t k) { return static_cast<Real>(step["x"][k].get<double>()); };
  const auto u = [&](std::size_t k) { return static_cast<Real>(step["u"][k].get<double>()); };
  const ContactLaw<Real> law(machine);
  const Real torque =
      law(x(0), static_cast<Real>(machine.tool.chip_load_mm), static_cast<Real>(machine.thermal.tool_degc))
          .torque_nm;
  return {x(0), x(1), x(2), u(0), u(1), u(2), static_cast<Real>(machine.feed.engagement), u(2) * torque};
}

/// A row among all seven parameters, its first slope at `first`.
template <class Real, std::size_t kN>
DerivativeRow<Real, kParameterCount> widened(const DerivativeRow<Real, kN>& row, std::size_t first) {
  DerivativeRow<Real, kParameterCount> wide{.derivative = row.derivative};
  for (std::size_t j = 0; j < kN; ++j) wide.slope[first + j] = row.slope[j];
  return wide;
}

template <class Real>
std::array<DerivativeRow<Real, kParameterCount>, 3> rows_of(const json& step) {
  const auto machine = golden_machine(step["set"]);
  const auto theta = vector_of<Real>(step["theta"]);
  const auto u = input_of<Real>(step);
  const auto friction = static_cast<Real>(machine.spindle.viscous_friction_nms_rad);
  return {widened(torque_row<Real>({theta[0], theta[1]}, friction, u), 0),
          widened(force_row<Real>({theta[2], theta[3]}, static_cast<Real>(machine.feed.viscous_friction_ns_m),
                                  static_cast<Real>(machine.feed.contact_offset_n), u),
                  2),
          widened(voltage_row<Real>({theta[4], theta[5], theta[6]}, u), 4)};
}

/// P and theta after the three outputs, one after the other: the same as all at once, because R is diagonal.
template <class Real>
struct Posterior {
  Vector<Real> theta;
  Seven<Real> covariance;
};

template <class Real>
Posterior<Real> posterior_of(const json& step) {
  Posterior<Real> result{vector_of<Real>(step["theta"]), Seven<Real>::of(matrix_of<Real>(step["P"]))};
  for (std::size_t j = 0; j < kParameterCount; ++j)
    result.covariance.add_variance(j, static_cast<Real>(step["Q"][8 * j].get<double>()));
  const auto prior = result.theta;
  const auto rows = rows_of<Real>(step);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto update =
        result.covariance.update(rows[r].slope, static_cast<Real>(step["R"][4 * r].get<double>()));
    Real innovation = static_cast<Real>(step["y"][r].get<double>()) - rows[r].derivative;
    for (std::size_t j = 0; j < kParameterCount; ++j)
      innovation -= rows[r].slope[j] * (result.theta[j] - prior[j]);
    for (std::size_t j = 0; j < kParameterCount; ++j)
      result.theta[j] += update.direction[j] * (innovation * update.inverse_variance);
  }
  return result;
}

/// `tolerance` relative to sqrt(P_ii P_jj), and of theta to its value.
template <class Real>
void expect_posterior(const json& step, double tolerance) {
  const auto result = posterior_of<Real>(step);
  const auto theta = vector_of<double>(step["theta_post"]);
  const auto p = matrix_of<double>(step["P_post_joseph"]);
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    EXPECT_NEAR(double(result.theta[i]), theta[i], tolerance * std::abs(theta[i])) << i;
    for (std::size_t j = 0; j < kParameterCount; ++j)
      EXPECT_NEAR(double(result.covariance.covariance(i, j)), p[i][j],
                  tolerance * std::sqrt(p[i][i] * p[j][j]))
          << i << " " << j;
  }
}

TEST(ParameterFilterGolden, RowsMatchEquation22) {
  test::for_every_golden_step("param_ekf7", [](const json& step) {
    const auto rows = rows_of<double>(step);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      EXPECT_NEAR(rows[r].derivative, step["g"][r], 1.0e-12 * std::abs(step["g"][r].get<double>()));
      for (std::size_t j = 0; j < kParameterCount; ++j) {
        const double expected = step["C"][kParameterCount * r + j];
        EXPECT_NEAR(rows[r].slope[j], expected, 1.0e-12 * std::abs(expected)) << r << " " << j;
      }
    }
  });
}

TEST(ParameterFilterGolden, StepsMatchInDouble) {
  test::for_every_golden_step("param_ekf7",
                              [](const json& step) { expect_posterior<double>(step, 1.0e-10); });
}

// In float a balance is a difference of terms up to thirty times its result, each rounded to 6e-8: an
// innovation is right to some 1e-6 of the largest term, and the parameters and P of a 7x7 prior whose
// correlations amplify it by ten to 2e-5.
TEST(ParameterFilterGolden, StepsMatchInFloat) {
  test::for_every_golden_step("param_ekf7", [](const json& step) { expect_posterior<float>(step, 2.0e-5); });
}

}  // namespace
}  // namespace morepro
