#include "sim_host/kinematics/pose_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lib/kinematics/chain.hpp"

namespace morepro::host {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// A rounding error beside 0 is not worth its digits to a person.
double shown(double value) { return value < 1.0e-12 && value > -1.0e-12 ? 0.0 : value; }

template <class Matrix>
nlohmann::json rows_of(const Matrix& matrix, int columns) {
  nlohmann::json rows = nlohmann::json::array();
  for (int r = 0; r < matrix.rows(); ++r) {
    nlohmann::json row = nlohmann::json::array();
    for (int c = 0; c < columns; ++c) row.push_back(matrix(r, c));
    rows.push_back(row);
  }
  return rows;
}

template <class Matrix>
std::string text_of(const Matrix& matrix, int columns) {
  std::string text;
  for (int r = 0; r < matrix.rows(); ++r) {
    for (int c = 0; c < columns; ++c) text += fmt::format(" {:>12.6g}", shown(matrix(r, c)));
    text += "\n";
  }
  return text;
}

}  // namespace

PoseReport report_of(const ChainDescription& description, const kinematics::JointVector<double>& joints) {
  const kinematics::Chain<double> chain(description.table);
  const auto frames = chain.frames(joints);
  const kinematics::Matrix3<double> home = chain.frames({}).tool().rotation;
  return {.joints = joints,
          .tool = frames.tool(),
          .angles_rad =
              kinematics::angles_of(kinematics::Matrix3<double>(frames.tool().rotation * home.transpose())),
          .jacobian = chain.jacobian(frames)};
}

std::string pose_text(const ChainDescription& chain, const PoseReport& report) {
  std::string text = "joints   ";
  const std::vector<std::string> names = joint_names(chain.table);
  for (std::size_t i = 0; i < names.size(); ++i)
    text +=
        fmt::format(" {} = {:.9g} {} ", names[i], shown(report.joints[i]), unit_of(chain.table.joints[i]));
  const auto& p = report.tool.position_m;
  const auto& angles = report.angles_rad;
  text += fmt::format("\nposition  x = {:.9g}  y = {:.9g}  z = {:.9g} m\n", shown(p(0)), shown(p(1)),
                      shown(p(2)));
  text +=
      fmt::format("turned    roll = {:.9g}  pitch = {:.9g}  yaw = {:.9g} rad  ({:.6g}, {:.6g}, {:.6g} deg)\n",
                  shown(angles(0)), shown(angles(1)), shown(angles(2)), shown(angles(0) * kDegrees),
                  shown(angles(1) * kDegrees), shown(angles(2) * kDegrees));
  text += "transform of the tool\n" + text_of(report.tool.matrix(), 4);
  text += "Jacobian, rows x y z wx wy wz\n" + text_of(report.jacobian, static_cast<int>(names.size()));
  return text;
}

std::string pose_json(const ChainDescription& chain, const PoseReport& report) {
  const auto count = static_cast<std::ptrdiff_t>(chain.table.count);
  const auto& p = report.tool.position_m;
  // -0 becomes 0.
  const kinematics::Vector3<double> angles = report.angles_rad + kinematics::Vector3<double>::Zero();
  const nlohmann::json json{
      {"schema", "morepro.kinematics/1"},
      {"joint_names", joint_names(chain.table)},
      {"joints", std::vector<double>(report.joints.begin(), report.joints.begin() + count)},
      {"position_m", {p(0), p(1), p(2)}},
      {"angles_rad", {angles(0), angles(1), angles(2)}},
      {"transform", rows_of(report.tool.matrix(), 4)},
      {"jacobian", rows_of(report.jacobian, static_cast<int>(chain.table.count))}};
  return json.dump(2) + "\n";
}

}  // namespace morepro::host
