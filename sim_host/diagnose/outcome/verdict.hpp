#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/signals/sampling_checks.hpp"

namespace morepro::host {

/// What a deviance is worth as a share of the noise's power, over `rows` samples.
double excess_of(double deviance, std::size_t rows);

/// What the verdict "effect" says: whether its names explain the gap, how much of it where something is left,
/// and in which balances that is.
std::string meaning_of_effects(const DiagnosisResult& result);

/// What "unexplained" says where a model that runs free is lost in these balances.
std::string meaning_of_lost(std::span<const std::string_view> balances);
/// The same where no model follows an axis at all.
inline constexpr std::string_view kMeaningOfRunaway =
    "with the values and effects of the machine file a model runs away from what is measured: "
    "see the balances that are not evaluated";

/// Fills in the verdict by the evidence, with what it rests on: threshold, temperature, what has no name.
void judge(std::span<const AxisOutcome> outcomes, const std::vector<SamplingFault>& faults, std::size_t rows,
           DiagnosisResult& result);

}  // namespace morepro::host
