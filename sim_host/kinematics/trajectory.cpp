#include "sim_host/kinematics/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "lib/kinematics/clik.hpp"
#include "lib/kinematics/path.hpp"
#include "sim_host/kinematics/joint_limits.hpp"
#include "sim_host/kinematics/still_motion.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kMostPoints = 4096;
constexpr double kMostTrajectoryRows = 1.0e8;
constexpr double kLowestRateHz = 1.0;
constexpr double kHighestRateHz = 1.0e5;
using HostPath = kinematics::Path<double, kMostPoints>;

std::string sentence_of(kinematics::PathError error, const PathPoint& point, double ramp_share) {
  switch (error) {
    case kinematics::PathError::kFull:
      return fmt::format("the path has more than {} points; split it", kMostPoints);
    case kinematics::PathError::kCoincident:
      return "the point is where the one before it is; remove one of the two, or move or turn it";
    case kinematics::PathError::kTime:
      if (ramp_share > 0.0 && ramp_share <= 0.5) {
        return fmt::format("duration_s = {:g} is impossible; give the segment {:g} s or more",
                           point.duration_s, kinematics::kShortestSegmentS);
      }
      return fmt::format(
          "ramp_share = {:g} is impossible; give each ramp more than 0 and at most 0.5 of the time",
          ramp_share);
    default:
      return "the point is not finite; correct it";
  }
}

void check_tilt(const KinematicsJob& job, const PathPoint& point) {
  const auto& angles = point.waypoint.angles_rad;
  if (job.chain.is_built_in && (angles(1) != 0.0 || angles(2) != 0.0))
    throw UserError(point.place, "this machine cannot tilt its tool; pitch and yaw must be 0");
}

/// Of a trapezoid: top speed way/(T (1 - ramp)), acceleration way/(T^2 ramp (1 - ramp)).
void check_limits(const KinematicsJob& job, const PathPoint& from, const PathPoint& to) {
  const ToolLimits& limits = job.chain.limits;
  const double way_m = (to.waypoint.position_m - from.waypoint.position_m).norm();
  const double ramp = job.inverse.ramp_share, time_s = to.duration_s;
  const double speed_m_s = way_m / (time_s * (1.0 - ramp));
  const double acceleration_m_s2 = speed_m_s / (time_s * ramp);
  const bool is_fast = speed_m_s > limits.speed_m_s;
  if (!is_fast && !(acceleration_m_s2 > limits.acceleration_m_s2)) return;
  const std::string need =
      is_fast
          ? fmt::format("{:.4g} m/s, [limits] allow {:g} m/s", speed_m_s, limits.speed_m_s)
          : fmt::format("{:.4g} m/s2, [limits] allow {:g} m/s2", acceleration_m_s2, limits.acceleration_m_s2);
  const double shortest_s = std::max(way_m / (limits.speed_m_s * (1.0 - ramp)),
                                     std::sqrt(way_m / (limits.acceleration_m_s2 * ramp * (1.0 - ramp))));
  throw UserError(
      to.place,
      fmt::format("duration_s = {:g} is impossible: {:.4g} m in it need {}; give the segment {:g} s or more",
                  time_s, way_m, need, std::ceil(1000.0 * shortest_s) / 1000.0));
}

std::unique_ptr<HostPath> path_of(const KinematicsJob& job) {
  if (job.points.size() < 2) {
    throw UserError(TextPlace{job.file, 0, 0},
                    fmt::format("the path has {} point{}; it needs two or more", job.points.size(),
                                job.points.size() == 1 ? "" : "s"));
  }
  auto path = std::make_unique<HostPath>(job.placement, job.inverse.ramp_share);
  for (const PathPoint& point : job.points) {
    check_tilt(job, point);
    const kinematics::PathError error = path->add(point.waypoint, point.duration_s);
    if (error != kinematics::PathError::kNone)
      throw UserError(point.place, sentence_of(error, point, job.inverse.ramp_share));
    if (path->points() > 1) check_limits(job, *(&point - 1), point);
  }
  return path;
}

void check_inverse(const KinematicsJob& job) {
  const InverseDescription& inverse = job.inverse;
  if (!(inverse.rate_hz >= kLowestRateHz && inverse.rate_hz <= kHighestRateHz)) {
    throw UserError(fmt::format("rate = {:g} Hz is outside {:g} .. {:g} Hz; choose another", inverse.rate_hz,
                                kLowestRateHz, kHighestRateHz));
  }
  if (method_of(job) == InverseMethod::kClosedForm && !job.chain.is_built_in)
    throw UserError("the closed form exists for the built-in machine only; use method clik for an own chain");
  const kinematics::ClikSettings settings{inverse.gain_per_s, 1.0 / inverse.rate_hz};
  if (method_of(job) == InverseMethod::kClik && settings.validate() == kinematics::ClikError::kGain) {
    throw UserError(fmt::format(
        "gain = {:g}/s is unstable at {:g} Hz; choose it above 0 and below 2 x rate = {:g}/s (up to {:g}/s "
        "the error does not overshoot)",
        inverse.gain_per_s, inverse.rate_hz, 2.0 * inverse.rate_hz, inverse.rate_hz));
  }
  if (!(inverse.tolerance > 0.0))
    throw UserError(fmt::format("tolerance = {:g} is impossible; give more than 0", inverse.tolerance));
}

/// What the CLIK follows: the built-in machine's roll is always prescribed.
kinematics::TaskRows rows_of(const KinematicsJob& job) {
  return job.chain.is_built_in ? kinematics::kRollRows : job.rows;
}

