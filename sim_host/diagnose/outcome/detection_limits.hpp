#pragma once
#include <span>
#include <vector>

#include "sim_host/diagnose/board/fitted_machine.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"

namespace morepro::host {

/// From which sizes on effects that have no name here would have had one, in 97 of 100 such recordings: the
/// plain laws that `simulate --effect` has, from the beginning, beside the fitted model and the noise that is
/// in the recording. Axis by axis, in the catalogue's order. Left out are what its channels cannot show
/// (notices say so), what is no law of a balance (sampling), or not linear enough for a limit (backlash, a
/// shaft).
std::vector<DetectionLimit> detection_limits(std::span<const AxisOutcome> outcomes,
                                             std::span<const gap::Effect> excluded,
                                             const ScalesOfEffects& scales);

}  // namespace morepro::host
