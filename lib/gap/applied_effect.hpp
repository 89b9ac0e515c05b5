#pragma once
#include <array>
#include <cstddef>

#include "lib/gap/effect_term.hpp"

namespace morepro::gap {

inline constexpr std::size_t kMostParts = 4;

/// An effect with its size: what is added to a model.
struct AppliedEffect {
  EffectForm form;
  std::array<double, kMostParts> coefficient{};  ///< one per part of the form
  double onset_s = 0.0;                          ///< sets in at this time of a recording
};

/// Does it add anything? A size of zero, of a coefficient or a shape, is no effect.
inline bool has_size(const AppliedEffect& effect) {
  if (needs_shape(effect.form.effect) && !(effect.form.shape > 0.0F)) return false;
  bool is_any = false;
  for (std::size_t i = 0; i < effect.form.parts; ++i) is_any |= effect.coefficient[i] != 0.0;
  return is_any;
}

/// When an effect sets in. Memories run from the start, so that they are right at the onset; what grows with
/// the cutting time grows from the onset on.
template <class Real>
struct Onset {
  Real time_s = 0;
  Real cutting_before_s = 0;

  bool has_come(const EffectSignals<Real>& signals) {
    const bool is_on = signals.time_s >= time_s;
    if (!is_on) cutting_before_s = signals.cutting_time_s;
    return is_on;
  }
  /// For a run that begins after it: `cutting_time_s_at` tells of any time how long the cut was before.
  template <class CuttingTime>
  void look_back(CuttingTime cutting_time_s_at) {
    if (time_s > Real(0)) cutting_before_s = cutting_time_s_at(time_s);
  }
  [[nodiscard]] EffectSignals<Real> since(const EffectSignals<Real>& signals) const {
    EffectSignals<Real> since = signals;
    since.cutting_time_s -= cutting_before_s;
    return since;
  }
};

/// The parts of one applied effect, stepped together.
template <class Real, std::size_t kDelaySteps>
class AppliedTerm {
 public:
  AppliedTerm() = default;
  AppliedTerm(const AppliedEffect& effect, const EffectScales<Real>& scales, double step_s)
      : scales_(scales), onset_{static_cast<Real>(effect.onset_s)}, parts_(effect.form.parts) {
    for (std::size_t i = 0; i < parts_; ++i) {
      term_[i] = EffectTerm<Real, kDelaySteps>(effect.form, static_cast<int>(i), step_s);
      coefficient_[i] = static_cast<Real>(effect.coefficient[i]);
    }
  }

  /// When it sets in.
  Onset<Real>& onset() { return onset_; }

  /// Adds what the effect contributes during one step.
  void step(const EffectSignals<Real>& signals, Contribution<Real>& sum) {
    const Real share = onset_.has_come(signals) ? Real(1) : Real(0);
    const EffectSignals<Real> since = onset_.since(signals);
    for (std::size_t i = 0; i < parts_; ++i) {
      const Contribution<Real> one = term_[i].step(since, scales_);
      const Real gain = share * coefficient_[i];
      sum.torque_nm += gain * one.torque_nm;
      sum.force_n += gain * one.force_n;
      sum.voltage_v += gain * one.voltage_v;
      sum.speed_rad_s += gain * one.speed_rad_s;
      sum.current_a += gain * one.current_a;
      sum.feed_speed_m_s += gain * one.feed_speed_m_s;
    }
  }

 private:
  EffectScales<Real> scales_;
  std::array<EffectTerm<Real, kDelaySteps>, kMostParts> term_{};
  std::array<Real, kMostParts> coefficient_{};
  Onset<Real> onset_;
  std::size_t parts_ = 0;
};

}  // namespace morepro::gap
