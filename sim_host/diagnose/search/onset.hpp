#pragma once
#include <Eigen/Core>
#include <cstddef>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// What columns take from the residual beside the parameters when they act from one block of time on.
struct LateStart {
  double onset_s = 0.0;       ///< 0: they act from the start
  double rss = 0.0;           ///< left with them
  double rss_at_start = 0.0;  ///< left when they act from the start
  double rss_without = 0.0;
  Eigen::VectorXd coefficient{};
};

/// The best beginning of the columns [first, first + count) of `statistics`. Their history before it is not
/// taken out: a lag's memory of a few samples does not matter in blocks of a quarter of a second.
LateStart best_start(const AxisFit& fit, const GapStatistics& statistics, Eigen::Index first,
                     Eigen::Index count);

/// Is the best beginning later than the start by more than chance makes it?
bool is_surely_late(const LateStart& start, double rows);

}  // namespace morepro::host
