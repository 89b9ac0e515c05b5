#pragma once
#include <Eigen/Core>
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

/// What shapes put the values of an axis off by.
struct ShapeErrors {
  std::vector<ShapeError> of_effect{};
  Eigen::VectorXd of_value{};  ///< by free shapes, in the units of the parameters' columns; empty: none
};

/// What has no name, as a multiple of what noise puts values off by: in the balance of motion, and of
/// voltage.
struct UnnamedError {
  double of_motion = 0.0;
  double of_voltage = 0.0;
};

/// Refitted parameters of an axis, with what the recording tells about each. What shapes and what has no name
/// put values off by is in the standard errors, up to how far a datasheet is.
std::vector<ParameterResult> parameters_of(const AxisFit& fit, const ShapeErrors& by_shape = {},
                                           const UnnamedError& unnamed = {});

/// How far noise may put refitted values off, as one standard deviation for all of an axis, relative: the
/// geometric mean over them, and at least what a machine changes by from day to day, 0.005; at most 0.5.
double spread_of(const AxisFit& fit);

/// Does the recording tell more of the axis than a steady state does?
bool is_excited(const AxisFit& fit);

}  // namespace morepro::host
