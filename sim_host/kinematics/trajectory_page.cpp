#include "sim_host/kinematics/trajectory_page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim_host/page/page.hpp"

namespace morepro::host {
namespace {

using TrajectoryRows = std::vector<TrajectoryRow>;

constexpr std::size_t kMostShownRows = 4000;

/// One list per row of the trajectory.
template <class Value>
nlohmann::json column(const TrajectoryRows& rows, Value value) {
  nlohmann::json list = nlohmann::json::array();
  for (const TrajectoryRow& row : rows) list.push_back(value(row));
  return list;
}

template <class Value>
nlohmann::json columns(const TrajectoryRows& rows, std::size_t count, Value value) {
  nlohmann::json lists = nlohmann::json::array();
  for (std::size_t i = 0; i < count; ++i)
    lists.push_back(column(rows, [&](const TrajectoryRow& row) { return value(row, i); }));
  return lists;
}

nlohmann::json joints_json(const kinematics::DhTable& table) {
  const std::vector<std::string> names = joint_names(table);
  nlohmann::json joints = nlohmann::json::array();
  for (std::size_t i = 0; i < table.count; ++i) {
    const kinematics::DhJoint& joint = table.joints[i];
    const bool turns = joint.kind == kinematics::JointKind::kRevolute;
    joints.push_back({{"name", names[i]},
                      {"unit", unit_of(joint)},
                      {"kind", turns ? "revolute" : "prismatic"},
                      {"a_m", joint.a_m},
                      {"d_m", joint.d_m},
                      {"alpha_rad", joint.alpha_rad},
                      {"theta_rad", joint.theta_rad}});
  }
  return joints;
}

nlohmann::json points_json(const KinematicsJob& job) {
  nlohmann::json points = nlohmann::json::array();
  for (const PathPoint& point : job.points) {
    const auto placed = job.placement * point.waypoint.position_m;
    points.push_back({placed(0), placed(1), placed(2)});
  }
  return points;
}

nlohmann::json rows_json(const TrajectoryRows& rows, std::size_t joints) {
  const auto at = [](std::size_t i) { return static_cast<int>(i); };
  return {{"time_s", column(rows, [](const TrajectoryRow& row) { return row.time_s; })},
          {"joints", columns(rows, joints, [](const TrajectoryRow& row, auto i) { return row.joints[i]; })},
          {"rates", columns(rows, joints, [](const TrajectoryRow& row, auto i) { return row.rate[i]; })},
          {"tool_m",
           columns(rows, 3, [&](const TrajectoryRow& row, auto i) { return row.tool.position_m(at(i)); })},
          {"tool_speed_m_s",
           columns(rows, 3, [&](const TrajectoryRow& row, auto i) { return row.tool.speed(at(i)); })},
          {"error_m", columns(rows, 3, [&](const TrajectoryRow& row, auto i) { return row.error(at(i)); })}};
}

}  // namespace

TrajectoryPage::TrajectoryPage(const KinematicsJob& job) : job_(job) {
  if (const std::string why = why_no_page(k_kinematics_page); !why.empty()) throw UserError(why);
}

void TrajectoryPage::add(const TrajectoryRow& row) {
  last_ = row;
  if (rows_++ % stride_ != 0) return;
  kept_.push_back(row);
  if (kept_.size() < kMostShownRows) return;
  for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
  kept_.resize((kept_.size() + 1) / 2);
  stride_ *= 2;
}

std::vector<TrajectoryRow> TrajectoryPage::shown() const {
  TrajectoryRows rows = kept_;
  if (rows.empty() || rows.back().time_s != last_.time_s) rows.push_back(last_);
  return rows;
}

std::string TrajectoryPage::json(std::string_view summary) const {
  const TrajectoryRows rows = shown();
  std::string text(summary);
  if (stride_ > 1) text += fmt::format("; one row of {} is shown", stride_);
  const nlohmann::json data{{"schema", "morepro.trajectory_page/1"},
                            {"summary", text},
                            {"joints", joints_json(job_.chain.table)},
                            {"points_m", points_json(job_)},
                            {"has_error", method_of(job_) == InverseMethod::kClik},
                            {"rows", rows_json(rows, job_.chain.table.count)}};
  return data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string TrajectoryPage::html(std::string_view summary) const {
  return page_html(k_kinematics_page, json(summary));
}

}  // namespace morepro::host
