#pragma once
#include <Eigen/Core>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// By how much the bend of a law bends it where its cause is largest in the recording, as a share of the law.
double largest_bend(const gap::EffectForm& form, const AxisFit& fit);

/// Standard errors by the shapes of the laws in a model: by how much a value changes where a law may bend and
/// its range may be another one, as far as machines differ in that (three tenths) and the recording lets
/// them, and how much less is known then. Zeros where no law has such a freedom.
struct FreeShapeErrors {
  Eigen::VectorXd of_parameter;   ///< in the units of the parameters' columns
  std::vector<double> of_effect;  ///< as shares of the sizes; 0 of sines, widths and stiffnesses
};

FreeShapeErrors error_by_free_shapes(const AxisFit& fit);

}  // namespace morepro::host
