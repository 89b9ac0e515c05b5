#pragma once
#include <array>
#include <cstddef>

#include "lib/identification/derivative_parameter_filter.hpp"
#include "lib/identification/information_window.hpp"
#include "lib/math/elementary.hpp"

namespace morepro {

/// Does the last window tell a parameter? Only kAlone learns; kPair learns in the one direction that is told.
enum class Information : std::uint8_t {
  kNone,   ///< nothing: the parameter is frozen
  kPair,   ///< a combination with `partner` only
  kAlone,  ///< the parameter itself
};

/// Variances of the sensors that the rows of equation 22 are made of.
template <class Real>
struct RegressorNoise {
  Real speed_variance{};
  Real feed_speed_variance{};
  Real current_variance{};
};

/// DerivativeParameterFilter with its guards. Noise of speed and current turns the line on which two
/// parameters lie and pumps those that a derivative multiplies (errors in the variables): so a slope stands
/// still while its state only shivers, and a derivative counts from five standard deviations on. Per window
/// of frames it is asked what the frames tell of each parameter and of each combination; what they do not
/// tell neither learns nor drifts.
template <class Real>
class DerivativeIdentification {
 public:
  static constexpr std::size_t kWindowFrames = 2048;

  DerivativeIdentification(const MachineParameters& machine, const RegressorNoise<Real>& noise,
                           Real start_fraction, Real drift_fraction)
      : filter_(machine, start_fraction),
        noise_(noise),
        spindle_friction_(static_cast<Real>(machine.spindle.viscous_friction_nms_rad)),
        feed_friction_(static_cast<Real>(machine.feed.viscous_friction_ns_m)),
        drift_fraction_(drift_fraction) {
    information_.fill(Information::kAlone);
    for (std::size_t j = 0; j < kParameterCount; ++j) partner_[j] = static_cast<Parameter>(j);
  }

  /// One frame, with the derivatives that were measured in it.
  void step(const DerivativeInput<Real>& u, const DerivativeMeasurement<Real>& y) {
    hold_regressors(u);
    if (y.acceleration_variance < Real(kUnmeasured)) step_torque(u, y);
    if (y.feed_acceleration_variance < Real(kUnmeasured)) step_force(u, y);
    if (y.current_rate_variance < Real(kUnmeasured)) step_voltage(u, y);
    // What was learnt so far is a start, not a certainty.
    if (++frames_ == kSettleFrames) filter_.restart_covariance();
    if (frames_ % kParameterCount == 0) drift();
  }

  [[nodiscard]] const DerivativeParameterFilter<Real>& filter() const { return filter_; }
  /// Of the last complete window; kAlone before the first.
  [[nodiscard]] Information information(Parameter parameter) const {
    return information_[index_of(parameter)];
  }
  /// With which parameter only a combination is told.
  [[nodiscard]] Parameter partner(Parameter parameter) const { return partner_[index_of(parameter)]; }

 private:
  static constexpr std::size_t kSettleFrames = 128;
  static constexpr double kHeld = 10.0;     // standard deviations that a state must leave its held value by
  static constexpr double kMoves = 5.0;     // and that a derivative must be away from zero
  static constexpr double kEnough = 100.0;  // information of a window: a standard error of 10 %
  static constexpr double kLeastShare = 1.0e-3;  // a thousand frames of one direction tell no more of it
  static constexpr double kOwnShare = 0.02;      // of it that must be a parameter's own

  static Real square(Real x) { return x * x; }
  static Real held(Real value, Real now, Real variance) {
    return square(now - value) > Real(kHeld * kHeld) * variance ? now : value;
  }
  static Real gated(Real slope, Real derivative, Real variance) {
    return square(derivative) > Real(kMoves * kMoves) * variance ? slope : Real(0);
  }
  /// The same, but not before the other parameters fit: a wrong datasheet predicts derivatives that are not
  /// there.
  [[nodiscard]] Real gated_later(Real slope, Real derivative, Real variance) const {
    return frames_ < kSettleFrames ? Real(0) : gated(slope, derivative, variance);
  }

  void hold_regressors(const DerivativeInput<Real>& u) {
    speed_ = held(speed_, u.speed_rad_s, noise_.speed_variance);
    current_ = held(current_, u.current_a, noise_.current_variance);
  }

  void step_torque(const DerivativeInput<Real>& u, const DerivativeMeasurement<Real>& y) {
    auto row = filter_.torque_row(u);
    const Real per_current = filter_.value(Parameter::kTorqueConstant) / filter_.value(Parameter::kInertia);
    const Real per_speed = spindle_friction_ / filter_.value(Parameter::kInertia);
    const Real noise =
        square(per_current) * noise_.current_variance + square(per_speed) * noise_.speed_variance;
    row.slope[0] = current_ / filter_.value(Parameter::kInertia);
    row.slope[1] = gated_later(row.slope[1], row.derivative, noise);
    const Real variance = y.acceleration_variance + noise;
    const Real least = see(torque_window_, Parameter::kTorqueConstant, row, variance);
    filter_.learn_torque(row, y.acceleration_rad_s2, variance, least);
  }

