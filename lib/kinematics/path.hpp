#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/kinematics/segment.hpp"

namespace morepro::kinematics {

enum class PathError : std::uint8_t {
  kNone = 0,
  kFull = 1,        ///< more points than the path has room for
  kNotFinite = 2,   ///< a coordinate or angle is NaN or infinite
  kCoincident = 3,  ///< the point is where the one before is: a segment without a direction
  kTime = 4,        ///< the segment's time or ramps are not possible for a SpeedProfile
};

/// Below this (m, rad) two points are one.
inline constexpr double kSmallestWay = 1.0e-9;

/// Straight segments through up to kCapacity points, at rest in every one of them. Fixed memory.
template <class Real, std::size_t kCapacity>
class Path {
 public:
  static_assert(kCapacity >= 2);

  /// The placement is the transform (thesis 3.4) that takes the points of add() to the base; it leaves the
  /// angles alone, which are about the base's axes in any case. `ramp_share`: the part of a segment's time
  /// that each ramp takes, above 0, at most 1/2.
  explicit Path(const Transform<Real>& placement = {}, Real ramp_share = Real(kThirdOfTime))
      : placement_(placement), ramp_share_(ramp_share) {}

  /// Appends a point that is reached in `duration_s` from the one before; of the first point the duration
  /// does not matter. A path is unchanged by a point that it refuses.
  [[nodiscard]] PathError add(const Waypoint<Real>& local, Real duration_s) {
    const Waypoint<Real> point{placement_ * local.position_m, local.angles_rad};
    if (!is_finite(point)) return PathError::kNotFinite;
    if (points_ > 0) {
      if (const PathError error = append(point, duration_s); error != PathError::kNone) return error;
    }
    last_ = point;
    ++points_;
    return PathError::kNone;
  }

  [[nodiscard]] std::size_t points() const { return points_; }
  /// 0 for fewer than two points.
  [[nodiscard]] Real duration_s() const { return points_ < 2 ? Real(0) : start_s_[points_ - 1]; }

  /// The segment (from 0) that is travelled at a time; at a point in between the one that begins there.
  [[nodiscard]] std::size_t segment_at(Real t_s) const {
    const auto first_end = start_s_.begin() + 1;
    const auto last_end = start_s_.begin() + static_cast<std::ptrdiff_t>(points_ - 1);
    return static_cast<std::size_t>(std::upper_bound(first_end, last_end, t_s) - first_end);
  }

  /// Wanted state of the tool at a time; at rest at the ends before and after the path. The path must have
  /// two points.
  [[nodiscard]] ToolState<Real> at(Real t_s) const {
    const std::size_t i = segment_at(t_s);
    return segments_[i].at(t_s - start_s_[i]);
  }

 private:
  static bool is_finite(const Waypoint<Real>& p) {
    const Real sum = p.position_m.sum() + p.angles_rad.sum();
    return sum - sum == Real(0);
  }

  PathError append(const Waypoint<Real>& point, Real duration_s) {
    if (points_ == kCapacity) return PathError::kFull;
    if (!SpeedProfile<Real>::is_possible(duration_s, ramp_share_)) return PathError::kTime;
    const Segment<Real> segment(last_, point, duration_s, ramp_share_);
    constexpr auto kSmallest = Real(kSmallestWay);
    if (!(dot(segment.way(), segment.way()) > kSmallest * kSmallest)) return PathError::kCoincident;
    segments_[points_ - 1] = segment;
    start_s_[points_] = start_s_[points_ - 1] + duration_s;
    return PathError::kNone;
  }

  Transform<Real> placement_;
  Real ramp_share_;
  Waypoint<Real> last_{};
  std::size_t points_ = 0;
  std::array<Segment<Real>, kCapacity - 1> segments_{};
  std::array<Real, kCapacity> start_s_{};
};

}  // namespace morepro::kinematics
