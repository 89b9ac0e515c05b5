#pragma once
#include <type_traits>

#include "lib/gap/braked_motion.hpp"
#include "lib/gap/column_set.hpp"
#include "lib/gap/gap_frame.hpp"
#include "lib/gap/two_state_observer.hpp"

namespace morepro::gap {

/// Parameters of the nominal feed axis that may be off, in the order of their columns; relative errors, but
/// the contact load's: 1 N.
enum class FeedColumn : std::size_t { kMass = 0, kViscousFriction, kContactLoad, kEngagedLoad };
inline constexpr std::size_t kFeedParameters = 4;

/// Observer of feed position and speed, from either sensor or both.
template <class Real, std::size_t kTerms, std::size_t kApplied, std::size_t kDelaySteps>
class FeedObserver {
 public:
  static constexpr std::size_t kColumns = kFeedParameters + kTerms;
  using Observer = TwoStateObserver<Real, kColumns>;
  using Row = typename Observer::Row;
  using Terms = ColumnSet<Real, kTerms, kApplied, kDelaySteps>;
  struct Rows {
    Row position;
    Row speed;
  };

  FeedObserver(const MachineParameters& machine, const ReferencePoint& point, double step_s,
               const GapNoise<Real>& noise)
      : terms_(EffectScales<Real>(machine, point), step_s),
        contact_force_n_(static_cast<Real>(machine.feed.contact_force_n)),
        contact_offset_n_(static_cast<Real>(machine.feed.contact_offset_n)),
        step_s_(static_cast<Real>(step_s)),
        noise_(noise),
        process_noise_(shaken(noise.feed_step, step_s_)),
        braked_(static_cast<Real>(machine.feed.viscous_friction_ns_m / machine.feed.mass_kg), step_s_) {
    const double rate = -machine.feed.viscous_friction_ns_m / machine.feed.mass_kg;
    const auto step = math::exponential_step(math::Matrix2{0.0, 1.0, 0.0, rate}, step_s);
    const auto cast = [](const math::Matrix2& m) {
      return math::BasicMatrix2<Real>{static_cast<Real>(m.a00), static_cast<Real>(m.a01),
                                      static_cast<Real>(m.a10), static_cast<Real>(m.a11)};
    };
    exp_ = cast(step.exp);
    integral_ = cast(step.integral);
    friction_yield_ = half_of(integral_.a11, exp_.a11) / terms_.scales().mass_kg;
  }

  Terms& terms() { return terms_; }
  /// Columns in use: parameters and terms.
  [[nodiscard]] std::size_t columns() const { return kFeedParameters + terms_.size(); }
  /// What the effects of the model added during the last interval, and what they made the sensors show at its
  /// beginning.
  [[nodiscard]] const Contribution<Real>& added() const { return added_; }
  [[nodiscard]] const Contribution<Real>& shown() const { return shown_; }
  /// Rows without columns, for who wants to know innovations only. Before the first frame.
  void leave_out_columns() { has_columns_ = false; }
  /// The next frame is a new beginning, in the same place.
  void restart() { is_started_ = false; }
  /// Estimate of a state: before a frame is seen as the model predicts it.
  [[nodiscard]] Real state(std::size_t index) const { return observer_.mean(index); }

  /// Positions count from there, not from the first one that is seen. Before the first frame.
  void count_positions_from(Real origin_m) {
    origin_m_ = origin_m;
    has_origin_ = true;
  }
  /// Rows of the frame's measurements, then on to the next frame. `spindle_speed_rad_s` and `angle_rad`: of
  /// the spindle, where they are known.
  void step(const GapFrame<Real>& frame, Real spindle_speed_rad_s, Real angle_rad, Rows& rows) {
    see(frame, spindle_speed_rad_s, angle_rad, rows);
    move_on(frame);
  }
  /// The force of the last interval was not known but to this variance, in N2.
  void blur_input(Real variance) {
    const Real per_mass = Real(1) / terms_.scales().mass_kg;
    observer_.blur(integral_.a01 * per_mass, integral_.a11 * per_mass, variance);
  }
  /// The first half of it: the rows of the frame's measurements.
  void see(const GapFrame<Real>& frame, Real spindle_speed_rad_s, Real angle_rad, Rows& rows) {
    rows.speed.is_measured = rows.position.is_measured = false;
    spindle_speed_rad_s_ = spindle_speed_rad_s;
    angle_rad_ = angle_rad;
    if (!is_started_) return start(frame);
    update(frame, rows);
  }
  /// The second half: on to the next frame.
  void move_on(const GapFrame<Real>& frame) {
    if (is_started_) predict(frame);
  }

