#pragma once
#include <Eigen/Core>
#include <vector>

#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// A coefficient as the innovations give it. An error of 0: they do not.
struct KnownCoefficient {
  double value = 0.0;
  double error = 0.0;
};

/// One balance over every sampling interval: increment = regressors * coefficients + what the model lacks.
/// Inputs are held, so that their integrals are exact; sampled signals by the trapezoid, the current by the
/// exact weights of the electrical lag. NaN where a sample is missing.
struct BalanceIncrements {
  gap::Balance balance = gap::Balance::kSpindleTorque;
  Eigen::MatrixXf columns;              ///< intervals x [nominal regressors, effects in the model, increment]
  std::vector<KnownCoefficient> known;  ///< of the first regressors, with the effects
  std::vector<KnownCoefficient> nominal;  ///< the same without them
};

std::vector<BalanceIncrements> balance_increments(const AxisDiagnosis& diagnosis);

}  // namespace morepro::host
