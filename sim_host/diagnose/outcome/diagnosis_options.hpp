#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

struct DiagnosisOptions {
  int bootstrap_runs = 200;           ///< 0: a fixed threshold
  std::vector<gap::Effect> excluded;  ///< taken out of the catalogue
  std::uint64_t seed = 1;
  /// How far the search for effects is, 0 .. 1. Called by several threads, one at a time.
  std::function<void(double share)> on_progress = [](double) {};
  /// Called for each axis at the end, with all that was found out about it.
  std::function<void(const AxisDiagnosis&)> on_axis = [](const AxisDiagnosis&) {};
};

}  // namespace morepro::host