 private:
  /// A random force lasts longer than an interval: what it adds to the speed at the end it has added to the
  /// position by half. Without that, the position seems to know the speed too early.
  static constexpr math::BasicMatrix2<Real> shaken(Real speed_step, Real step_s) {
    const Real position_step = Real(0.5) * step_s * speed_step;
    return {position_step * position_step, position_step * speed_step, position_step * speed_step,
            speed_step * speed_step};
  }

  void start(const GapFrame<Real>& frame) {
    if (!frame.has_feed_speed && !frame.has_feed_position) return;
    is_started_ = true;
    driven_m_s_ = frame.has_feed_speed ? frame.feed_speed_m_s : Real(0);
    observer_.set_columns(has_columns_ ? columns() : 0);
    if (!has_origin_) origin_m_ = frame.has_feed_position ? frame.feed_position_m : Real(0);
    has_origin_ = true;
    const Real wide = terms_.scales().feed_speed_m_s;
    observer_.start(frame.feed_position_m - origin_m_, frame.has_feed_speed ? frame.feed_speed_m_s : Real(0),
                    frame.has_feed_position ? noise_.feed_position_variance : Real(0),
                    frame.has_feed_speed ? noise_.feed_speed_variance : wide * wide);
  }

  void update(const GapFrame<Real>& frame, Rows& rows) {
    if (!terms_.is_empty()) show(signals_of(frame, observer_.mean(0), observer_.mean(1)));
    if (frame.has_feed_position)
      observer_.template update<0>(frame.feed_position_m - origin_m_ - observer_.mean(0),
                                   noise_.doubt(frame.time_s) * noise_.feed_position_variance, no_position_,
                                   rows.position);
    if (frame.has_feed_speed)
      observer_.template update<1>(frame.feed_speed_m_s - shown_.feed_speed_m_s - observer_.mean(1),
                                   noise_.doubt(frame.time_s) * noise_.feed_speed_variance, speed_error_,
                                   rows.speed);
    driven_m_s_ += Real(kDrivenLeak) * (observer_.mean(1) - driven_m_s_);
  }

  void show(const EffectSignals<Real>& signals) {
    shown_ = terms_.applied(signals, true);
    terms_.for_each(signals, true, [this](std::size_t j, const Contribution<Real>& c) {
      speed_error_[kFeedParameters + j] = c.feed_speed_m_s;
    });
  }

  void predict(const GapFrame<Real>& frame) {
    const auto& k = terms_.scales();
    const Real x = observer_.mean(0);
    const Real half = Real(0.5);
    const Braking<Real> braking{BrakedState::kFeedSpeed, friction_yield_, frame.time_s,
                                observer_.variance(1)};
    const Real v = terms_.rub(braking, observer_.mean(1)).value;
    const Real cut_n = frame.input.contact * (contact_force_n_ * frame.input.engagement + contact_offset_n_);
    const Real rate = (frame.input.feed_force_n - k.feed_viscous_friction_ns_m * v - cut_n) / k.mass_kg;
    const Real dv = integral_.a11 * rate;
    const Real dx = integral_.a00 * v + integral_.a01 * rate;
    EffectSignals<Real> middle = signals_of(frame, x + half * dx, v + half * dv);
    added_ = terms_.applied(middle, false);
    const Real rate_added = added_.force_n / k.mass_kg;
    Motion<Real> motion;
    if (!in_steps(braking, (frame.input.feed_force_n - cut_n) / k.mass_kg + rate_added, motion))
      motion = in_halves(braking, rate, rate_added);
    added_.force_n += motion.rubbed_m_s / motion.rubbing_s * k.mass_kg;
    if (has_columns_) load_columns(middle, motion.gained_m_s / step_s_, frame.input);
    driven_m_s_ += motion.speed_m_s - observer_.mean(1);
    observer_.predict(motion.position_m, motion.speed_m_s, motion.by_state, motion.by_rate, process_noise_,
                      no_position_, speed_rate_);
    add_own_frictions(terms_, observer_, kFeedParameters);
  }

