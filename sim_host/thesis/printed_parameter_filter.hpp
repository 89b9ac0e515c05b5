#pragma once
#include <Eigen/Core>
#include <Eigen/LU>

#include "lib/plant/dynamics.hpp"

namespace morepro::host::thesis {

/// The filter of the thesis's section 5.1, to the letter: a random walk of seven parameters, measured by the
/// derivatives of speed, feed speed and current, with the covariance P = (I - L C) P, which is neither kept
/// symmetric nor positive. Shown, never used for an answer: lib/identification is.
class PrintedParameterFilter {
 public:
  static constexpr int kCount = static_cast<int>(kParameterCount);
  using Theta = Eigen::Matrix<double, kCount, 1>;
  using Covariance = Eigen::Matrix<double, kCount, kCount>;
  using Output = Eigen::Vector3d;  ///< rad/s2, m/s2, A/s

  /// Covariances in squared units: of the start, of the walk per step, of the measured derivatives
  /// (diagonal).
  PrintedParameterFilter(const MachineParameters& machine, const Theta& start,
                         const Covariance& start_covariance, const Covariance& walk,
                         const Output& measurement_variance)
      : plant_(machine),
        theta_(start),
        p_(start_covariance),
        walk_(walk),
        r_(measurement_variance.asDiagonal()) {}

  /// One step with the measured state, the inputs and the measured derivatives.
  void step(const PlantState<double>& x, const PlantInput<double>& u, const Output& measured) {
    Plant<double>::Theta values{};
    for (int j = 0; j < kCount; ++j) values[static_cast<std::size_t>(j)] = theta_(j);
    plant_.set_theta(values);
    const PlantDerivative<double> g = plant_.derivative(x, u);
    const Eigen::Matrix<double, kPlantStates, kCount> c = plant_.parameter_jacobian(x, u);
    p_ += walk_;
    const Eigen::Matrix3d s = c * p_ * c.transpose() + r_;
    const Eigen::Matrix<double, kCount, kPlantStates> gain = p_ * c.transpose() * s.inverse();
    theta_ += gain * (measured - Output(g.acceleration_rad_s2, g.feed_acceleration_m_s2, g.current_rate_a_s));
    p_ = ((Covariance::Identity() - gain * c) * p_).eval();
  }

  [[nodiscard]] const Theta& theta() const { return theta_; }
  [[nodiscard]] const Covariance& covariance() const { return p_; }

 private:
  Plant<double> plant_;
  Theta theta_;
  Covariance p_;
  Covariance walk_;
  Eigen::Matrix3d r_;
};

}  // namespace morepro::host::thesis
