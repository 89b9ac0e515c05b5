#pragma once
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"

namespace morepro::host {

/// Refitted parameters of an axis, with what the recording tells about each.
std::vector<ParameterResult> parameters_of(const AxisFit& fit);

/// How far refitted values may be off, as one standard deviation for all of an axis, relative: the geometric
/// mean of their standard errors, and at least what a machine changes by from day to day, 0.005; at most 0.5.
double spread_of(const AxisFit& fit);

/// Does the recording tell more of the axis than a steady state does?
bool is_excited(const AxisFit& fit);

}  // namespace morepro::host
