#pragma once
#include "sim_host/kinematics/trajectory.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// Writes a trajectory as CSV: time, the joints with their rates and accelerations, the wanted tool with its
/// speed and acceleration, and what the joints are off; shortest digits that give the same number back.
class TrajectoryCsv {
 public:
  /// The file is the caller's to commit.
  TrajectoryCsv(OutputFile& file, const KinematicsJob& job);
  void write(const TrajectoryRow& row);

 private:
  OutputFile& file_;
  std::size_t joints_;
};

}  // namespace morepro::host
