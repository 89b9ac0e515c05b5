#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#include "lib/gap/applied_effect.hpp"
#include "lib/gap/dry_friction.hpp"
#include "lib/gap/effect_term.hpp"

namespace morepro::gap {

/// Effects that are part of the model already, and the terms that might be missing from it.
template <class Real, std::size_t kMostTerms, std::size_t kMostApplied, std::size_t kDelaySteps>
class ColumnSet {
  static constexpr bool kHasOnsets = kMostApplied > 0;
  static constexpr bool kFollowsFrictions = kHasOnsets && kMostTerms > 0;
  static constexpr bool kTriesMany = kMayShare<Real> && kMostTerms > 64;
  static constexpr std::size_t kMany = 12;

 public:
  ColumnSet(const EffectScales<Real>& scales, double step_s) : scales_(scales), step_s_(step_s) {}

  /// All parts of a form; false where there is no room. A board looks for what is there from the start.
  bool add(const EffectForm& form) {
    if (terms_ + form.parts > kMostTerms) return false;
    for (int part = 0; part < form.parts; ++part) {
      if constexpr (kTriesMany) together_.count(form.effect);
      term_[terms_++] = EffectTerm<Real, kDelaySteps>(form, part, step_s_);
    }
    return true;
  }
  /// The same for one that sets in at `onset_s`.
  bool add(const EffectForm& form, double onset_s) requires kHasOnsets {
    const std::size_t first = terms_;
    if (!add(form)) return false;
    for (std::size_t j = first; j < terms_; ++j) onset_[j].time_s = static_cast<Real>(onset_s);
    if constexpr (kTriesMany) together_.has_late = together_.has_late || onset_s > 0.0;
    return true;
  }
  /// The terms before it that are of a dry friction which is the same follow that.
  bool apply(const AppliedEffect& effect) {
    if (applied_ + frictions_ == kMostApplied) return false;
    if (is_dry_friction(effect.form)) {
      friction_[frictions_++] = {effect.form, static_cast<Real>(effect.coefficient[0]),
                                 static_cast<Real>(effect.form.parts > 1 ? effect.coefficient[1] : 0.0),
                                 static_cast<Real>(effect.onset_s)};
      if constexpr (kFollowsFrictions) follow(frictions_ - 1);
      return true;
    }
    applied_is_sensor_[applied_] = is_in_sensor(effect.form.effect);
    applied_term_[applied_++] = AppliedTerm<Real, kDelaySteps>(effect, scales_, step_s_);
    return true;
  }
  /// Before a run that begins within a recording (`Onset::look_back`).
  template <class CuttingTime>
  void look_back(CuttingTime cutting_time_s_at) requires kHasOnsets {
    for (std::size_t i = 0; i < applied_; ++i) applied_term_[i].onset().look_back(cutting_time_s_at);
    for (std::size_t j = 0; j < terms_; ++j) onset_[j].look_back(cutting_time_s_at);
  }
  [[nodiscard]] std::size_t size() const { return terms_; }
  /// Is there nothing that depends on signals? A board always has terms.
  [[nodiscard]] bool is_empty() const { return kMostApplied > 0 && terms_ + applied_ == 0; }
  [[nodiscard]] const EffectScales<Real>& scales() const { return scales_; }

  /// Sum of the effects in the model but for dry friction: those of the sensors, or the others.
  Contribution<Real> applied(const EffectSignals<Real>& signals, bool in_sensor) {
    Contribution<Real> sum;
    for (std::size_t i = 0; i < applied_; ++i)
      if (applied_is_sensor_[i] == in_sensor) applied_term_[i].step(signals, sum);
    return sum;
  }

