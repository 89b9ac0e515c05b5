#pragma once
#include <string>
#include <vector>

#include "rows.hpp"

namespace blind {

/// A recording as the baselines use it: the columns of the rows, and those that only terms need.
struct Measured {
  Columns columns;
  std::vector<double> time_s, winding_c, x, cut_s;
};

/// Errors: std::runtime_error with the line.
Measured read_recording(const std::string& path);

/// The datasheet of a machine file, with its sensors. Errors: std::runtime_error.
Machine read_machine(const std::string& path);

}  // namespace blind
