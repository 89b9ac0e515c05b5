#include "sim_host/kinematics/kinematics_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "sim_host/kinematics/toml_reader.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {

using kinematics::DhJoint;
using kinematics::DhTable;
using kinematics::JointKind;
using kinematics::TableError;

constexpr std::array<std::string_view, 2> kKinds{"prismatic", "revolute"};
constexpr std::array<std::string_view, 3> kAngles{"roll", "pitch", "yaw"};

std::string sentence_of(TableError error) {
  switch (error) {
    case TableError::kNoJoints:
      return "the chain has no joints; add at least one [[joint]]";
    case TableError::kTooManyJoints:
      return fmt::format("the chain has more than {} joints; leave some out", kinematics::kMaxJoints);
    case TableError::kLength:
      return fmt::format("a_m or d_m is beyond {} m; check the unit", kinematics::kLongestLinkM);
    case TableError::kAngle:
      return fmt::format("alpha or theta is beyond {} rad; check the unit", kinematics::kLargestAngleRad);
    case TableError::kLimits:
      return "lowest is not below highest; correct one of them";
    default:
      return "the kind of the joint is unknown; write \"prismatic\" or \"revolute\"";
  }
}

class KinematicsFile {
 public:
  explicit KinematicsFile(const std::string& path) : reader_(path) { job_.file = path; }

  KinematicsJob read() {
    reader_.check_keys(reader_.root(), {"joint", "links", "limits", "point", "placement", "inverse"}, "");
    read_chain();
    read_limits();
    read_placement();
    read_points();
    read_inverse();
    return std::move(job_);
  }

 private:
  void read_chain() {
    const toml::array* joints = reader_.tables("joint");
    const toml::table* links = reader_.table("links");
    if (joints != nullptr && links != nullptr)
      reader_.refuse(*links, "[links] belongs to the built-in machine, [[joint]] to another; remove one");
    if (links != nullptr) read_links(*links);
    if (joints != nullptr) read_joints(*joints);
  }

  void read_links(const toml::table& links) {
    reader_.check_keys(links, {"a1_m", "a2_m", "a3_m", "a4_m", "travel_m"}, " of [links]");
    auto& g = job_.chain.geometry;
    g = {reader_.number(links, "a1_m", g.a1_m), reader_.number(links, "a2_m", g.a2_m),
         reader_.number(links, "a3_m", g.a3_m), reader_.number(links, "a4_m", g.a4_m),
         reader_.number(links, "travel_m", g.travel_m)};
    job_.chain.table = kinematics::morepro_table(g);
    check_table(links, nullptr);
  }

  void read_joints(const toml::array& joints) {
    job_.chain.is_built_in = false;
    DhTable& table = job_.chain.table;
    table = DhTable{.count = joints.size()};
    if (joints.size() > kinematics::kMaxJoints)
      reader_.refuse(joints[kinematics::kMaxJoints], sentence_of(TableError::kTooManyJoints));
    for (std::size_t i = 0; i < joints.size(); ++i) table.joints[i] = joint(*joints[i].as_table());
    check_table(joints, &joints);
  }

  void check_table(const toml::node& whole, const toml::array* joints) const {
    const kinematics::TableStatus status = job_.chain.table.validate();
    if (status.is_good()) return;
    const bool is_of_one = joints != nullptr && status.error != TableError::kNoJoints;
    reader_.refuse(is_of_one ? (*joints)[status.joint] : whole, sentence_of(status.error));
  }

  DhJoint joint(const toml::table& table) const {
    reader_.check_keys(table,
                       {"kind", "a_m", "d_m", "alpha_deg", "alpha_rad", "theta_deg", "theta_rad", "lowest_m",
                        "highest_m", "lowest_deg", "highest_deg", "lowest_rad", "highest_rad"},
                       " of [[joint]]");
    DhJoint joint;
    joint.kind = kind(table);
    joint.a_m = reader_.number(table, "a_m", 0.0);
    joint.d_m = reader_.number(table, "d_m", 0.0);
    joint.alpha_rad = reader_.angle_rad(table, "alpha").value_or(0.0);
    joint.theta_rad = reader_.angle_rad(table, "theta").value_or(0.0);
    joint.lowest = limit(table, joint.kind, "lowest", joint.lowest);
    joint.highest = limit(table, joint.kind, "highest", joint.highest);
    return joint;
  }

  JointKind kind(const toml::table& table) const {
    const toml::node* node = table.get("kind");
    if (node == nullptr)
      reader_.refuse(table, "this [[joint]] has no 'kind'; write \"prismatic\" or \"revolute\"");
    const std::string name = reader_.text(table, "kind");
    if (name == kKinds[0]) return JointKind::kPrismatic;
    if (name == kKinds[1]) return JointKind::kRevolute;
    reader_.refuse(*node, fmt::format("joint kind '{}' is unknown{}; write \"prismatic\" or \"revolute\"",
                                      name, did_you_mean(name, kKinds)));
  }

  double limit(const toml::table& table, JointKind kind, const std::string& name, double none) const {
    const std::string in_metres = name + "_m";
    const auto angle = reader_.angle_rad(table, name);
    if (kind == JointKind::kRevolute ? table.contains(in_metres) : angle.has_value()) {
      reader_.refuse(
          table, fmt::format("{} has the wrong unit: a prismatic joint's is in m, a revolute one's in deg "
                             "or rad",
                             name));
    }
    return kind == JointKind::kRevolute ? angle.value_or(none) : reader_.number(table, in_metres, none);
  }