  /// A state after the dry friction of the model.
  FrictionStep<Real> rub(const Braking<Real>& on, Real value) const {
    return rubbed(on, value, [](std::size_t, const RubbedState<Real>&) {});
  }
  /// The same, and what the columns of that friction become by it.
  FrictionStep<Real> rub_own(const Braking<Real>& on, Real value) {
    if constexpr (!kFollowsFrictions) {
      return rub(on, value);
    } else {
      return rubbed(on, value, [&](std::size_t friction, const RubbedState<Real>& one) {
        own_.rub(friction, index_of(on.state), one);
      });
    }
  }
  /// Takes the dry friction of the model as it acts during an interval; `on.yield`: by how much a load of one
  /// changes the rate of the state. Does any act?
  bool begin_friction(const Braking<Real>& on) {
    acting_ = 0;
    for (std::size_t i = 0; i < frictions_; ++i) {
      if (!acts(i, on)) continue;
      acting_friction_[acting_] = friction_[i].acting(on, scales_);
      acting_friction_[acting_++].index = i;
    }
    return acting_ > 0;
  }
  /// All of it at one value of its state.
  FrictionAt<Real> friction_at(Real value) {
    FrictionAt<Real> all;
    for (std::size_t i = 0; i < acting_; ++i) {
      const FrictionAt<Real> one = acting_friction_[i].at(value);
      all.rate += one.rate;
      all.slope += one.slope;
      if constexpr (kFollowsFrictions) own_.push(acting_friction_[i].index, one.by_part);
    }
    return all;
  }
  /// The least width in which one of them changes its side, where any acts.
  [[nodiscard]] Real friction_width() const {
    Real most_per_width = 0;
    for (std::size_t i = 0; i < acting_; ++i)
      most_per_width = std::max(most_per_width, acting_friction_[i].per_width);
    return Real(1) / most_per_width;
  }
  /// Columns that are of the model's own dry friction.
  auto& own_frictions() requires kFollowsFrictions { return own_; }

  /// The second part of a step's friction on a state that may turn in between: from `free`, where the rest of
  /// the step led to, from `start` and the `first` part.
  FrictionStep<Real> rub_on(const Braking<Real>& on, Real start, FrictionStep<Real>& first, Real free,
                            const Rubbing<Real>& rubbing) {
    const FrictionStep<Real> last = rub_own(on, free);
    if constexpr (kMostApplied == 0)
      return last;
    else
      return around_a_turn(start, first, free, last, rubbing);
  }

  /// visit(index, contribution) for every term of that sort.
  template <class Visit>
  void for_each(const EffectSignals<Real>& signals, bool in_sensor, Visit visit) {
    if constexpr (kTriesMany) {
      if (!in_sensor && together_.cogging >= kMany) {
        together_.multiples.follow(signals.angle_rad);
        EffectSignals<Real> told = signals;
        told.multiples = &together_.multiples;
        return visit_each(told, in_sensor, visit);
      }
      const bool are_unnamed = together_.unnamed == terms_ && !together_.has_late;
      if (!in_sensor && are_unnamed && terms_ >= kMany) return visit_unnamed(signals, visit);
    }
    visit_each(signals, in_sensor, visit);
  }

 private:
  template <class Rubbed>
  FrictionStep<Real> rubbed(const Braking<Real>& on, Real value, Rubbed note) const {
    FrictionStep<Real> all{value, Real(1)};
    for (std::size_t i = 0; i < frictions_; ++i) {
      if (!acts(i, on)) continue;
      const RubbedState<Real> one = friction_[i].step(all.value, on, scales_);
      note(i, one);
      all = {one.value, all.slope * one.slope};
    }
    return all;
  }

  [[nodiscard]] bool acts(std::size_t friction, const Braking<Real>& on) const {
    return friction_[friction].state() == on.state && on.time_s >= friction_[friction].onset_s;
  }

  template <class Visit>
  void visit_each(const EffectSignals<Real>& signals, bool in_sensor, Visit visit) {
    for (std::size_t j = 0; j < terms_; ++j) {
      if constexpr (kFollowsFrictions)
        if (is_own_[j]) continue;
      if (is_in_sensor(term_[j].form().effect) == in_sensor) visit(j, step(j, signals));
    }
  }

  /// The terms that are parts of a friction of the model. Not of the current's, which turns within a step
  /// (`around_a_turn`).
  void follow(std::size_t friction) requires kFollowsFrictions {
    const DryFriction<Real>& own = friction_[friction];
    if (own.state() == BrakedState::kCurrent) return;
    for (std::size_t j = 0; j < terms_; ++j) {
      const EffectForm& form = term_[j].form();
      const auto part = static_cast<std::size_t>(term_[j].part());
      const bool is_same = form.effect == own.form.effect && form.kind == own.form.kind &&
                           form.shape == own.form.shape && part < own.form.parts &&
                           onset_[j].time_s == own.onset_s;
      if (is_same && !is_own_[j]) is_own_[j] = own_.add(friction, part, j);
    }
  }