  /// Half of the friction before the rest and half of it after (Strang): right to second order, and a state
  /// that sticks does so where it should. `rate`: the acceleration after the first half, without friction and
  /// effects; `added`: by effects.
  Motion<Real> in_halves(const Braking<Real>& braking, Real rate, Real added) {
    begin_own_frictions(terms_);
    const auto before = terms_.rub_own(braking, observer_.mean(1));
    drift_own_frictions(terms_, exp_);
    const Real v = before.value;
    const Real dv = integral_.a11 * rate;
    const Real dx = integral_.a00 * v + integral_.a01 * rate;
    const Real free_m_s = v + dv + integral_.a11 * added;
    const auto after = terms_.rub_own(braking, free_m_s);
    const Real rubbed_m_s = v - observer_.mean(1) + after.value - free_m_s;
    return {
        .position_m = observer_.mean(0) + dx + integral_.a01 * added,
        .speed_m_s = after.value,
        .by_state = {exp_.a00, exp_.a01 * before.slope, after.slope * exp_.a10,
                     after.slope * exp_.a11 * before.slope},
        .by_rate = {integral_.a00, integral_.a01, after.slope * integral_.a10, after.slope * integral_.a11},
        .gained_m_s = dv + integral_.a11 * added + rubbed_m_s,
        .rubbed_m_s = rubbed_m_s,
        .rubbing_s = Real(2) * friction_yield_ * terms_.scales().mass_kg};
  }
  /// The same as exactly as it is needed, where dry friction acts; false where it does not, or where that
  /// takes too long. `free_m_s2`: with the effects.
  bool in_steps(Braking<Real> braking, Real free_m_s2, Motion<Real>& motion) {
    if constexpr (kApplied == 0) {
      return false;
    } else {
      braking.yield = Real(1) / terms_.scales().mass_kg;
      if (!braked_.tells_turns() || !terms_.begin_friction(braking)) return false;
      begin_own_frictions(terms_);
      return braked_.move(
          observer_.mean(0), observer_.mean(1), free_m_s2, terms_.friction_width(),
          [this](Real speed_m_s) { return terms_.friction_at(speed_m_s); },
          OwnFrictionsInSteps<Terms>{terms_}, motion);
    }
  }

  void load_columns(const EffectSignals<Real>& s, Real acceleration_m_s2, const PlantInput<Real>& input) {
    const auto& k = terms_.scales();
    const Real per_mass = Real(1) / k.mass_kg;
    speed_rate_[0] = -acceleration_m_s2;
    speed_rate_[1] = -k.feed_viscous_friction_ns_m * s.feed_speed_m_s * per_mass;
    speed_rate_[2] = -input.contact * per_mass;
    speed_rate_[3] = -input.contact * (input.engagement - Real(1)) * per_mass;
    terms_.for_each(s, false, [&](std::size_t j, const Contribution<Real>& c) {
      speed_rate_[kFeedParameters + j] = c.force_n * per_mass;
    });
  }

  /// What nobody asks for without effects is left out.
  EffectSignals<Real> signals_of(const GapFrame<Real>& frame, Real position_m, Real speed_m_s) const {
    EffectSignals<Real> s;
    s.feed_speed_m_s = speed_m_s;
    if (terms_.is_empty()) return s;
    s.time_s = frame.time_s;
    s.cutting_time_s = frame.cutting_time_s;
    s.feed_force_n = frame.input.feed_force_n;
    s.contact = frame.input.contact;
    s.chip_load_mm = frame.input.chip_load_mm;
    s.speed_rad_s = spindle_speed_rad_s_;
    s.angle_rad = angle_rad_;
    s.driven_feed_speed_m_s = driven_m_s_;
    s.feed_position_m = position_m;
    s.tool_degc = frame.input.tool_temperature_degc;
    s.winding_degc = frame.winding_degc;
    return s;
  }

  Terms terms_;
  Real contact_force_n_;
  Real contact_offset_n_;
  Real step_s_;
  GapNoise<Real> noise_;
  math::BasicMatrix2<Real> process_noise_;
  std::conditional_t<(kApplied > 0), BrakedMotion<Real>, NoBrakedMotion> braked_;
  math::BasicMatrix2<Real> exp_{};
  math::BasicMatrix2<Real> integral_{};
  Real friction_yield_ = 0;  ///< what half of an interval's friction of 1 N takes from the speed
  Observer observer_;
  typename Observer::Columns
      no_position_{};  ///< always zero: nothing acts on the position but through the speed
  // What the columns add: to the speed's derivative during an interval, and to what its sensor shows. Zero
  // for ever where one does not act.
  typename Observer::Columns speed_rate_{};
  Real origin_m_ = 0;
  Real driven_m_s_ = 0;
  Real spindle_speed_rad_s_ = 0;
  Real angle_rad_ = 0;
  Contribution<Real> added_;
  Contribution<Real> shown_;
  bool is_started_ = false;
  bool has_origin_ = false;
  bool has_columns_ = true;
  typename Observer::Columns speed_error_{};
};

}  // namespace morepro::gap
