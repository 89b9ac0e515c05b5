#pragma once
#include <span>
#include <vector>

#include "sim_host/diagnose/board/fitted_machine.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"

namespace morepro::host {

/// From which sizes on effects that have no name here would have had one, with two standard deviations to
/// spare: each alone beside the names, in the plain law that `simulate --effect` has, from the beginning,
/// beside the fitted model and the noise that is in the recording. Axis by axis, in the catalogue's order;
/// none beside a verdict of `found` that leaves something open. What the names cannot be told from is left
/// out, as are what the channels cannot show (notices say so), what is no law of a balance (sampling), and
/// what is not linear enough for a limit (backlash, a shaft).
std::vector<DetectionLimit> detection_limits(std::span<const AxisOutcome> outcomes,
                                             const DiagnosisResult& found,
                                             std::span<const gap::Effect> excluded,
                                             const ScalesOfEffects& scales);

}  // namespace morepro::host