  /// Where all of them are functions without a name, and there from the start.
  template <class Visit>
  void visit_unnamed(const EffectSignals<Real>& signals, Visit visit) {
    laws::UnnamedValues<Real> all;
    const bool is_feed = term_[0].form().effect == Effect::kUnnamedForce;
    is_feed ? all.follow_feed(signals, scales_) : all.follow_spindle(signals, scales_);
    for (std::size_t j = 0; j < terms_; ++j) visit(j, term_[j].unnamed(all.value[term_[j].form().kind]));
  }

  Contribution<Real> step(std::size_t j, const EffectSignals<Real>& signals) {
    if constexpr (kHasOnsets)
      if (onset_[j].time_s > Real(0)) return late_step(j, signals);
    return term_[j].step(signals, scales_);
  }

  // Apart: what it copies would cost every term that is there from the start as much as its law.
  [[gnu::noinline]] Contribution<Real> late_step(std::size_t j,
                                                 const EffectSignals<Real>& signals) requires kHasOnsets {
    const bool is_on = onset_[j].has_come(signals);
    const Contribution<Real> one = term_[j].step(onset_[j].since(signals), scales_);
    return is_on ? one : Contribution<Real>{};
  }

  /// Terms of which there may be many.
  struct Together {
    std::size_t cogging = 0;
    std::size_t unnamed = 0;
    bool has_late = false;
    AngleMultiples<Real> multiples{};  ///< which cogging and teeth share
    void count(Effect effect) {
      if (effect == Effect::kSpindleCogging) ++cogging;
      if (effect >= Effect::kUnnamedTorque) ++unnamed;
    }
  };

  EffectScales<Real> scales_;
  double step_s_;
  [[no_unique_address]] std::conditional_t<kTriesMany, Together, Nothing> together_;
  std::array<EffectTerm<Real, kDelaySteps>, kMostTerms> term_{};
  std::array<Onset<Real>, kHasOnsets ? kMostTerms : 0> onset_{};
  std::array<AppliedTerm<Real, kDelaySteps>, kMostApplied> applied_term_{};
  std::array<bool, kMostApplied> applied_is_sensor_{};
  std::array<DryFriction<Real>, kMostApplied> friction_{};
  std::array<ActingFriction<Real>, kMostApplied> acting_friction_{};
  [[no_unique_address]] std::conditional_t<kFollowsFrictions, FrictionColumns<Real, kMostApplied>, Nothing>
      own_;
  std::array<bool, kFollowsFrictions ? kMostTerms : 0> is_own_{};
  std::size_t terms_ = 0;
  std::size_t applied_ = 0;
  std::size_t frictions_ = 0;
  std::size_t acting_ = 0;
};

/// What a little more of the model's own dry frictions changes in an interval, where a set follows that.
template <class Terms>
void begin_own_frictions(Terms& terms) {
  if constexpr (requires { terms.own_frictions(); }) terms.own_frictions().begin();
}
/// The same in the steps of a `BrakedMotion`.
template <class Terms>
struct OwnFrictionsInSteps {
  Terms& terms;

  void begin() {
    if constexpr (requires { terms.own_frictions(); }) terms.own_frictions().begin_steps();
  }
  template <class Growth, class Real>
  void step(const Growth& growth, Real step_s) {
    if constexpr (requires { terms.own_frictions(); }) terms.own_frictions().step(growth, step_s);
  }
};
template <class Terms, class Matrix>
void drift_own_frictions(Terms& terms, const Matrix& exp) {
  if constexpr (requires { terms.own_frictions(); }) terms.own_frictions().drift(exp);
}
/// After the observer's prediction; `first`: column of the first term.
template <class Terms, class Observer>
void add_own_frictions(Terms& terms, Observer& observer, std::size_t first) {
  if constexpr (requires { terms.own_frictions(); }) {
    const auto& own = terms.own_frictions();
    for (std::size_t i = 0; i < own.count(); ++i) observer.add(first + own[i].column, own[i].change);
  }
}

}  // namespace morepro::gap
