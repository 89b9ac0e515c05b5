#include "sim_host/kinematics/still_motion.hpp"

#include <fmt/format.h>

#include <cmath>

namespace morepro::host {
namespace {

using kinematics::Vector3;

/// "x", or "(0, 0.6, 0.8)" where no axis of the base is meant.
std::string name_of_direction(const Vector3<double>& direction) {
  constexpr double kAligned = 0.999999;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(direction(i)) > kAligned) return std::string(1, "xyz"[i]);
  }
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", direction(0), direction(1), direction(2));
}

}  // namespace

std::string off_along_still(const kinematics::Mobility<double>& mobility,
                            const kinematics::Twist<double>& error, double tolerance) {
  const kinematics::Twist<double> still = mobility.still_part(error);
  const Vector3<double> way = still.head<3>();
  const Vector3<double> turn = still.tail<3>();
  if (way.norm() > tolerance) {
    const std::string name = name_of_direction(way.normalized());
    return fmt::format(
        "the tool is {:.3g} m off along {}, and no joint of this chain moves it along {}; give the points "
        "what the chain can reach, or place them there by [placement]",
        way.norm(), name, name);
  }
  if (!(turn.norm() > tolerance)) return {};
  const std::string name = name_of_direction(turn.normalized());
  return fmt::format(
      "the tool is {:.3g} rad off about {}, and no joint of this chain turns it about {}; leave the angle "
      "out",
      turn.norm(), name, name);
}

std::string too_few_joints(const kinematics::Mobility<double>& mobility, const kinematics::DhTable& table) {
  // The trace of a projector is the number of its directions; rows outside the task count as still.
  double directions = 6.0;
  for (int row = 0; row < 6; ++row)
    directions -= mobility.still_part(kinematics::Twist<double>::Unit(row))(row);
  if (std::lround(directions) <= static_cast<long>(table.count)) return {};
  return fmt::format(
      "; the points prescribe {} directions in which this chain can move, and it has {} joint{}, so nearly "
      "every pose is out of reach: leave out the angles that may be free, or add joints",
      std::lround(directions), table.count, table.count == 1 ? "" : "s");
}

}  // namespace morepro::host
