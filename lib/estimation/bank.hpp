#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "lib/estimation/lane_gate.hpp"
#include "lib/estimation/local_torque.hpp"
#include "lib/estimation/spindle_signals.hpp"
#include "lib/estimation/spindle_step.hpp"
#include "lib/math/elementary.hpp"
#include "lib/plant/contact_law.hpp"

namespace morepro {

/// kN extended Kalman filters over the spindle's state [w, i], one per chip-load hypothesis, as structure of
/// arrays. The feed speed of the three-state model is decoupled from the spindle and common to all
/// hypotheses, so it has one filter of its own (feed_filter.hpp).
///
/// Mean: exact discretisation of the linear part, contact torque at the middle of the step. Update: the two
/// measurements one after the other, in the form P+ = K R, which cannot turn negative. No branch depends on a
/// lane, so the compiler may use any vector width: the bits are the same. step() takes a bounded time and may
/// run in an interrupt.
template <class Real, std::size_t kN>
class Bank {
  static_assert(kN >= 1 && kN <= 64);

 public:
  using Lanes = std::array<Real, kN>;

  /// Variances per step of the process noise.
  struct ProcessNoise {
    Real speed_variance;
    Real current_variance;
  };

  Bank(const MachineParameters& machine, const SpindleStep<Real>& step, const Lanes& chip_load_mm,
       ProcessNoise noise)
      : law_(machine),
        local_(machine, chip_load_mm),
        step_(step),
        chip_load_mm_(chip_load_mm),
        noise_(noise) {}

  /// Every filter starts from the same state with the same variances.
  void start(Real speed_rad_s, Real current_a, Real speed_variance, Real current_variance) {
    centre_ = speed_rad_s;
    is_local_ = false;
    gate_ = {};
    for (std::size_t j = 0; j < kN; ++j) start_lane(j, Real(0), current_a, speed_variance, current_variance);
  }

  /// One prediction over the period before the present frame and one update with the frame's measurements.
  void step(const SpindleInput<Real>& input, const SpindleMeasurement<Real>& y) {
    repair_and_recentre(y);
    const bool exact = !choose_local(input.contact);
    if (exact) {
      evaluate_law(input.thermal_factor);
      filter(ExactTorque{torque_, slope_}, input, y, input.contact);
    } else {
      const Real load = input.contact * input.thermal_factor;
      filter(CubicTorque{local_.c0(), local_.c1(), local_.c2(), local_.c3()}, input, y, load);
    }
  }

  /// Log-likelihood of the frame under each hypothesis, up to a constant that is common to the bank.
  [[nodiscard]] const Lanes& log_likelihood() const { return log_likelihood_; }
  /// Normalised innovation squared of the frame under each hypothesis; chi-square with one degree of freedom
  /// per measured channel where the hypothesis is true.
  [[nodiscard]] const Lanes& nis() const { return nis_; }
  [[nodiscard]] Real speed_rad_s(std::size_t j) const { return centre_ + d_[j]; }
  [[nodiscard]] Real current_a(std::size_t j) const { return i_[j]; }
  [[nodiscard]] Real speed_variance(std::size_t j) const { return pww_[j]; }
  [[nodiscard]] Real covariance(std::size_t j) const { return pwi_[j]; }
  [[nodiscard]] Real current_variance(std::size_t j) const { return pii_[j]; }
  [[nodiscard]] Real chip_load_mm(std::size_t j) const { return chip_load_mm_[j]; }
  /// Filters that had to start again because their memory held no number.
  [[nodiscard]] std::uint32_t repaired() const { return repaired_; }

 private:
  struct CubicTorque {
    const Lanes &c0, &c1, &c2, &c3;
    void operator()(std::size_t j, Real d, Real& torque, Real& slope) const {
      const Real u = c3[j] * d;
      const Real v = c2[j] + u;
      torque = c0[j] + d * (c1[j] + d * v);
      slope = c1[j] + d * (v + v + u);
    }
  };

  struct ExactTorque {
    const Lanes &torque_nm, &slope_nms;
    void operator()(std::size_t j, Real, Real& torque, Real& slope) const {
      torque = torque_nm[j];
      slope = slope_nms[j];
    }
  };

  void start_lane(std::size_t j, Real d, Real current_a, Real speed_variance, Real current_variance) {
    d_[j] = d;
    i_[j] = current_a;
    pww_[j] = speed_variance;
    pwi_[j] = Real(0);
    pii_[j] = current_variance;
  }

  /// Brings the centre back to the lanes when one of them left the domain, or holds no number, after the last
  /// step.
  void repair_and_recentre(const SpindleMeasurement<Real>& y) {
    if (!gate_.is_any_beyond()) return;
    repair(y);
    const Real shift = d_[kN / 2];
    centre_ += shift;
    const Real domain = LocalTorque<Real, kN>::domain(centre_);
    gate_ = {};
    for (std::size_t j = 0; j < kN; ++j) {
      d_[j] -= shift;
      gate_.see(domain, d_[j]);
    }
    is_local_ = false;
  }

  void repair(const SpindleMeasurement<Real>& y) {
    const Real largest = std::numeric_limits<Real>::max();
    const bool centre_is_number = math::abs(centre_) <= largest;
    if (!centre_is_number) centre_ = y.speed_rad_s;
    for (std::size_t j = 0; j < kN; ++j) {
      const Real sum = math::abs(d_[j]) + math::abs(i_[j]) + pww_[j] + math::abs(pwi_[j]) + pii_[j];
      if (sum <= largest && centre_is_number) continue;
      start_lane(j, y.speed_rad_s - centre_, y.current_a, y.speed_variance, y.current_variance);
      ++repaired_;
    }
  }

