#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lib/kinematics/clik.hpp"
#include "lib/kinematics/morepro_machine.hpp"
#include "lib/kinematics/path.hpp"
#include "tests/support/golden.hpp"

namespace morepro::kinematics {
namespace {

using test::golden_csv;
using test::GoldenRow;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

template <class Real>
Transform<Real> golden_placement() {
  const Vector3<Real> angles(Real(15.0 * kDegree), Real(-20.0 * kDegree), Real(30.0 * kDegree));
  return {rotation_of(angles), Vector3<Real>(Real(0.30), Real(0.10), Real(0.40))};
}

template <class Real>
Path<Real, 4> golden_path() {
  constexpr std::array kDurations{0.0, 2.0, 1.5, 2.0};
  Path<Real, 4> path(golden_placement<Real>());
  std::size_t i = 0;
  for (const GoldenRow& row : golden_csv("path_points.csv")) {
    const Waypoint<Real> point{{Real(row["xl"]), Real(row["yl"]), Real(row["zl"])}, {Real(row["phi"]), 0, 0}};
    EXPECT_EQ(path.add(point, Real(kDurations[i++])), PathError::kNone);
  }
  return path;
}

template <class Real>
double difference(const ToolState<Real>& ours, const GoldenRow& row) {
  const std::array position{row["x"], row["y"], row["z"], row["phi"]};
  const std::array speed{row["vx"], row["vy"], row["vz"], row["vphi"]};
  double worst = std::abs(double{ours.angles_rad(0)} - position[3]);
  for (int k = 0; k < 3; ++k)
    worst = std::max(worst, std::abs(double{ours.position_m(k)} - position[static_cast<std::size_t>(k)]));
  for (int k = 0; k < 4; ++k)
    worst = std::max(worst, std::abs(double{ours.speed(k)} - speed[static_cast<std::size_t>(k)]));
  return worst;
}

template <class Real>
double acceleration_difference(const ToolState<Real>& ours, const GoldenRow& row) {
  const std::array wanted{row["ax"], row["ay"], row["az"], row["aphi"]};
  double worst = 0.0;
  for (int k = 0; k < 4; ++k)
    worst = std::max(worst, std::abs(double{ours.acceleration(k)} - wanted[static_cast<std::size_t>(k)]));
  return worst;
}

/// The acceleration jumps there: the last bit of the time decides.
bool is_at_corner(double t) {
  for (const double corner : {2.0 / 3.0, 4.0 / 3.0, 2.0, 2.5, 3.0, 3.5, 3.5 + 2.0 / 3.0, 3.5 + 4.0 / 3.0}) {
    if (std::abs(t - corner) < 1.0e-6) return true;
  }
  return false;
}

TEST(TrajectoryGolden, PlacedPointsMatch) {
  for (const GoldenRow& row : golden_csv("path_points.csv")) {
    const Vector3<double> placed =
        golden_placement<double>() * Vector3<double>(row["xl"], row["yl"], row["zl"]);
    EXPECT_LE((placed - Vector3<double>(row["x"], row["y"], row["z"])).cwiseAbs().maxCoeff(), 1.0e-15);
  }
}

TEST(TrajectoryGolden, OperationalStatesMatch) {
  const auto path = golden_path<double>();
  EXPECT_EQ(path.duration_s(), 5.5);
  for (const GoldenRow& row : golden_csv("traj_operational.csv")) {
    const ToolState<double> state = path.at(row["t"]);
    EXPECT_LE(difference(state, row), 1.0e-12) << "t " << row["t"];
    if (is_at_corner(row["t"])) continue;
    EXPECT_LE(acceleration_difference(state, row), 1.0e-12) << "t " << row["t"];
  }
}

// A time of 5 s has a rounding of 2.4e-7 s; at speeds below 0.6 rad/s and accelerations below 1.1 rad/s2
// that is less than 3e-7, and the points and the way add 2e-7.
TEST(TrajectoryGolden, OperationalStatesMatchInFloat) {
  const auto path = golden_path<float>();
  double worst = 0.0;
  for (const GoldenRow& row : golden_csv("traj_operational.csv"))
    worst = std::max(worst, difference(path.at(static_cast<float>(row["t"])), row));
  EXPECT_LE(worst, 1.0e-6);
  RecordProperty("worst_difference", std::to_string(worst));
}

template <class Real>
JointVector<Real> golden_start() {
  const ToolState<Real> first = golden_path<Real>().at(0);
  auto q = inverse_of(MachineGeometry{}, RollPose<Real>{first.position_m, first.angles_rad(0)});
  constexpr std::array kOff{0.01, -0.01, 0.005, 0.05};
  for (std::size_t i = 0; i < 4; ++i) q[i] += Real(kOff[i]);
  return q;
}

template <class Real>
double worst_of_step(const JointVector<Real>& q, const ClikStep<Real>& step, const GoldenRow& row) {
  constexpr std::array kJoint{"d1", "d2", "d3", "t4"};
  constexpr std::array kRate{"d1d", "d2d", "d3d", "t4d"};
  constexpr std::array kError{"ex", "ey", "ez", "ephi"};
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    worst = std::max(worst, std::abs(double{q[i]} - row[kJoint[i]]));
    worst = std::max(worst, std::abs(double{step.rate[i]} - row[kRate[i]]));
    worst = std::max(worst, std::abs(double{step.error(static_cast<int>(i))} - row[kError[i]]));
  }
  return worst;
}

/// Largest difference to the golden run; every tenth step is in the file.
template <class Real>
double worst_of_run() {
  const auto path = golden_path<Real>();
  Clik<Real> clik(Chain<Real>(morepro_table()), {.gain_per_s = 50.0, .period_s = 1.0e-3},
                  golden_start<Real>());
  double worst = 0.0;
  int k = 0;
  for (const GoldenRow& row : golden_csv("traj_joint_clik.csv")) {
    const auto q = clik.joints();
    worst = std::max(worst, worst_of_step(q, clik.step(path.at(Real(1.0e-3 * k++))), row));
    for (int i = 1; i < 10; ++i) clik.step(path.at(Real(1.0e-3 * k++)));
  }
  return worst;
}

TEST(TrajectoryGolden, ClikMatches) { EXPECT_LE(worst_of_run<double>(), 1.0e-10); }

// A position rounded by 6e-8 and an angle by 2.4e-7 give errors of that size, which the gain of 50/s makes
// rates of up to 1.2e-5; start and points add as much.
TEST(TrajectoryGolden, ClikMatchesInFloat) {
  const double worst = worst_of_run<float>();
  EXPECT_LE(worst, 3.0e-5);
  RecordProperty("worst_difference", std::to_string(worst));
}

}  // namespace
}  // namespace morepro::kinematics
