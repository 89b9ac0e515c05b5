#pragma once
#include <array>
#include <cstddef>

#include "lib/estimation/spindle_signals.hpp"
#include "lib/estimation/ud_covariance.hpp"
#include "lib/identification/learning_mode.hpp"
#include "lib/identification/outlier_gate.hpp"
#include "lib/identification/period_response.hpp"
#include "lib/identification/retraction.hpp"
#include "lib/math/matrix_exponential.hpp"
#include "lib/plant/contact_law.hpp"

namespace morepro {

/// Order of the spindle's parameters in its filter.
enum class SpindleParameter : std::uint8_t {
  kTorqueConstant,
  kInertia,
  kInductance,
  kResistance,
  kBackEmfConstant,
  kViscousFriction,  ///< where the mode finds it
};
inline constexpr std::size_t kSpindleParameterCount = 5;  ///< on line

/// Extended Kalman filter over [w, i] and the logarithms of five spindle parameters: identification from
/// measured speed and current, without their derivatives. UD-factored, because recordings lose their
/// excitation.
///
/// Safe-guards against false certainty: the second-order error of a change in one period is added to the
/// process noise, and a machine that rests teaches nothing (see RestDetector): then the parameters are
/// frozen. Bounded time; may run in an interrupt. `Mode`: see learning_mode.hpp; in Anchored none of these
/// guards is needed, and the variances given to `predict` are those of the process noise themselves.
template <class Real, class Mode = OnLine>
class SpindleParameterFilter {
 public:
  static constexpr std::size_t kCount = kSpindleParameterCount + (Mode::kFindsFriction ? 1 : 0);
  using Values = std::array<Real, kCount>;

  /// `start_fraction`: standard deviation of the datasheet's values, relative, > 0. `drift_fraction`:
  /// standard deviation per step of their random walk, relative, >= 0.
  SpindleParameterFilter(const MachineParameters& machine, Real period_s, Real start_fraction,
                         Real drift_fraction)
      : law_(machine),
        viscous_friction_(static_cast<Real>(machine.spindle.viscous_friction_nms_rad)),
        period_s_(period_s),
        start_variance_(start_fraction * start_fraction),
        drift_variance_(drift_fraction * drift_fraction),
        datasheet_{static_cast<Real>(machine.spindle.torque_constant_nm_a),
                   static_cast<Real>(machine.spindle.inertia_kgm2),
                   static_cast<Real>(machine.spindle.inductance_h),
                   static_cast<Real>(machine.spindle.resistance_ohm),
                   static_cast<Real>(machine.spindle.back_emf_constant_vs_rad)} {
    if constexpr (Mode::kFindsFriction) datasheet_[kFriction] = viscous_friction_;
    forget();
  }

  /// Back to the datasheet.
  void forget() {
    anchor_at(datasheet_);
    state_variance_ = {Real(1), Real(1)};
    forget_covariance();
  }

  /// The values to linearise at: in Anchored throughout, else only the first estimate. All > 0.
  void anchor_at(const Values& values) {
    value_ = values;
    if constexpr (Mode::kFindsFriction) viscous_friction_ = values[kFriction];
    if constexpr (Mode::kIsAnchored)
      for (std::size_t j = 0; j < kCount; ++j)
        deviation_.value[j] = values[j] > Real(0) ? math::log(datasheet_[j] / values[j]) : Real(0);
  }

  /// Speed and current start from the measurement; what is known of the parameters stays.
  void restart_state(const SpindleMeasurement<Real>& y) {
    w_ = y.speed_rad_s;
    i_ = y.current_a;
    covariance_.restart(0, y.speed_variance);
    covariance_.restart(1, y.current_variance);
    reference_ = {w_, i_};
    gate_.restart();
    if constexpr (Mode::kIsAnchored) deviation_.at_rest = reference_;
    state_variance_ = {y.speed_variance, y.current_variance};
  }

  /// Anchored: nothing moves from now on, or it does. The noise of the first estimates of a state would turn
  /// the line on which resistance and back-EMF constant lie, so slopes are held at rest, and nothing changes.
  void hold(bool is_still) requires Mode::kIsAnchored { deviation_.is_still = is_still; }

