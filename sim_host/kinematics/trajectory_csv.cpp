#include "sim_host/kinematics/trajectory_csv.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <iterator>

namespace morepro::host {
namespace {

constexpr std::string_view kToolColumns =
    ",x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad"
    ",speed_x_m_s,speed_y_m_s,speed_z_m_s,turn_x_rad_s,turn_y_rad_s,turn_z_rad_s"
    ",acceleration_x_m_s2,acceleration_y_m_s2,acceleration_z_m_s2,turn_x_rad_s2,turn_y_rad_s2,turn_z_rad_s2"
    ",error_x_m,error_y_m,error_z_m,error_x_rad,error_y_rad,error_z_rad\n";

double without_sign_of_zero(double value) { return value + 0.0; }

class Line {
 public:
  explicit Line(double time_s) { fmt::format_to(std::back_inserter(text_), FMT_COMPILE("{}"), time_s); }

  void add(double value) {
    fmt::format_to(std::back_inserter(text_), FMT_COMPILE(",{}"), without_sign_of_zero(value));
  }
  template <class Values>
  void add_all(const Values& values) {
    for (int i = 0; i < values.size(); ++i) add(values(i));
  }
  std::string_view ended() {
    text_.push_back('\n');
    return {text_.data(), text_.size()};
  }

 private:
  fmt::memory_buffer text_;
};

}  // namespace

TrajectoryCsv::TrajectoryCsv(OutputFile& file, const KinematicsJob& job)
    : file_(file), joints_(job.chain.table.count) {
  const std::vector<std::string> names = joint_names(job.chain.table);
  std::string head = "time_s";
  for (const std::string_view suffix : {"", "_s", "_s2"}) {
    for (std::size_t i = 0; i < joints_; ++i)
      head += fmt::format(",{}_{}{}", names[i], unit_of(job.chain.table.joints[i]), suffix);
  }
  file_.write(head);
  file_.write(kToolColumns);
}

void TrajectoryCsv::write(const TrajectoryRow& row) {
  Line line(row.time_s);
  for (const auto* values : {&row.joints, &row.rate, &row.acceleration}) {
    for (std::size_t i = 0; i < joints_; ++i) line.add((*values)[i]);
  }
  line.add_all(row.tool.position_m);
  line.add_all(row.tool.angles_rad);
  line.add_all(row.tool.speed);
  line.add_all(row.tool.acceleration);
  line.add_all(row.error);
  file_.write(line.ended());
}

}  // namespace morepro::host
