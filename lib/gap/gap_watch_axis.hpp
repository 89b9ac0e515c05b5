#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "lib/gap/effect_signals.hpp"
#include "lib/gap/gap_frame.hpp"
#include "lib/gap/gap_watch_evaluation.hpp"
#include "lib/math/elementary.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::gap {

/// Can the machine have this effect beside its nominal parameters, as far as its description tells?
constexpr bool is_candidate(Effect effect, const MachineParameters& machine) {
  if (effect == Effect::kFeedScrewPeriodic) return machine.feed.screw_pitch_m > 0.0;
  // Else it is a parameter; one that sets in late comes with the host's forms.
  if (effect == Effect::kFeedViscousFriction) return !(machine.feed.viscous_friction_ns_m > 0.0);
  return true;
}

/// One axis of the watch: its observer, the row on its way into the statistics, and what these say.
template <class Real, class Observer, std::size_t kParameters, std::size_t kForms>
class GapWatchAxis {
 public:
  static constexpr std::size_t kColumns = Observer::kColumns;
  using Evaluation = GapWatchEvaluation<Real, kParameters, kForms + MachineForms::kMost, kColumns>;
  using Statistics = typename Evaluation::Statistics;

  /// Rows at which the statistics fade. A further row then changes the triangle by 8e-6 of its size: a
  /// hundred times a float's last bit.
  static constexpr std::size_t kMostRows = 65536;

  /// `value`: of each parameter in the unit of its column, without its sign; 0: not one of this machine.
  [[gnu::cold]] GapWatchAxis(const MachineParameters& machine, const ReferencePoint& point, double step_s,
                             const GapNoise<Real>& noise, const std::array<BoardForm, kForms>& forms,
                             const std::array<Real, kParameters>& value, const GapLimits& limits)
      : observer_(machine, point, step_s, noise), evaluation_(value, limits) {
    for (const BoardForm& form : forms)
      if (is_candidate(form.effect, machine) && !limits.forms.has(form.effect)) add(form.at(step_s), false);
    for (std::size_t i = 0; i < limits.forms.count; ++i) add(limits.forms.form[i], true);
  }

  Observer& observer() { return observer_; }
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }
  [[nodiscard]] const Evaluation& evaluation() const { return evaluation_; }

  /// Takes everything that another watch of the same machine has collected.
  void merge(const GapWatchAxis& other) {
    statistics_.merge(other.statistics_);
    is_judged_ = is_judging_ = false;
  }

  /// Takes a row, or the other one where that sensor was not read. It has to be turned in before the next
  /// one.
  void take(const typename Observer::Row& row, const typename Observer::Row& other) {
    take(row.is_measured ? row : other);
  }

  [[nodiscard]] bool is_turning() const { return !insertion_.is_done(); }
  /// Turns one column of the row that was taken into the statistics.
  void turn() {
    if (statistics_.advance(insertion_) && statistics_.rows() >= kMostRows) statistics_.fade();
  }

  /// Have the statistics changed since the last finding?
  [[nodiscard]] bool is_unjudged() const { return !is_judged_; }
  /// One step towards a finding; true where that completes it. No row may be turned before.
  bool judge() {
    if (!is_judging_) {
      evaluation_.begin();
      is_judging_ = true;
      return false;
    }
    if (!evaluation_.advance(statistics_)) return false;
    is_judging_ = false;
    is_judged_ = true;
    return true;
  }

 private:
  /// A form that finds no room is not looked for.
  void add(const EffectForm& form, bool is_told) {
    if (form.parts > 0 && observer_.terms().add(form)) evaluation_.add(form, is_told);
  }

  // A row beyond this many standard deviations counts as one of them (Huber).
  static constexpr Real kHuber = 5;
  static constexpr Real kImpossible = Real(1.0e6);
  // Squares of columns stay in a float; NaN is not below it either.
  static constexpr Real kLargest = Real(1.0e15);

  void take(const typename Observer::Row& row) {
    if (!row.is_measured) return;
    const Real weight = Real(1) / math::sqrt(row.variance);
    const Real size = math::abs(row.innovation * weight);
    if (!(size < kImpossible)) return;
    const Real bounded = size > kHuber ? weight * math::sqrt(kHuber / size) : weight;
    bool is_sound = true;
    for (std::size_t j = 0; j < kColumns; ++j) {
      insertion_.row[j] = bounded * row.column[j];
      is_sound &= math::abs(insertion_.row[j]) < kLargest;
    }
    if (!is_sound) return;
    insertion_.row[Statistics::kY] = bounded * row.innovation;
    insertion_.next = 0;
    insertion_.used = observer_.columns();
    is_judged_ = is_judging_ = false;
  }

  Observer observer_;
  Evaluation evaluation_;
  Statistics statistics_{};
  typename Statistics::Insertion insertion_{};
  bool is_judged_ = true;
  bool is_judging_ = false;
};

}  // namespace morepro::gap