  /// Over the period that ended with the present frame, with the chip load that is being cut (not used in the
  /// air).
  void predict(const SpindleInput<Real>& input, Real chip_load_mm, Real speed_variance,
               Real current_variance) {
    const Values values = values_to_step();
    const auto contact = input.contact > Real(0)
                             ? law_.at_thermal_factor(w_, chip_load_mm, input.thermal_factor)
                             : ContactTorque<Real>{};
    const auto [dw, di, a] =
        SpindleRates<Real>(values, viscous_friction_, contact, w_, i_, input.armature_voltage_v);
    const Matrix phi = response(a);
    const Matrix f = (a * phi).plus_identity();
    Real w_change = phi.a00 * dw + phi.a01 * di, i_change = phi.a10 * dw + phi.a11 * di;
    if constexpr (!Mode::kIsAnchored) follow_estimate();
    Regressors r = regressors(dw, di, a, phi);
    if constexpr (Mode::kIsAnchored) {
      hold_at_rest(r);
      r.di *= unevenness(-a.a11 * period_s_);
    }
    const std::array<Values, 2> g = spindle_slopes(values, viscous_friction_, r, phi);
    if constexpr (Mode::kIsAnchored) {
      for (std::size_t j = 0; j < kCount; ++j) {
        w_change += g[0][j] * deviation_.value[j];
        i_change += g[1][j] * deviation_.value[j];
      }
      covariance_.predict({{{f.a00, f.a01}, {f.a10, f.a11}}}, g, {speed_variance, current_variance});
    } else {
      covariance_.predict(
          {{{f.a00, f.a01}, {f.a10, f.a11}}}, g,
          {Real(kProcessShare) * speed_variance + curvature(w_change, known_[0] + known_[1]),
           Real(kProcessShare) * current_variance + curvature(i_change, known_[2] + known_[3] + known_[4])});
    }
    w_ += w_change;
    i_ += i_change;
  }

  /// The random walk of one parameter over `frames` frames. A rank-one update costs as much as a measurement,
  /// so the caller gives one parameter its turn at a time. Nothing is added to a parameter of which little is
  /// known.
  void drift(SpindleParameter parameter, Real frames) {
    const std::size_t j = index_of(parameter);
    known_[j] = covariance_.variance(2 + j);
    if (has_left(learnt_from_[j], value_[j], known_[j], start_variance_)) return forget_covariance();
    const Real q = drift_variance_ * frames;
    if (known_[j] + q < Real(kKnown) * start_variance_) covariance_.add_variance(2 + j, q);
  }

  /// Uses the measurements; returns the normalised innovation squared.
  Real update(const SpindleMeasurement<Real>& y) {
    if constexpr (Mode::kIsAnchored) {
      if (y.has_speed()) reference_[0] += Real(kReferenceGain) * (y.speed_rad_s - reference_[0]);
      if (y.has_current()) reference_[1] += Real(kReferenceGain) * (y.current_a - reference_[1]);
    }
    Values step{};
    Real of_speed{}, of_current{};
    if (y.has_speed()) of_speed = update_one<0>(y.speed_rad_s - w_, y.speed_variance, step);
    if (y.has_current()) of_current = update_one<1>(y.current_a - i_, y.current_variance, step);
    gate_.step(of_speed > of_current ? of_speed : of_current);
    for (std::size_t j = 0; j < kCount; ++j) {
      if constexpr (Mode::kIsAnchored)
        deviation_.value[j] += step[j];
      else
        value_[j] = moved(value_[j], step[j], datasheet_[j]);
    }
    return of_speed + of_current;
  }
  /// On line, after update: the state must start again from the measurement.
  [[nodiscard]] bool has_lost_the_state() const { return gate_.has_lost_the_state(); }

  [[nodiscard]] Real value(SpindleParameter parameter) const {
    const std::size_t j = index_of(parameter);
    if constexpr (Mode::kIsAnchored)
      return moved(value_[j], deviation_.value[j], datasheet_[j]);
    else
      return value_[j];
  }
  /// Relative variance of one parameter, and relative covariance of two.
  [[nodiscard]] Real covariance(SpindleParameter a, SpindleParameter b) const {
    return covariance_.covariance(index_of(a) + 2, index_of(b) + 2);
  }
  [[nodiscard]] Real start_variance() const { return start_variance_; }
  /// Of the last update; empty in OnLine.
  [[nodiscard]] const typename Mode::template Record<Real>& record() const { return record_; }

 private:
  using Matrix = math::BasicMatrix2<Real>;
  using Covariance = UdCovariance<Real, 2 + kCount>;

  static constexpr std::size_t kFriction = kSpindleParameterCount;

  /// Process noise of w and i per step, as a share of one measurement's variance.
  static constexpr double kProcessShare = 0.01;

  /// Standard deviations of the estimate that the reference may be left behind by.
  static constexpr double kLeftBehind = 3.0;

  /// Of what the machine is away from the reference, per frame.
  static constexpr double kReferenceGain = 1.0 / 256.0;

  /// In periods; the series is stable above 0.36.
  static constexpr double kShortestTimeConstant = 0.4;

  /// Parameters whose standard deviation fell below a sixth of the datasheet's may drift.
  static constexpr double kKnown = 1.0 / 36.0;

  static constexpr std::size_t index_of(SpindleParameter parameter) {
    return static_cast<std::size_t>(parameter);
  }

  /// The values stay, and are known no better than a datasheet's.
  void forget_covariance() {
    learnt_from_ = value_;
    known_.fill(start_variance_);
    typename Covariance::Vector start;
    start.fill(start_variance_);
    if constexpr (Mode::kFindsFriction)
      start[2 + kFriction] = Real(Mode::kFrictionFraction * Mode::kFrictionFraction);
    start[0] = state_variance_[0];
    start[1] = state_variance_[1];
    covariance_.restart(start);
  }

  /// On line a value on its way may be where the series of `held_response` does not decay: never there.
  Values values_to_step() const {
    Values values = value_;
    if constexpr (!Mode::kIsAnchored) {
      const Real least = Real(kShortestTimeConstant) * values[3] * period_s_;
      values[2] = values[2] > least ? values[2] : least;
    }
    return values;
  }

