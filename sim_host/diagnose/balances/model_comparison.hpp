#pragma once
#include <cstdint>

#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// How long a model runs free before it is compared.
double horizon_s(const RecordingSignals& signals);

/// One-step and free-run errors of an axis, relative to the standard deviation of what is measured. Each
/// piece of the recording is judged by models that were fitted without it and every other one; the 90 %
/// intervals come from drawing the pieces anew, reproducibly by `seed`.
void compare_models(const AxisDiagnosis& diagnosis, std::uint64_t seed, Shrinkage& shrinkage);

}  // namespace morepro::host
