#pragma once
#include "lib/monitor/health.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// The monitor's answer to every frame as CSV; an empty field where there is none. The file is the caller's
/// to commit.
class HealthCsv {
 public:
  /// `grid_first_mm`, `grid_step_mm`: chip load of hypothesis k is first + k step.
  HealthCsv(OutputFile& file, double grid_first_mm, double grid_step_mm);
  void write(const Health& health);

 private:
  OutputFile& file_;
  double grid_first_mm_;
  double grid_step_mm_;
};

}  // namespace morepro::host