  kinematics::Vector3<double> position(const toml::table& table) const {
    return {reader_.number(table, "x_m", 0.0), reader_.number(table, "y_m", 0.0),
            reader_.number(table, "z_m", 0.0)};
  }

  kinematics::Vector3<double> angles(const toml::table& table) const {
    kinematics::Vector3<double> angles_rad;
    for (std::size_t i = 0; i < 3; ++i)
      angles_rad(static_cast<int>(i)) = reader_.angle_rad(table, kAngles[i]).value_or(0.0);
    return angles_rad;
  }

  void read_limits() {
    const toml::table* table = reader_.table("limits");
    if (table == nullptr) return;
    reader_.check_keys(*table, {"max_speed_m_s", "max_acceleration_m_s2"}, " of [limits]");
    ToolLimits& limits = job_.chain.limits;
    limits.speed_m_s = limit(*table, "max_speed_m_s", limits.speed_m_s);
    limits.acceleration_m_s2 = limit(*table, "max_acceleration_m_s2", limits.acceleration_m_s2);
  }

  double limit(const toml::table& table, std::string_view key, double none) const {
    const double value = reader_.number(table, key, none);
    if (!(value > 0.0))
      reader_.refuse(*table.get(key), fmt::format("{} is impossible; give more than 0", key));
    return value;
  }

  void read_placement() {
    const toml::table* table = reader_.table("placement");
    if (table == nullptr) return;
    reader_.check_keys(
        *table, {"x_m", "y_m", "z_m", "roll_deg", "pitch_deg", "yaw_deg", "roll_rad", "pitch_rad", "yaw_rad"},
        " of [placement]");
    job_.placement = {kinematics::rotation_of(angles(*table)), position(*table)};
  }

  void read_points() {
    const toml::array* points = reader_.tables("point");
    if (points == nullptr) return;
    for (std::size_t i = 0; i < points->size(); ++i) read_point(*(*points)[i].as_table(), i == 0);
  }

  void read_point(const toml::table& table, bool is_first) {
    reader_.check_keys(table,
                       {"x_m", "y_m", "z_m", "roll_deg", "pitch_deg", "yaw_deg", "roll_rad", "pitch_rad",
                        "yaw_rad", "duration_s"},
                       " of [[point]]");
    if (!is_first && !table.contains("duration_s"))
      reader_.refuse(table, "this [[point]] has no 'duration_s'; add the time from the point before");
    const double duration_s = reader_.number(table, "duration_s", 0.0);
    if (is_first && duration_s != 0.0)
      reader_.refuse(*table.get("duration_s"), "the first point has no way before it; remove its duration_s");
    for (std::size_t i = 0; i < 3; ++i) {
      if (reader_.angle_rad(table, kAngles[i]))
        job_.rows = static_cast<kinematics::TaskRows>(job_.rows | (0b1000 << i));
    }
    job_.points.push_back({{position(table), angles(table)}, duration_s, reader_.place(table)});
  }

  void read_inverse() {
    const toml::table* table = reader_.table("inverse");
    if (table == nullptr) return;
    reader_.check_keys(*table, {"method", "gain_per_s", "rate_hz", "ramp_share", "tolerance", "start"},
                       " of [inverse]");
    InverseDescription& inverse = job_.inverse;
    if (const std::string name = reader_.text(*table, "method"); !name.empty()) read_method(*table, name);
    inverse.gain_per_s = reader_.number(*table, "gain_per_s", inverse.gain_per_s);
    inverse.rate_hz = reader_.number(*table, "rate_hz", inverse.rate_hz);
    inverse.ramp_share = reader_.number(*table, "ramp_share", inverse.ramp_share);
    inverse.tolerance = reader_.number(*table, "tolerance", inverse.tolerance);
    if (const toml::node* start = table->get("start")) read_start(*start);
  }

  void read_method(const toml::table& table, const std::string& name) {
    try {
      job_.inverse.method = inverse_method_of(name);
    } catch (const UserError& error) {
      reader_.refuse(*table.get("method"), error.what());
    }
  }

  void read_start(const toml::node& node) {
    const toml::array* values = node.as_array();
    if (values == nullptr || values->size() != job_.chain.table.count)
      reader_.refuse(node, fmt::format("start must be a list of {} joint values", job_.chain.table.count));
    kinematics::JointVector<double> start{};
    for (std::size_t i = 0; i < values->size(); ++i) start[i] = reader_.number((*values)[i], "start");
    job_.inverse.start = start;
  }

  TomlReader reader_;
  KinematicsJob job_;
};

}  // namespace

KinematicsJob read_kinematics_file(const std::string& path) { return KinematicsFile(path).read(); }

InverseMethod inverse_method_of(const std::string& name) {
  constexpr std::array<std::string_view, 2> kNames{"closed_form", "clik"};
  if (name == kNames[0]) return InverseMethod::kClosedForm;
  if (name == kNames[1]) return InverseMethod::kClik;
  throw UserError(fmt::format("method '{}' is unknown{}; write \"closed_form\" or \"clik\"", name,
                              did_you_mean(name, kNames)));
}

std::vector<std::string> joint_names(const DhTable& table) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < table.count; ++i)
    names.push_back(fmt::format("{}{}", table.joints[i].kind == JointKind::kRevolute ? 't' : 'd', i + 1));
  return names;
}

}  // namespace morepro::host
