#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/plant/cutting_force.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using test::golden_csv;
using test::GoldenRow;

constexpr double kDegree = std::numbers::pi / 180.0;

// 200 slices of some 2 N, each with a few roundings: 1e-11 N in double. In float 100 slices at 1.2e-7 in the
// angle and as much in the sum stay below 1e-5 of the 100 N.
template <class Real>
constexpr double kTolerance = sizeof(Real) == sizeof(double) ? 1.0e-11 : 1.0e-3;

template <class Real>
class CuttingForceGolden : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(CuttingForceGolden, Scalars);

TYPED_TEST(CuttingForceGolden, ForcesAndTorqueMatchOverATurn) {
  const CuttingForceModel<TypeParam> model{MillingCut{}};
  for (const GoldenRow& row : golden_csv("force_model.csv")) {
    const auto force = model.at(static_cast<TypeParam>(row["phi_deg"] * kDegree));
    EXPECT_NEAR(double{force.x_n}, row["Fx_N"], kTolerance<TypeParam>) << row["phi_deg"];
    EXPECT_NEAR(double{force.y_n}, row["Fy_N"], kTolerance<TypeParam>) << row["phi_deg"];
    EXPECT_NEAR(double{force.axial_n}, row["Fz_N"], kTolerance<TypeParam>) << row["phi_deg"];
    EXPECT_NEAR(double{force.tangential_n}, row["Ft_sum_N"], kTolerance<TypeParam>) << row["phi_deg"];
    EXPECT_NEAR(double{force.torque_nm}, row["torque_Nm"], kTolerance<TypeParam> * 0.005) << row["phi_deg"];
  }
}

TYPED_TEST(CuttingForceGolden, CoefficientsMatchCorrectedAndAsPrinted) {
  const CuttingForceModel<TypeParam> model{MillingCut{}};
  for (const GoldenRow& row : golden_csv("force_model.csv")) {
    EXPECT_NEAR(double{model.friction_coefficient()}, row["mu_corrected"], kTolerance<TypeParam>);
    // A full turn may round to just above 0, where the tooth begins to cut.
    if (row["phi_deg"] == 360.0) continue;
    const auto literal = model.literal_coefficient(static_cast<TypeParam>(row["phi_deg"] * kDegree));
    EXPECT_EQ(literal.is_defined, row["phi_deg"] > 0.0 && row["phi_deg"] < 180.0) << row["phi_deg"];
    // Beside the pole the tangent's slope is 1 + tan^2.
    const double expected = row["beta_thesis_single_tooth"];
    EXPECT_NEAR(double{literal.value}, expected, kTolerance<TypeParam> * (1.0 + expected * expected));
  }
}

}  // namespace
}  // namespace morepro
