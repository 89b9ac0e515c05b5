#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_host/kinematics/degree.hpp"
#include "sim_host/kinematics/trajectory.hpp"
#include "sim_host/thesis/demonstration_path.hpp"
#include "sim_host/thesis/figure.hpp"

namespace morepro::host::thesis {
namespace {

using Rows = std::vector<TrajectoryRow>;

constexpr std::size_t kRowsPerShown = 10;
/// After this many time constants of the CLIK its start is forgotten: e^-12 of 5 cm are 0.3 um.
constexpr double kForgotten = 12.0;

Rows rows_along(const KinematicsJob& job) {
  Rows rows;
  compute_trajectory(job, [&](const TrajectoryRow& row) { rows.push_back(row); });
  return rows;
}

template <class Value>
std::vector<double> column(const Rows& rows, Value value) {
  std::vector<double> result;
  for (std::size_t k = 0; k < rows.size(); k += kRowsPerShown) result.push_back(value(rows[k]));
  return result;
}

template <class Value>
Curve curve_over_rows(std::string label, const Rows& rows, Value value) {
  return {.label = std::move(label), .y = column(rows, value)};
}

Chart over_time(std::string title, std::string unit, const Rows& rows, std::vector<Curve> curves) {
  const auto time = column(rows, [](const TrajectoryRow& row) { return row.time_s; });
  return {.title = std::move(title),
          .unit = std::move(unit),
          .x_name = "time, s",
          .x = time,
          .curves = std::move(curves)};
}

/// x, y and z of a member of the tool's state.
template <class Member>
std::vector<Curve> axes(const Rows& rows, Member member) {
  std::vector<Curve> curves;
  for (int i = 0; i < 3; ++i)
    curves.push_back(curve_over_rows(std::string(1, static_cast<char>('x' + i)), rows,
                                     [&](const TrajectoryRow& row) { return member(row.tool)(i); }));
  return curves;
}

std::size_t row_at(const KinematicsJob& job, double time_s) {
  return static_cast<std::size_t>(std::lround(time_s * job.inverse.rate_hz));
}

/// Largest speed in the points, the ends included.
double speed_in_the_points(const KinematicsJob& job, const Rows& rows) {
  double time_s = 0.0, largest = 0.0;
  for (const PathPoint& point : job.points) {
    time_s += point.duration_s;
    largest = std::max(largest, rows[std::min(row_at(job, time_s), rows.size() - 1)].tool.speed.norm());
  }
  return largest;
}

/// Samples that accelerate and samples that brake, of the first segment.
Comparison ramps(const KinematicsJob& job, const Rows& rows) {
  int up = 0, down = 0;
  for (std::size_t k = 0; k < row_at(job, job.points[1].duration_s); ++k) {
    const double change = rows[k].tool.acceleration.dot(rows[k].tool.speed + rows[k + 1].tool.speed);
    up += change > 0.0 ? 1 : 0;
    down += change < 0.0 ? 1 : 0;
  }
  return {.quantity = "braking over accelerating time",
          .unit = "1",
          .printed = Range{1.0, 1.0},
          .ours = Range{static_cast<double>(down) / up, static_cast<double>(down) / up}};
}

Figure path_figure(const KinematicsJob& job, const Rows& rows) {
  double height = 0.0;
  for (const PathPoint& point : job.points) height = std::max(height, std::abs(point.waypoint.position_m(2)));
  Figure figure{.number = 13, .section = "3.4", .title = "Path in operational space"};
  std::vector<double> way{0.0};
  for (std::size_t k = 1; k < rows.size(); ++k)
    way.push_back(way.back() + (rows[k].tool.position_m - rows[k - 1].tool.position_m).norm());
  std::vector<double> shown;
  for (std::size_t k = 0; k < way.size(); k += kRowsPerShown) shown.push_back(way[k]);
  figure.charts = {{.title = "Tool along the path",
                    .unit = "m",
                    .x_name = "way, m",
                    .x = shown,
                    .curves = axes(rows, [](const auto& tool) { return tool.position_m; })}};
  const auto points = static_cast<double>(job.points.size());
  figure.comparisons = {
      {.quantity = "points", .unit = "1", .printed = Range{4, 4}, .ours = Range{points, points}},
      {.quantity = "largest |z| before the transform",
       .unit = "m",
       .printed = Range{0, 0},
       .ours = Range{height, height}}};
  figure.remark =
      "The thesis prints no coordinates; shape and transform are as it describes them, the numbers are ours.";
  return figure;
}

Figure tool_figure(int number, const char* title, const Rows& rows) {
  Figure figure{.number = number, .section = "3.4", .title = title};
  switch (number) {
    case 14:
      figure.charts = {
          over_time("Position", "m", rows, axes(rows, [](const auto& tool) { return tool.position_m; })),
          over_time("Roll", "rad", rows, {curve_over_rows("roll", rows, [](const TrajectoryRow& row) {
                      return row.tool.angles_rad(0);
                    })})};
      break;
    case 15:
      figure.charts = {
          over_time("Speed", "m/s", rows, axes(rows, [](const auto& tool) { return tool.speed; }))};
      break;
    default:
      figure.charts = {over_time("Acceleration", "m/s2", rows,
                                 axes(rows, [](const auto& tool) { return tool.acceleration; }))};
  }
  return figure;
}

/// Where CLIK has forgotten its start: the largest distance of the joints from the closed form.
double distance_from_closed_form(const KinematicsJob& job, const Rows& rows) {
  KinematicsJob closed = job;
  closed.inverse.method = InverseMethod::kClosedForm;
  const Rows exact = rows_along(closed);
  double largest = 0.0;
  for (std::size_t k = row_at(job, kForgotten / job.inverse.gain_per_s); k < rows.size(); ++k)
    for (std::size_t i = 0; i < job.chain.table.count; ++i)
      largest = std::max(largest, std::abs(rows[k].joints[i] - exact[k].joints[i]));
  return largest;
}

Figure joint_figure(const KinematicsJob& job, const Rows& rows) {
  Figure figure{.number = 17, .section = "3.4", .title = "Trajectory in the joint space"};
  const auto joint = [&](std::size_t i) {
    return curve_over_rows(joint_names(job.chain.table)[i], rows,
                           [i](const TrajectoryRow& row) { return row.joints[i]; });
  };
  figure.charts = {over_time("Slides", "m", rows, {joint(0), joint(1), joint(2)}),
                   over_time("Turn", "rad", rows, {joint(3)})};
  const double step_s = 1.0 / job.inverse.rate_hz;
  double acceleration = 0.0;
  for (const TrajectoryRow& row : rows)
    acceleration = std::max(acceleration, row.tool.acceleration.tail<3>().norm());
  const double lag = step_s * acceleration / (2.0 * job.inverse.gain_per_s);
  const double off = distance_from_closed_form(job, rows);
  const auto joints = static_cast<double>(job.chain.table.count);
  figure.comparisons = {
      {.quantity = "joints", .unit = "1", .printed = Range{4, 4}, .ours = Range{joints, joints}},
      {.quantity = "CLIK minus closed form, largest",
       .unit = "m, rad",
       .printed = {},
       .ours = Range{off, off}},
      {.quantity = "h a/(2 K), its theory", .unit = "rad", .printed = {}, .ours = Range{lag, lag}}};
  figure.remark = fmt::format(
      "The Jacobian of this machine is a permutation, so the inverse is closed and CLIK only adds the "
      "decay of its start and a lag of h a/(2 K) = {:.2g}.",
      lag);
  return figure;
}

}  // namespace

KinematicsJob demonstration_path() {
  KinematicsJob job;
  job.placement = {kinematics::rotation_of<double>({15.0 * kDegree, -20.0 * kDegree, 30.0 * kDegree}),
                   {0.30, 0.10, 0.40}};
  job.points = {{{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, 0.0, {}},
                {{{0.20, 0.05, 0.0}, {30.0 * kDegree, 0.0, 0.0}}, 2.0, {}},
                {{{0.25, 0.20, 0.0}, {-15.0 * kDegree, 0.0, 0.0}}, 1.5, {}},
                {{{0.05, 0.25, 0.0}, {0.0, 0.0, 0.0}}, 2.0, {}}};
  job.inverse.method = InverseMethod::kClik;
  job.inverse.start = kinematics::JointVector<double>{0.01, -0.01, 0.035, 0.05};
  return job;
}

std::vector<Figure> kinematic_figures() {
  const KinematicsJob job = demonstration_path();
  const Rows rows = rows_along(job);
  Figure position = tool_figure(14, "Trajectories in the operational space", rows);
  const double end = rows.back().time_s;
  position.comparisons = {{.quantity = "duration", .unit = "s", .printed = {}, .ours = Range{end, end}}};
  position.remark =
      "Straight segments with a trapezoidal speed; the thesis's 'segment' is no built-in function and its "
      "times are not printed.";
  Figure speed = tool_figure(15, "Velocities in the operational space", rows);
  const double rest = speed_in_the_points(job, rows);
  speed.comparisons = {
      {.quantity = "speed in the points", .unit = "m/s", .printed = Range{0, 0}, .ours = Range{rest, rest}}};
  speed.remark = "At rest in all four points, as printed.";
  Figure acceleration = tool_figure(16, "Accelerations in operational space", rows);
  acceleration.comparisons = {ramps(job, rows)};
  acceleration.remark =
      "Both ramps have the same length to one sample, as printed; how long is ours, a third of a segment "
      "each.";
  return {path_figure(job, rows), position, speed, acceleration, joint_figure(job, rows)};
}

}  // namespace morepro::host::thesis
