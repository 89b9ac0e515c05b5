#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "lib/estimation/spindle_signals.hpp"
#include "lib/estimation/spindle_step.hpp"
#include "lib/estimation/ud_covariance.hpp"
#include "lib/plant/contact_law.hpp"

namespace morepro {

/// What is known of the chip load before it is measured, and the interval that it is kept in; all in mm.
template <class Real>
struct ChipLoadPrior {
  Real mean_mm;
  Real standard_deviation_mm;  ///< > 0
  Real lowest_mm;
  Real highest_mm;
  Real drift_mm;  ///< standard deviation of its random walk per step in contact, >= 0
};

/// What one step of the chip-load filter says about its measurements, before they were used.
template <class Real>
struct SpindleInnovation {
  Real speed_rad_s{};
  Real current_a{};
  Real speed_variance{};
  Real current_variance{};
};

/// One extended Kalman filter over [w, i, chip load]: the chip load as a continuous quantity with its
/// variance. Without contact the chip load is not observable and keeps its last value and variance. Bounded
/// time; may run in an interrupt.
template <class Real>
class ChipLoadFilter {
 public:
  ChipLoadFilter(const MachineParameters& machine, const SpindleStep<Real>& step,
                 const ChipLoadPrior<Real>& prior, Real speed_process_variance, Real current_process_variance)
      : law_(machine), step_(step), prior_(prior), q_{speed_process_variance, current_process_variance} {
    start(Real(0), Real(0), Real(1), Real(1));
  }

  /// Forgets everything.
  void start(Real speed_rad_s, Real current_a, Real speed_variance, Real current_variance) {
    restart_state(speed_rad_s, current_a, speed_variance, current_variance);
    start_cut();
  }

  /// Speed and current start again; what is known of the chip load stays.
  void restart_state(Real speed_rad_s, Real current_a, Real speed_variance, Real current_variance) {
    w_ = speed_rad_s;
    i_ = current_a;
    covariance_.restart(kSpeed, speed_variance);
    covariance_.restart(kCurrent, current_variance);
  }

  /// A new cut: the chip load is unknown again, speed and current stay.
  void start_cut() {
    chip_load_ = prior_.mean_mm;
    covariance_.restart(kChipLoad, prior_variance());
  }

  /// Over the period that ended with the present frame.
  void predict(const SpindleInput<Real>& input) {
    const Real w = w_, i = i_, v = input.armature_voltage_v;
    const auto contact = torque(input);
    flags_ = contact.flags;
    per_chip_load_ = contact.per_chip_load;
    const Real half_slope = Real(0.5) * step_.w_per_nm * contact.per_speed;
    const Real change =
        step_.ww * w + step_.wi * i + step_.w_per_v * v + step_.w_per_nm * contact.torque_nm - w;
    w_ = w + (change + half_slope * change);
    i_ = step_.iw * w + step_.ii * i + step_.i_per_v * v + step_.i_per_nm * contact.torque_nm;
    const Real ww = step_.ww + step_.w_per_nm * contact.per_speed;
    const Real iw = step_.iw + step_.i_per_nm * contact.per_speed;
    covariance_.predict(
        {{{ww, step_.wi}, {iw, step_.ii}}},
        {{{step_.w_per_nm * contact.per_chip_load}, {step_.i_per_nm * contact.per_chip_load}}}, q_);
    if (input.contact > Real(0)) drift();
  }

  /// Innovations of both channels and their variances, without using the measurements. 0 and kUnmeasured
  /// where a channel is missing.
  [[nodiscard]] SpindleInnovation<Real> innovation(const SpindleMeasurement<Real>& y) const {
    SpindleInnovation<Real> result{Real(0), Real(0), Real(kUnmeasured), Real(kUnmeasured)};
    if (y.has_speed()) {
      result.speed_rad_s = y.speed_rad_s - w_;
      result.speed_variance = covariance_.variance(kSpeed) + y.speed_variance;
    }
    if (y.has_current()) {
      result.current_a = y.current_a - i_;
      result.current_variance = covariance_.variance(kCurrent) + y.current_variance;
    }
    return result;
  }

  /// Uses the measurements; returns the normalised innovation squared, chi-square with as many degrees of
  /// freedom as channels are measured.
  Real update(const SpindleMeasurement<Real>& y) {
    Real nis{};
    if (y.has_speed()) nis += update_one<kSpeed>(y.speed_rad_s - w_, y.speed_variance);
    if (y.has_current()) nis += update_one<kCurrent>(y.current_a - i_, y.current_variance);
    chip_load_ = std::clamp(chip_load_, prior_.lowest_mm, prior_.highest_mm);
    return nis;
  }

  [[nodiscard]] Real speed_rad_s() const { return w_; }
  [[nodiscard]] Real current_a() const { return i_; }
  [[nodiscard]] Real chip_load_mm() const { return chip_load_; }
  [[nodiscard]] Real chip_load_variance_mm2() const { return covariance_.variance(kChipLoad); }
  /// Change of the contact torque with the chip load at the last prediction in contact, N m/mm; 0 in the air.
  [[nodiscard]] Real torque_per_chip_load() const { return per_chip_load_; }
  /// The estimate lies between what a chip load can be, not on a bound.
  [[nodiscard]] bool is_inside_prior() const {
    return chip_load_ > prior_.lowest_mm && chip_load_ < prior_.highest_mm;
  }
  /// ContactFlag bits of the last prediction in contact.
  [[nodiscard]] std::uint8_t flags() const { return flags_; }

 private:
  using Covariance = UdCovariance<Real, 3>;
  static constexpr std::size_t kSpeed = 0, kCurrent = 1, kChipLoad = 2;

  Real prior_variance() const { return prior_.standard_deviation_mm * prior_.standard_deviation_mm; }

  ContactTorque<Real> torque(const SpindleInput<Real>& input) const {
    return input.contact > Real(0) ? law_.at_thermal_factor(w_, chip_load_, input.thermal_factor)
                                   : ContactTorque<Real>{};
  }

  /// The random walk ends where nothing is known any more.
  void drift() {
    if (covariance_.variance(kChipLoad) < prior_variance())
      covariance_.add_variance(kChipLoad, prior_.drift_mm * prior_.drift_mm);
  }

  template <std::size_t kElement>
  Real update_one(Real innovation, Real variance) {
    const auto update = covariance_.template update<kElement>(variance);
    w_ += update.gain[kSpeed] * innovation;
    i_ += update.gain[kCurrent] * innovation;
    chip_load_ += update.gain[kChipLoad] * innovation;
    return innovation * innovation / update.innovation_variance;
  }

  ContactLaw<Real> law_;
  SpindleStep<Real> step_;
  ChipLoadPrior<Real> prior_;
  std::array<Real, 2> q_;
  Real w_{}, i_{}, chip_load_{};
  Real per_chip_load_{};
  std::uint8_t flags_ = 0;
  Covariance covariance_{{Real(1), Real(1), Real(1)}};
};

}  // namespace morepro
