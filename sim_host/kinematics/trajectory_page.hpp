#pragma once
#include <string>
#include <vector>

#include "sim_host/kinematics/trajectory.hpp"

namespace morepro::host {

/// Gathers a trajectory for the page that shows the machine moving along it. Keeps 2,000 to 4,000 rows,
/// evenly spaced, and the last one: more cannot be seen.
class TrajectoryPage {
 public:
  /// Throws UserError where this program was built without its pages.
  explicit TrajectoryPage(const KinematicsJob& job);

  void add(const TrajectoryRow& row);
  /// What the page shows. `summary` is its one line of text.
  [[nodiscard]] std::string json(std::string_view summary) const;
  /// The page, one HTML file.
  [[nodiscard]] std::string html(std::string_view summary) const;

 private:
  [[nodiscard]] std::vector<TrajectoryRow> shown() const;

  const KinematicsJob& job_;
  std::vector<TrajectoryRow> kept_;
  TrajectoryRow last_;
  std::size_t rows_ = 0;
  std::size_t stride_ = 1;
};

}  // namespace morepro::host
