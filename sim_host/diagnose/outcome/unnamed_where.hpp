#pragma once
#include <vector>

#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"

namespace morepro::host {

/// Does most of an axis's structure without a name sit in this balance?
bool shows_unnamed(const AxisOutcome& outcome, const BalanceResult& balance);

/// Where that structure lies: residual ratios and cells of the balances that show it, over the noise beside
/// nameless functions that take it, and its lines. `balances` are those of the model with the names. Of lines
/// and functions that take the same, one kind stays in `outcome`.
void show_unnamed(AxisOutcome& outcome, std::vector<BalanceResult>& balances);

/// What those functions are functions of, the most important one first; none where they stand in for lines.
std::vector<FollowedSignal> followed_by_unnamed(const AxisOutcome& outcome);

}  // namespace morepro::host
