#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "lib/kinematics/pose_search.hpp"
#include "sim_host/kinematics/joint_limits.hpp"
#include "sim_host/kinematics/still_motion.hpp"
#include "sim_host/kinematics/trajectory.hpp"

namespace morepro::host {
namespace {

constexpr double kSearchTolerance = 1.0e-9;
constexpr int kSearchStarts = 64;

kinematics::JointVector<double> built_in_joints(const ChainDescription& chain,
                                                const kinematics::Waypoint<double>& pose) {
  if (pose.angles_rad(1) != 0.0 || pose.angles_rad(2) != 0.0)
    throw UserError("this machine cannot tilt its tool; pitch and yaw must be 0");
  const auto joints =
      inverse_of(chain.geometry, kinematics::RollPose<double>{pose.position_m, pose.angles_rad(0)});
  if (const std::string outside = outside_limits(chain.table, joints, kJointRounding); !outside.empty())
    throw UserError(fmt::format("the pose is out of reach: {}", outside));
  return joints;
}

/// A joint without limits is searched within a turn, or within 1 m.
kinematics::JointVector<double> random_start(const kinematics::DhTable& table, std::mt19937& random) {
  kinematics::JointVector<double> start{};
  for (std::size_t i = 0; i < table.count; ++i) {
    const double size = table.joints[i].kind == kinematics::JointKind::kRevolute ? 3.14 : 1.0;
    const double low = std::max(table.joints[i].lowest, -size);
    const double high = std::min(table.joints[i].highest, size);
    const double share = static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    start[i] = low + (high - low) * share;
  }
  return start;
}

[[noreturn]] void refuse(const ChainDescription& chain, kinematics::TaskRows rows,
                         const kinematics::PoseSearchResult<double>& nearest) {
  const kinematics::Mobility<double> mobility(kinematics::Chain<double>(chain.table), rows);
  if (const std::string off = off_along_still(mobility, nearest.error, kSearchTolerance); !off.empty())
    throw UserError("the pose is out of reach: " + off);
  throw UserError(fmt::format(
      "the pose is out of reach: the tool stays {:.3g} m and {:.3g} rad away; move it nearer, or give "
      "the joints more room{}",
      nearest.error.head<3>().norm(), nearest.error.tail<3>().norm(), too_few_joints(mobility, chain.table)));
}

}  // namespace

kinematics::JointVector<double> joints_for(const ChainDescription& chain, kinematics::TaskRows rows,
                                           const kinematics::Waypoint<double>& pose) {
  if (chain.is_built_in) return built_in_joints(chain, pose);
  const kinematics::PoseSearch<double> search(kinematics::Chain<double>(chain.table), rows, kSearchTolerance);
  kinematics::PoseSearchResult<double> nearest = search.find(pose, {});
  std::mt19937 random(1);
  for (int start = 1; start < kSearchStarts && !nearest.is_reached; ++start) {
    const auto found = search.find(pose, random_start(chain.table, random));
    if (found.is_reached || found.error.norm() < nearest.error.norm()) nearest = found;
  }
  if (!nearest.is_reached) refuse(chain, rows, nearest);
  return nearest.joints;
}

}  // namespace morepro::host