  Matrix response(const Matrix& a) const {
    if constexpr (Mode::kIsAnchored) return math::exponential_step(a, period_s_).integral;
    return held_response(a, period_s_);
  }

  using Regressors = SpindleRegressors<Real>;
  /// Of a reference that takes the model's changes and follows the machine a hundred times slower than the
  /// estimate does: noise in the slopes would turn the line on which resistance and back-EMF constant lie,
  /// and pump inertia and inductance, and all would seem to be known. Means over the period, which may be as
  /// long as L/R.
  Regressors regressors(Real dw, Real di, const Matrix& a, const Matrix& phi) {
    const Real w_off = reference_[0] - w_, i_off = reference_[1] - i_;
    const Real w_rate = dw + a.a00 * w_off + a.a01 * i_off, i_rate = di + a.a10 * w_off + a.a11 * i_off;
    const Real w_change = phi.a00 * w_rate + phi.a01 * i_rate, i_change = phi.a10 * w_rate + phi.a11 * i_rate;
    const Real w_mean = reference_[0] + Real(0.5) * w_change, i_mean = reference_[1] + Real(0.5) * i_change;
    reference_[0] += w_change;
    reference_[1] += i_change;
    // Derivatives of these very means: those of the change would not quite fit them, and a misfit looks like
    // information on a line along which nothing changes.
    if constexpr (Mode::kIsAnchored) {
      const Real w_from = w_mean - w_, i_from = i_mean - i_;
      return {w_mean, i_mean, dw + a.a00 * w_from + a.a01 * i_from, di + a.a10 * w_from + a.a11 * i_from};
    }
    const Real per_period = Real(1) / period_s_;
    return {w_mean, i_mean, w_change * per_period, i_change * per_period};
  }

  /// On line the model may be far off yet: a reference that is left behind begins anew at the estimate.
  void follow_estimate() {
    reference_[0] = followed(reference_[0], w_, state_variance_[0]);
    reference_[1] = followed(reference_[1], i_, state_variance_[1]);
  }
  static Real followed(Real reference, Real state, Real variance) {
    const Real distance = state - reference;
    const bool is_left_behind = distance * distance > Real(kLeftBehind * kLeftBehind) * variance;
    return is_left_behind ? state : reference + Real(kReferenceGain) * distance;
  }

  /// What the inductance tells in a period of x time constants L/R, against what the current's rate halfway
  /// of its change says: x / sinh x. Three time constants tell a third of it, and without this the inductance
  /// was five claimed standard errors off.
  static Real unevenness(Real x) requires Mode::kIsAnchored {
    const Real decay = math::exp(-x);
    return Real(2) * x * decay / (Real(1) - decay * decay);
  }

  /// Anchored: at rest speed and current are those that the rest began with, and nothing changes.
  void hold_at_rest(Regressors& r) requires Mode::kIsAnchored {
    if (deviation_.is_still)
      r = {deviation_.at_rest[0], deviation_.at_rest[1], Real(0), Real(0)};
    else
      deviation_.at_rest = {r.w, r.i};
  }

  /// Second-order term of the change in one period, which the linearised covariance does not see: a product
  /// or quotient of parameters with relative variance s is wrong by about s; the factor of 16 makes starts
  /// wrong by a factor of two safe. Without it the first transient makes the filter certain of wrong values.
  static Real curvature(Real change, Real relative_variance) {
    const Real error = Real(16) * change * relative_variance;
    return error * error;
  }

  template <std::size_t kElement>
  Real update_one(Real innovation, Real variance, Values& step) {
    const auto update = covariance_.template update<kElement>(variance);
    record_.take(kElement, innovation, update.innovation_variance);
    // P+ of the measured element is its gain times the measurement's variance.
    state_variance_[kElement] = update.gain[kElement] * variance;
    const Real nis = innovation * innovation / update.innovation_variance;
    if (!Mode::kIsAnchored && nis > Real(OutlierGate<Real>::kLargest)) return nis;
    w_ += update.gain[0] * innovation;
    i_ += update.gain[1] * innovation;
    for (std::size_t j = 0; j < kCount; ++j) step[j] += update.gain[2 + j] * innovation;
    return nis;
  }

  ContactLaw<Real> law_;
  Real viscous_friction_;
  Real period_s_;
  Real start_variance_;
  Real drift_variance_;
  Values datasheet_;
  Values value_{};
  Values learnt_from_{};  ///< values at which the covariance began
  Real w_{}, i_{};
  std::array<Real, 2> state_variance_{};  ///< of w and i after the last frame
  OutlierGate<Real> gate_;
  std::array<Real, 2> reference_{};  ///< speed and current, nearly without noise
  Values known_{};                   ///< relative variance of each parameter, refreshed by its drift
  Covariance covariance_{{}};
  [[no_unique_address]] typename Mode::template Record<Real> record_{};
  [[no_unique_address]] typename Mode::template Deviation<Values> deviation_{};
};

}  // namespace morepro
