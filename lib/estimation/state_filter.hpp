#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "lib/math/ldl.hpp"
#include "lib/plant/integrators.hpp"

namespace morepro {

/// What became of one measurement.
enum class UpdateStatus : std::uint8_t {
  kAccepted = 0,
  kNotFinite = 1,    ///< the measurement or the prediction holds a NaN or an infinity: nothing was changed
  kNotPositive = 2,  ///< the innovation covariance is not positive definite: nothing was changed
  kGated = 3,        ///< too far from its prediction: nothing was changed
};

/// One update. Vectors in the order of PlantIndex: rad/s, m/s, A.
template <class Real>
struct UpdateResult {
  Eigen::Matrix<Real, kPlantStates, 1> innovation = Eigen::Matrix<Real, kPlantStates, 1>::Zero();
  Real nis = 0;             ///< normalised innovation squared; 3 on average where the model is right
  Real log_likelihood = 0;  ///< of the innovation, natural logarithm
  UpdateStatus status = UpdateStatus::kNotFinite;
};

/// The outputs that the thesis's bank compares: angular acceleration and current.
template <class Real>
struct ThesisOutput {
  Real acceleration_rad_s2 = 0;
  Real current_a = 0;
};

/// Extended Kalman filter of the whole plant with measured speed, feed speed and current (H = I). The mean
/// takes an RK4 step, the covariance Phi P Phi^T + Q with Phi = exp(h A) to fourth order, the update has
/// Joseph's form. x, P, Q, R, S, K are the textbook's. A reference for the bank, which keeps only the entries
/// that are not zero. No heap, bounded time: may run in an interrupt.
template <class Real>
class StateFilter {
 public:
  using Vector = Eigen::Matrix<Real, kPlantStates, 1>;
  using Matrix = Eigen::Matrix<Real, kPlantStates, kPlantStates>;

  /// Covariances in squared units of PlantIndex: initial, process noise per step, measurement noise.
  struct Covariances {
    Matrix initial = Matrix::Identity();
    Matrix process = Matrix::Zero();
    Matrix measurement = Matrix::Identity();
  };

  /// Check check_rk4_step(machine, step_s) before.
  StateFilter(const MachineParameters& machine, double step_s, const PlantState<Real>& initial,
              const Covariances& covariances)
      : integrator_(machine, step_s),
        step_s_(static_cast<Real>(step_s)),
        q_(covariances.process),
        r_(covariances.measurement),
        x_(initial),
        p_(covariances.initial) {}

  /// One step ahead under an input that is held.
  void predict(const PlantInput<Real>& input) {
    const Matrix phi = transition(input);
    x_ = integrator_.step(x_, input);
    p_ = symmetric(phi * p_ * phi.transpose() + q_);
  }

  /// Takes a measured state unless its normalised innovation squared is above `gate`.
  [[nodiscard]] UpdateResult<Real> update(const PlantState<Real>& measured,
                                          Real gate = std::numeric_limits<Real>::infinity()) {
    UpdateResult<Real> result;
    result.innovation = vector_of(measured) - vector_of(x_);
    if (!result.innovation.allFinite()) return result;
    const math::Ldl<Real, kPlantStates> s(Matrix(p_ + r_));
    result.status = s.is_positive() ? UpdateStatus::kAccepted : UpdateStatus::kNotPositive;
    if (result.status != UpdateStatus::kAccepted) return result;
    result.nis = result.innovation.dot(s.solve(result.innovation));
    result.log_likelihood = Real(-0.5) * (result.nis + s.log_determinant() + Real(kPlantStates) * kLogTwoPi);
    if (result.nis <= gate) {
      correct(s, result.innovation);
    } else {
      result.status = UpdateStatus::kGated;
    }
    return result;
  }

  /// exp(h A) at the estimate, to fourth order in h.
  Matrix transition(const PlantInput<Real>& input) const {
    const Matrix z = integrator_.plant().state_jacobian(x_, input) * step_s_;
    Matrix phi = Matrix::Identity();
    for (int k = 4; k >= 1; --k) phi = (Matrix::Identity() + z * phi / Real(k)).eval();
    return phi;
  }

  const PlantState<Real>& state() const { return x_; }
  const Matrix& covariance() const { return p_; }
  const Plant<Real>& plant() const { return integrator_.plant(); }

  /// At the estimate.
  ThesisOutput<Real> thesis_output(const PlantInput<Real>& input) const {
    return {plant().derivative(x_, input).acceleration_rad_s2, x_.current_a};
  }

 private:
  static constexpr Real kLogTwoPi = Real(1.8378770664093453);

  static Vector vector_of(const PlantState<Real>& x) {
    return {x.speed_rad_s, x.feed_speed_m_s, x.current_a};
  }
  static Matrix symmetric(const Matrix& p) { return Real(0.5) * (p + p.transpose()); }

  void correct(const math::Ldl<Real, kPlantStates>& s, const Vector& innovation) {
    Matrix k_transposed;
    for (int i = 0; i < kPlantStates; ++i) k_transposed.col(i) = s.solve(p_.col(i));
    const Matrix k = k_transposed.transpose();
    const Vector step = k * innovation;
    x_ = {x_.speed_rad_s + step(kSpeedIndex), x_.feed_speed_m_s + step(kFeedSpeedIndex),
          x_.current_a + step(kCurrentIndex)};
    const Matrix kept = Matrix::Identity() - k;
    p_ = symmetric(kept * p_ * kept.transpose() + k * r_ * k.transpose());
  }

  Rk4Integrator<Real> integrator_;
  Real step_s_;
  Matrix q_;
  Matrix r_;
  PlantState<Real> x_;
  Matrix p_;
};

}  // namespace morepro
