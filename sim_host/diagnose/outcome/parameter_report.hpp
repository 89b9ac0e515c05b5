#pragma once
#include <span>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"

namespace morepro::host {

/// How far the size of an effect of the model may be off because its shape is not the machine's.
struct ShapeError {
  gap::Effect effect;
  double of_size;   ///< as a share of it
  double of_noise;  ///< what its balances keep of their gap, as a multiple of what noise puts sizes off by
};

/// Refitted parameters of an axis, with what the recording tells about each. What shapes put values off by is
/// in the standard errors, up to how far a datasheet is; whether a recording tells a value is a matter of its
/// noise alone.
std::vector<ParameterResult> parameters_of(const AxisFit& fit, std::span<const ShapeError> by_shape = {});

/// How far refitted values may be off, as one standard deviation for all of an axis, relative: the geometric
/// mean of their standard errors, and at least what a machine changes by from day to day, 0.005; at most 0.5.
double spread_of(const AxisFit& fit);

/// Does the recording tell more of the axis than a steady state does?
bool is_excited(const AxisFit& fit);

}  // namespace morepro::host
