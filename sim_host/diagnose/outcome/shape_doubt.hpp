#pragma once
#include <span>
#include <vector>

#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/outcome/parameter_report.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// Does an effect act in what a balance sums up? A sensor's acts in none: it disturbs what it is part of.
bool acts_in(const RecordingSignals& signals, const BalanceResult& balance, gap::Effect effect);

/// By how much the size of each effect of an axis may be off because the machine's shape is not the
/// catalogue's. What the balances keep of their gap is joined to the standard errors of `which`: least
/// squares leave nothing that lies in the direction of an effect, but of another shape as much lies there as
/// in any other direction, and has gone into the size.
std::vector<ShapeError> doubt_sizes(const AxisDiagnosis& diagnosis, std::span<const BalanceResult> where,
                                    std::span<EffectResult> which);

/// Joins to the standard errors of all sizes what their shapes may put them off by, and fills in the
/// parameters of a result with the same: what a gap keeps beside names may have gone into their sizes, and
/// into the parameters with them.
void doubt_shapes(std::span<const AxisOutcome> outcomes, DiagnosisResult& result);

}  // namespace morepro::host
