#pragma once
#include <vector>

#include "lib/gap/applied_effect.hpp"
#include "lib/gap/gap_frame.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::host {

/// A model of the machine that the diagnosis tries: parameters, effects, and how random the machine is.
struct GapModel {
  MachineParameters machine;
  gap::ReferencePoint point;
  std::vector<gap::AppliedEffect> known{};    ///< of the machine file, as they stand there
  std::vector<gap::AppliedEffect> effects{};  ///< found so far
  gap::GapNoise<double> noise;
};

/// The halves of the machine that share nothing: their balances are tried apart.
enum class Axis { kSpindle, kFeed };

}  // namespace morepro::host
