#pragma once
#include <array>

#include "lib/estimation/spindle_signals.hpp"
#include "lib/estimation/ud_covariance.hpp"
#include "lib/math/matrix_exponential.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro {

/// Inputs of the feed axis that were held over the period that ends with the present frame.
template <class Real>
struct FeedInput {
  Real force_n{};
  Real contact{};     ///< 0 or 1
  Real engagement{};  ///< dimensionless, >= 0
};

/// Measurements at the present frame; a variance of kUnmeasured says that the channel is missing.
template <class Real>
struct FeedMeasurement {
  Real speed_m_s{};
  Real position_m{};
  Real speed_variance{};
  Real position_variance{};

  [[nodiscard]] bool has_speed() const { return speed_variance < Real(kUnmeasured); }
  [[nodiscard]] bool has_position() const { return position_variance < Real(kUnmeasured); }
};

/// Kalman filter of the feed axis, state [position, speed], exact for inputs that are held:
/// dv = (F1 - bx v - Fc (F2 alpha + c))/m. The same for every chip-load hypothesis, so the bank has it once.
/// Bounded time; may run in an interrupt.
template <class Real>
class FeedFilter {
 public:
  FeedFilter(const MachineParameters::Feed& feed, double period_s, Real speed_process_variance)
      : contact_force_(static_cast<Real>(feed.contact_force_n)),
        contact_offset_(static_cast<Real>(feed.contact_offset_n)),
        q_{speed_process_variance * static_cast<Real>(period_s * period_s), speed_process_variance} {
    const auto step = math::exponential_step(
        math::Matrix2{0.0, 1.0, 0.0, -feed.viscous_friction_ns_m / feed.mass_kg}, period_s);
    x_per_v_ = static_cast<Real>(step.exp.a01);
    v_per_v_ = static_cast<Real>(step.exp.a11);
    x_per_n_ = static_cast<Real>(step.integral.a01 / feed.mass_kg);
    v_per_n_ = static_cast<Real>(step.integral.a11 / feed.mass_kg);
  }

  /// Starts from the measurement; what is not measured starts at 0 with variance 1 in its unit.
  void start(const FeedMeasurement<Real>& y) {
    x_ = y.has_position() ? y.position_m : Real(0);
    v_ = y.has_speed() ? y.speed_m_s : Real(0);
    covariance_ = Covariance(
        {y.has_position() ? y.position_variance : Real(1), y.has_speed() ? y.speed_variance : Real(1)});
  }

  void predict(const FeedInput<Real>& input) {
    const Real force = input.force_n - input.contact * (contact_force_ * input.engagement + contact_offset_);
    x_ += x_per_v_ * v_ + x_per_n_ * force;
    v_ = v_per_v_ * v_ + v_per_n_ * force;
    covariance_.predict({{{Real(1), x_per_v_}, {Real(0), v_per_v_}}}, {}, q_);
  }

  /// Innovations of speed and position with their variances, without using the measurement; meaningful for
  /// the channels that are measured.
  [[nodiscard]] FeedMeasurement<Real> innovation(const FeedMeasurement<Real>& y) const {
    return {y.speed_m_s - v_, y.position_m - x_, covariance_.variance(kSpeed) + y.speed_variance,
            covariance_.variance(kPosition) + y.position_variance};
  }

  /// Uses the measurements; returns the normalised innovation squared.
  Real update(const FeedMeasurement<Real>& y) {
    Real nis{};
    if (y.has_speed()) nis += update_one<kSpeed>(y.speed_m_s - v_, y.speed_variance);
    if (y.has_position())
      nis += update_one<kPosition>(y.position_m - x_, y.position_variance);
    else
      forget_position();
    return nis;
  }

  [[nodiscard]] Real position_m() const { return x_; }
  [[nodiscard]] Real speed_m_s() const { return v_; }
  [[nodiscard]] Real speed_variance() const { return covariance_.variance(kSpeed); }

 private:
  using Covariance = UdCovariance<Real, 2>;
  static constexpr std::size_t kPosition = 0, kSpeed = 1;

  template <std::size_t kElement>
  Real update_one(Real innovation, Real variance) {
    const auto update = covariance_.template update<kElement>(variance);
    x_ += update.gain[kPosition] * innovation;
    v_ += update.gain[kSpeed] * innovation;
    return innovation * innovation / update.innovation_variance;
  }

  /// A position that nobody measures is a sum of speeds whose variance grows without end: it is held at 0 +-
  /// 1 m.
  void forget_position() {
    if (covariance_.variance(kPosition) <= Real(1)) return;
    x_ = Real(0);
    covariance_.restart(kPosition, Real(1));
  }

  Real contact_force_, contact_offset_;
  Real x_per_v_{}, v_per_v_{}, x_per_n_{}, v_per_n_{};
  std::array<Real, 2> q_;
  Real x_{}, v_{};
  Covariance covariance_{{Real(1), Real(1)}};
};

}  // namespace morepro