  /// True where the cubics hold for every lane, or are not needed.
  bool choose_local(Real contact) {
    if (!(contact > Real(0))) return true;
    if (gate_.is_any_beyond()) return false;
    if (!is_local_) is_local_ = local_.build(centre_);
    return is_local_;
  }

  void evaluate_law(Real factor) {
    for (std::size_t j = 0; j < kN; ++j) {
      const auto contact = law_.at_thermal_factor(centre_ + d_[j], chip_load_mm_[j], factor);
      torque_[j] = contact.torque_nm;
      slope_[j] = contact.per_speed;
    }
  }

  template <class Torque>
  void filter(Torque contact, const SpindleInput<Real>& input, const SpindleMeasurement<Real>& y, Real load) {
    // F = [[f, wi], [g, ii]]; the model's distance from the centre replaces the speed, so its offset is known
    // here.
    const Real ww = step_.ww, wi = step_.wi, iw = step_.iw, ii = step_.ii;
    const Real ww_less_1 = ww - Real(1), two_ii = ii + ii, ii_ii = ii * ii;
    const Real w_offset = ww_less_1 * centre_ + step_.w_per_v * input.armature_voltage_v;
    const Real i_offset = iw * centre_ + step_.i_per_v * input.armature_voltage_v;
    const Real w_load = step_.w_per_nm * load, i_load = step_.i_per_nm * load;
    const Real qw = noise_.speed_variance, qi = noise_.current_variance;
    const Real rw = y.speed_variance, ri = y.current_variance;
    const Real yw = y.has_speed() ? y.speed_rad_s - centre_ : Real(0);
    const Real yi = y.has_current() ? y.current_a : Real(0);
    const Real domain = LocalTorque<Real, kN>::domain(centre_);
    const Real half_inverse_reference = Real(0.5) / reference_;
    LaneGate<Real> gate;
    WindowGate<Real> series_gate{Real(1.5 - 0.5 * kSeriesDomain), Real(1.5 + 0.5 * kSeriesDomain)};
    for (std::size_t j = 0; j < kN; ++j) {
      const Real d = d_[j], i = i_[j], pww = pww_[j], pwi = pwi_[j], pii = pii_[j];
      Real torque, slope;
      contact(j, d, torque, slope);
      const Real dw_slope = w_load * slope;
      const Real f = ww + dw_slope;
      const Real g = iw + i_load * slope;
      const Real change = w_offset + (ww_less_1 * d + wi * i + w_load * torque);
      const Real dp = d + (change + Real(0.5) * dw_slope * change);
      const Real ip = i_offset + (iw * d + ii * i + i_load * torque);
      const Real t0 = f * pww + wi * pwi, t1 = f * pwi + wi * pii;
      const Real mww = t0 * f + t1 * wi + qw, mwi = t0 * g + t1 * ii;
      const Real mii = g * (g * pww + two_ii * pwi) + ii_ii * pii + qi;

      const Real s1 = mww + rw, inverse1 = Real(1) / s1;
      const Real k0 = mww * inverse1, k1 = mwi * inverse1, e1 = yw - dp;
      const Real d1 = dp + k0 * e1, i1 = ip + k1 * e1, nww = k0 * rw, nwi = k1 * rw, nii = mii - k1 * mwi;

      const Real s2 = nii + ri, inverse2 = Real(1) / s2;
      const Real l0 = nwi * inverse2, l1 = nii * inverse2, e2 = yi - i1;
      const Real d2 = d1 + l0 * e2;
      d_[j] = d2;
      i_[j] = i1 + l1 * e2;
      pww_[j] = nww - l0 * nwi;
      pwi_[j] = l0 * ri;
      pii_[j] = l1 * ri;
      gate.see(domain, d2);

      const Real nis = e1 * e1 * inverse1 + e2 * e2 * inverse2;
      const Real determinant = s1 * s2, half_ratio = determinant * half_inverse_reference;
      nis_[j] = nis;
      determinant_[j] = determinant;
      // ln(1 + x) = x - x^2/2 is a product but for a constant, which is common to the bank.
      const Real from_2 = Real(2) - half_ratio;
      log_likelihood_[j] = -(Real(0.5) * nis) - half_ratio * from_2;
      series_gate.see(from_2);
    }
    gate_ = gate;
    if (series_gate.is_any_beyond()) take_logarithms(half_inverse_reference);
    reference_ = determinant_[0];
  }

  /// The likelihoods by the logarithm itself, where the series in the ratio of determinants does not reach:
  /// after a start and where a channel comes or goes.
  void take_logarithms(Real half_inverse_reference) {
    for (std::size_t j = 0; j < kN; ++j)
      log_likelihood_[j] = Real(-0.5) * (nis_[j] + math::log(determinant_[j] * half_inverse_reference));
  }

  /// The ratio of determinants is 1 + x with |x| <= 1/32: error of the series below x^3/6 = 5e-6.
  static constexpr double kSeriesDomain = 1.0 / 32.0;

  ContactLaw<Real> law_;
  LocalTorque<Real, kN> local_;
  SpindleStep<Real> step_;
  Lanes chip_load_mm_;
  ProcessNoise noise_;
  Real centre_{};
  bool is_local_ = false;
  LaneGate<Real> gate_;       ///< lanes that left the domain, or hold no number, after the last step
  Real reference_ = Real(1);  ///< determinant of the innovation covariance of the last frame, first lane
  std::uint32_t repaired_ = 0;
  Lanes d_{}, i_{}, pww_{}, pwi_{}, pii_{};
  Lanes nis_{}, determinant_{}, log_likelihood_{};
  Lanes torque_{}, slope_{};
};

}  // namespace morepro
