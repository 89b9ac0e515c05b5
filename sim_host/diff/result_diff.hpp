#pragma once
#include <string>

#include "sim_host/diff/diff_result.hpp"
#include "sim_host/diff/tolerances.hpp"

namespace morepro::host {

/// Compares two JSON results (of replay, identify, diagnose) value by value. A value is named by its path,
/// "chip_load_mm.estimate"; in a list of things with names by those, "parameters[mass_kg].estimate". Speed
/// and file names are not compared: they say nothing about the machine. Throws UserError where a file is no
/// JSON or the two are of different schemas, UsageError where a tolerance is for a value that neither has.
DiffResult diff_results(const std::string& a, const std::string& b, const Tolerances& tolerances);

}  // namespace morepro::host
