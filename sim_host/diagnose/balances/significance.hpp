#pragma once
#include <vector>

#include "sim_host/diagnose/result/diagnosis_result.hpp"

namespace morepro::host {

/// By chance, how often would the mean power of `rows` independent rows be so many times what is expected?
double p_value_of(double ratio, double rows);

/// Many cells are looked at, and one of them is always large: Holm's correction.
void correct_for_number(std::vector<GapCell>& cells);

}  // namespace morepro::host