kinematics::JointVector<double> start_of(const KinematicsJob& job,
                                         const kinematics::ToolState<double>& first) {
  if (job.inverse.start) return *job.inverse.start;
  try {
    return joints_for(job.chain, rows_of(job), {first.position_m, first.angles_rad});
  } catch (const UserError& error) {
    throw UserError(job.points.front().place, error.what());
  }
}

/// One way to get from a wanted tool to joints, sample by sample.
class Follower {
 public:
  Follower(const KinematicsJob& job, const kinematics::ToolState<double>& first) : job_(job) {
    if (method_of(job) == InverseMethod::kClosedForm) return;
    const kinematics::ClikSettings settings{job.inverse.gain_per_s, 1.0 / job.inverse.rate_hz, rows_of(job)};
    clik_.emplace(kinematics::Chain<double>(job.chain.table), settings, start_of(job, first));
  }

  TrajectoryRow next(double time_s, const kinematics::ToolState<double>& wanted) {
    return clik_ ? by_clik(time_s, wanted) : by_closed_form(time_s, wanted);
  }
  [[nodiscard]] bool is_damped() const { return is_damped_; }

 private:
  TrajectoryRow by_clik(double time_s, const kinematics::ToolState<double>& wanted) {
    const auto joints = clik_->joints();
    const auto acceleration = clik_->acceleration(wanted);
    const kinematics::ClikStep<double> step = clik_->step(wanted);
    is_damped_ = step.damping > 0.0;
    return {time_s, joints, step.rate, acceleration, wanted, step.error};
  }

  TrajectoryRow by_closed_form(double time_s, const kinematics::ToolState<double>& wanted) const {
    return {.time_s = time_s,
            .joints = inverse_of(job_.chain.geometry,
                                 kinematics::RollPose<double>{wanted.position_m, wanted.angles_rad(0)}),
            .rate = kinematics::inverse_rates_of<double>(wanted.speed.head<3>(), wanted.speed(3)),
            .acceleration =
                kinematics::inverse_rates_of<double>(wanted.acceleration.head<3>(), wanted.acceleration(3)),
            .tool = wanted};
  }

  const KinematicsJob& job_;
  std::optional<kinematics::Clik<double>> clik_;
  bool is_damped_ = false;
};

/// Refuses a row that no machine could follow.
class ReachCheck {
 public:
  explicit ReachCheck(const KinematicsJob& job)
      : job_(job), mobility_(kinematics::Chain<double>(job.chain.table), rows_of(job)) {}

  /// `segment`: that the row is on; at a point the one that begins there.
  void check(const TrajectoryRow& row, std::size_t segment, bool is_last, bool is_damped) {
    const bool is_at_point = segment != segment_ || is_last;
    const std::size_t goal = is_at_point && !is_last ? segment : segment + 1;
    segment_ = segment;
    const double error = row.error.norm();
    if (const std::string outside = outside_limits(job_.chain.table, row.joints,
                                                   std::min(error, job_.inverse.tolerance) + kJointRounding);
        !outside.empty())
      refuse(row, goal, outside);
    if (const std::string off = off_along_still(mobility_, row.error, job_.inverse.tolerance); !off.empty())
      refuse(row, goal, off);
    if ((is_damped || is_at_point) && !(error <= job_.inverse.tolerance))
      refuse(row, goal, off_by(error, is_damped));
  }

 private:
  static std::string off_by(double error, bool is_damped) {
    return fmt::format("the tool is {:.3g} (m, rad) off{}", error,
                       is_damped ? "" : "; raise the gain, start nearer or allow a larger tolerance");
  }

  [[noreturn]] void refuse(const TrajectoryRow& row, std::size_t point, const std::string& why) const {
    throw UserError(job_.points[point].place,
                    fmt::format("the path is out of reach at {:.6g} s, on the way to this point: {}{}",
                                row.time_s, why, too_few_joints(mobility_, job_.chain.table)));
  }

  const KinematicsJob& job_;
  kinematics::Mobility<double> mobility_;
  std::size_t segment_ = 0;
};

double last_sample(const KinematicsJob& job, double duration_s) {
  constexpr double kRoundingOfTheSum = 1.0e-9;
  const double last = std::ceil(duration_s * job.inverse.rate_hz - kRoundingOfTheSum);
  if (last < kMostTrajectoryRows) return last;
  throw UserError(TextPlace{job.file, 0, 0},
                  fmt::format("{:g} s at {:g} Hz are more than {:g} rows; lower the rate", duration_s,
                              job.inverse.rate_hz, kMostTrajectoryRows));
}

}  // namespace

TrajectorySummary compute_trajectory(const KinematicsJob& job,
                                     const std::function<void(const TrajectoryRow&)>& on_row) {
  check_inverse(job);
  const auto path = path_of(job);
  const double last = last_sample(job, path->duration_s());
  Follower follower(job, path->at(0.0));
  ReachCheck reach(job);
  TrajectorySummary summary{.segments = path->points() - 1, .duration_s = path->duration_s()};
  for (double k = 0.0; k <= last; k += 1.0) {
    const double time_s = k / job.inverse.rate_hz;
    const TrajectoryRow row = follower.next(time_s, path->at(time_s));
    reach.check(row, path->segment_at(time_s), k == last, follower.is_damped());
    summary.largest_error = std::max(summary.largest_error, row.error.norm());
    summary.passed_singularity |= follower.is_damped();
    ++summary.rows;
    on_row(row);
  }
  return summary;
}

}  // namespace morepro::host