  void step_force(const DerivativeInput<Real>& u, const DerivativeMeasurement<Real>& y) {
    auto row = filter_.force_row(u);
    const Real noise = square(feed_friction_ / filter_.value(Parameter::kMass)) * noise_.feed_speed_variance;
    row.slope[0] = gated(row.slope[0], row.derivative, noise);
    const Real variance = y.feed_acceleration_variance + noise;
    const Real least = see(force_window_, Parameter::kMass, row, variance);
    filter_.learn_force(row, y.feed_acceleration_m_s2, variance, least);
  }

  void step_voltage(const DerivativeInput<Real>& u, const DerivativeMeasurement<Real>& y) {
    auto row = filter_.voltage_row(u);
    const Real per_inductance = Real(1) / filter_.value(Parameter::kInductance);
    const Real noise =
        square(filter_.value(Parameter::kResistance) * per_inductance) * noise_.current_variance +
        square(filter_.value(Parameter::kBackEmfConstant) * per_inductance) * noise_.speed_variance;
    row.slope[0] = gated_later(row.slope[0], row.derivative, noise);
    row.slope[1] = -current_ * per_inductance;
    row.slope[2] = -speed_ * per_inductance;
    const Real variance = y.current_rate_variance + noise;
    const Real least = see(voltage_window_, Parameter::kInductance, row, variance);
    filter_.learn_voltage(row, y.current_rate_a_s, variance, least);
  }

  /// Counts what the row tells, then takes what the last window did not tell out of it. `first`: the
  /// parameter of its first slope. Returns how uncertain the row's prediction must be to be used: where only
  /// a combination is told, and that is known, rounding and the bend of the line on which its parameters lie
  /// would move them along it.
  template <std::size_t kN>
  Real see(InformationWindow<Real, kN>& window, Parameter first, DerivativeRow<Real, kN>& row,
           Real variance) {
    std::array<Real, kN> relative{};
    for (std::size_t j = 0; j < kN; ++j) relative[j] = row.slope[j] * filter_.value(at(first, j));
    window.take(relative, Real(1) / variance);
    if (window.frames() == kWindowFrames) judge(window, first);
    bool is_all = true;
    for (std::size_t j = 0; j < kN; ++j) {
      const Information told = information(at(first, j));
      if (told == Information::kNone) row.slope[j] = Real(0);
      is_all = is_all && told == Information::kAlone;
    }
    return is_all ? Real(0) : Real(kLeastShare);
  }

  template <std::size_t kN>
  void judge(InformationWindow<Real, kN>& window, Parameter first) {
    window.close();
    for (std::size_t j = 0; j < kN; ++j) {
      const Real each = window.each(j);
      const bool is_own = window.alone(j) > Real(kOwnShare) * each && window.alone(j) > Real(kEnough);
      information_[index_of(at(first, j))] = !(each > Real(kEnough)) ? Information::kNone
                                             : is_own                ? Information::kAlone
                                                                     : Information::kPair;
      partner_[index_of(at(first, j))] = at(first, window.partner(j));
    }
  }

  /// One parameter in turn; a random walk costs as much as a measurement.
  void drift() {
    turn_ = turn_ + 1 < kParameterCount ? turn_ + 1 : 0;
    const auto parameter = static_cast<Parameter>(turn_);
    filter_.bound(parameter);
    // A turn comes every kParameterCount^2 frames; a random walk grows with the root of them.
    constexpr auto kRootOfFrames = static_cast<Real>(kParameterCount);
    if (information(parameter) == Information::kAlone)
      filter_.drift(parameter, kRootOfFrames * drift_fraction_);
  }

  static constexpr Parameter at(Parameter first, std::size_t j) {
    return static_cast<Parameter>(index_of(first) + j);
  }

  DerivativeParameterFilter<Real> filter_;
  RegressorNoise<Real> noise_;
  Real spindle_friction_;
  Real feed_friction_;
  Real drift_fraction_;
  Real speed_{}, current_{};  ///< held
  InformationWindow<Real, 2> torque_window_;
  InformationWindow<Real, 2> force_window_;
  InformationWindow<Real, 3> voltage_window_;
  std::array<Information, kParameterCount> information_{};
  std::array<Parameter, kParameterCount> partner_{};
  std::size_t frames_ = 0;
  std::size_t turn_ = 0;
};

}  // namespace morepro
