#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/kinematics/chain.hpp"
#include "lib/kinematics/morepro_machine.hpp"
#include "tests/support/golden.hpp"

namespace morepro::kinematics {
namespace {

using test::golden_json;

// Products of four matrices of numbers up to 1, each operation 1.1e-16.
constexpr double kDoubleTolerance = 1.0e-14;
// A float rounds sizes up to 1 by 6e-8 and sines by 1.2e-7; joint values up to pi add the rounding of the
// angle itself, 1.2e-7: three of each make 1e-6.
constexpr double kFloatTolerance = 1.0e-6;

nlohmann::json golden_points() { return golden_json("kin.json")["points"]; }

template <class Real>
JointVector<Real> joints_of(const nlohmann::json& point) {
  JointVector<Real> q{};
  for (std::size_t i = 0; i < 4; ++i) q[i] = static_cast<Real>(point["q"][i].get<double>());
  return q;
}

template <class Matrix>
double largest_difference(const Matrix& ours, const nlohmann::json& rows, int columns) {
  double worst = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int row = static_cast<int>(k) / columns;
    const int column = static_cast<int>(k) % columns;
    worst = std::max(worst, std::abs(static_cast<double>(ours(row, column)) - rows[k].get<double>()));
  }
  return worst;
}

template <class Real>
double worst_frame(const nlohmann::json& point) {
  const auto frames = Chain<Real>(morepro_table()).frames(joints_of<Real>(point));
  constexpr std::array kNames{"T1", "T2", "T3", "T4"};
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    worst = std::max(worst, largest_difference(frames.frame[i + 1].matrix(), point[kNames[i]], 4));
  return worst;
}

template <class Real>
double worst_jacobian(const nlohmann::json& point) {
  const Chain<Real> chain(morepro_table());
  return largest_difference(chain.jacobian(chain.frames(joints_of<Real>(point))), point["J"], 4);
}

TEST(KinematicsGolden, FramesMatch) {
  for (const auto& point : golden_points()) {
    EXPECT_LE(worst_frame<double>(point), kDoubleTolerance) << point["q"];
    EXPECT_LE(worst_frame<float>(point), kFloatTolerance) << point["q"];
  }
}

TEST(KinematicsGolden, JacobianMatches) {
  for (const auto& point : golden_points()) {
    EXPECT_LE(worst_jacobian<double>(point), kDoubleTolerance) << point["q"];
    EXPECT_LE(worst_jacobian<float>(point), kFloatTolerance) << point["q"];
  }
}

TEST(KinematicsGolden, TheBuiltInOffsetsAreTheGoldenOnes) {
  const auto geo = golden_json("kin.json")["geo"];
  const MachineGeometry offsets;
  EXPECT_EQ(offsets.a1_m, geo["a1"]);
  EXPECT_EQ(offsets.a2_m, geo["a2"]);
  EXPECT_EQ(offsets.a3_m, geo["a3"]);
  EXPECT_EQ(offsets.a4_m, geo["a4"]);
}

// As printed, Table 1 and equation 2's T4 contradict T2, T3 and the Jacobian: the corrections are needed.
TEST(KinematicsGolden, TheThesisAsPrintedDiffers) {
  DhTable printed = morepro_table();
  printed.joints[1].theta_rad = 0.0;
  double turn = 0.0;
  for (const auto& point : golden_points()) {
    const auto q = joints_of<double>(point);
    const auto as_printed = Chain<double>(printed).frames(q).tool().matrix();
    const auto corrected = Chain<double>(morepro_table()).frames(q).tool().matrix();
    EXPECT_LE(largest_difference(as_printed, point["T4_with_table1_theta2_0"], 4), kDoubleTolerance);
    EXPECT_GT((as_printed - corrected).cwiseAbs().maxCoeff(), 0.5);
    turn = std::max(turn, largest_difference(corrected, point["T4_thesis_eq2"], 4));
  }
  EXPECT_GT(turn, 0.5);
}

}  // namespace
}  // namespace morepro::kinematics
