#pragma once
#include "lib/gap/column_set.hpp"
#include "lib/gap/gap_frame.hpp"
#include "lib/gap/two_state_observer.hpp"
#include "lib/plant/dynamics.hpp"

namespace morepro::gap {

/// Parameters of the nominal spindle that may be off, in the order of their columns. A column is the effect
/// of a relative error: +1 is a parameter twice as large as it should be said.
enum class SpindleColumn : std::size_t {
  kTorqueConstant = 0,
  kViscousFriction,
  kInertia,
  kResistance,
  kBackEmfConstant,
  kInductance,
};
inline constexpr std::size_t kSpindleParameters = 6;

/// Observer of spindle speed and current: exactly integrated torque and voltage balance of one interval, from
/// the best estimate at its beginning, against what is measured at its end.
/// `kTerms`: room for the terms of effects.
template <class Real, std::size_t kTerms, std::size_t kApplied, std::size_t kDelaySteps>
class SpindleObserver {
 public:
  static constexpr std::size_t kColumns = kSpindleParameters + kTerms;
  using Observer = TwoStateObserver<Real, kColumns>;
  using Row = typename Observer::Row;
  using Terms = ColumnSet<Real, kTerms, kApplied, kDelaySteps>;
  struct Rows {
    Row speed;
    Row current;
  };

  SpindleObserver(const MachineParameters& machine, const ReferencePoint& point, double step_s,
                  const GapNoise<Real>& noise)
      : plant_(machine), terms_(EffectScales<Real>(machine, point), step_s) {
    change_step(step_s, noise);
  }

  /// From the next frame on the frames are that far apart, with that noise in between. Not where a term or an
  /// effect remembers steps (a lag, a delay, a bristle, a shaft): it would go on in steps of the old length.
  void change_step(double step_s, const GapNoise<Real>& noise) {
    step_s_ = static_cast<Real>(step_s);
    noise_ = noise;
    process_noise_ = {noise.speed_step * noise.speed_step, Real(0), Real(0),
                      noise.current_step * noise.current_step};
    const auto jacobian = plant_.spindle_jacobian({}, {});
    braking_per_s_ = jacobian.a00;
    exponential_ = math::exponential_step(jacobian, step_s_);
    if constexpr (kApplied > 0) divide_friction();
  }

  /// The noise of a step comes in so many equal parts of it, not at its end: what they make of both states
  /// together. Until the step changes.
  void spread_noise(std::size_t parts) {
    const Real share = Real(1) / static_cast<Real>(parts);
    const auto phi = math::exponential_step(plant_.spindle_jacobian({}, {}), share * step_s_).exp;
    const math::BasicMatrix2<Real> turned{phi.a00, phi.a10, phi.a01, phi.a11};
    const math::BasicMatrix2<Real> each = process_noise_ * share;
    process_noise_ = {};
    for (std::size_t i = 0; i < parts; ++i) {
      const auto before = phi * process_noise_ * turned;
      process_noise_ = {before.a00 + each.a00, before.a01 + each.a01, before.a10 + each.a10,
                        before.a11 + each.a11};
    }
  }

  Terms& terms() { return terms_; }
  /// Columns in use: parameters and terms.
  [[nodiscard]] std::size_t columns() const { return kSpindleParameters + terms_.size(); }
  /// What the effects of the model added during the last interval, and what they made the sensors show at its
  /// beginning.
  [[nodiscard]] const Contribution<Real>& added() const { return added_; }
  [[nodiscard]] const Contribution<Real>& shown() const { return shown_; }
  /// Rows without columns, for who wants to know innovations only. Before the first frame.
  void leave_out_columns() { has_columns_ = false; }
  /// Estimate of a state: before a frame is seen as the model predicts it.
  [[nodiscard]] Real state(std::size_t index) const { return observer_.mean(index); }
  /// The next frame is a new beginning.
  void restart() { is_started_ = false; }
  [[nodiscard]] Real speed_rad_s() const { return observer_.mean(0); }
  [[nodiscard]] Real angle_rad() const { return angle_rad_; }

  /// Rows of the frame's measurements, then on to the next frame.
  void step(const GapFrame<Real>& frame, Rows& rows) {
    see(frame, rows);
    move_on(frame);
  }
  /// The first half of it: the rows of the frame's measurements.
  void see(const GapFrame<Real>& frame, Rows& rows) {
    rows.speed.is_measured = rows.current.is_measured = false;
    if (frame.has_feed_speed) feed_speed_m_s_ = frame.feed_speed_m_s;
    if (!is_started_) return start(frame);
    if (frame.has_angle) angle_rad_ = frame.angle_rad;
    update(frame, rows);
  }
  /// The voltage of the last interval was not known but to this variance, in V2.
  void blur_input(Real variance) {
    const auto& psi = exponential_.integral;
    const Real per_inductance = Real(1) / terms_.scales().inductance_h;
    observer_.blur(psi.a01 * per_inductance, psi.a11 * per_inductance, variance);
  }
  /// The second half: on to the next frame.
  void move_on(const GapFrame<Real>& frame) {
    if (is_started_) predict(frame);
  }

 private:
  void divide_friction() {
    const auto& [phi, psi] = exponential_;
    speed_rubbing_ = Rubbing<Real>(psi.a00, phi.a00, psi.a10, phi.a10, terms_.scales().inertia_kgm2);
    current_rubbing_ = Rubbing<Real>(psi.a11, phi.a11, psi.a01, phi.a01, terms_.scales().inductance_h);
  }

  void start(const GapFrame<Real>& frame) {
    if (!frame.has_speed) return;
    is_started_ = true;
    observer_.set_columns(has_columns_ ? columns() : 0);
    const auto& k = terms_.scales();
    const Real still_a =
        (frame.input.armature_voltage_v - k.back_emf_constant_vs_rad * frame.speed_rad_s) / k.resistance_ohm;
    const Real wide_a = k.current_a + math::abs(still_a);
    observer_.start(frame.speed_rad_s, frame.has_current ? frame.current_a : still_a, noise_.speed_variance,
                    frame.has_current ? noise_.current_variance : wide_a * wide_a);
    angle_rad_ = frame.angle_rad;
    driven_rad_s_ = observer_.mean(0);
    driven_a_ = observer_.mean(1);
  }

  void update(const GapFrame<Real>& frame, Rows& rows) {
    if (!terms_.is_empty()) show(signals_of(frame, observer_.mean(0), observer_.mean(1)));
    if (frame.has_current)
      observer_.template update<1>(frame.current_a - shown_.current_a - observer_.mean(1),
                                   noise_.doubt(frame.time_s) * noise_.current_variance, current_error_,
                                   rows.current);
    if (frame.has_speed)
      observer_.template update<0>(frame.speed_rad_s - shown_.speed_rad_s - observer_.mean(0),
                                   noise_.doubt(frame.time_s) * noise_.speed_variance, speed_error_,
                                   rows.speed);
    driven_rad_s_ += Real(kDrivenLeak) * (observer_.mean(0) - driven_rad_s_);
    driven_a_ += Real(kDrivenLeak) * (observer_.mean(1) - driven_a_);
  }

  void show(const EffectSignals<Real>& signals) {
    shown_ = terms_.applied(signals, true);
    terms_.for_each(signals, true, [this](std::size_t j, const Contribution<Real>& c) {
      speed_error_[kSpindleParameters + j] = c.speed_rad_s;
      current_error_[kSpindleParameters + j] = c.current_a;
    });
  }

  void predict(const GapFrame<Real>& frame) {
    const auto& k = terms_.scales();
    const Real half = Real(0.5);
    // One part of the friction before the rest and the other after (Strang): right to second order, and a
    // state that sticks does so where it should.
    Braking<Real> on_w{BrakedState::kSpindleSpeed, speed_rubbing_.before, frame.time_s,
                       observer_.variance(0)};
    Braking<Real> on_i{BrakedState::kCurrent, current_rubbing_.before, frame.time_s, observer_.variance(1)};
    begin_own_frictions(terms_);
    const auto w0 = terms_.rub_own(on_w, observer_.mean(0));
    auto i0 = terms_.rub_own(on_i, observer_.mean(1));
    const PlantState<Real> x{w0.value, Real(0), i0.value};
    const auto linear = plant_.linearise(x, frame.input);
    const auto& step = exponential_of(linear.spindle_jacobian);
    const auto& psi = step.integral;
    const auto& f = linear.derivative;
    drift_own_frictions(terms_, step.exp);
    const Real dw = psi.a00 * f.acceleration_rad_s2 + psi.a01 * f.current_rate_a_s;
    const Real di = psi.a10 * f.acceleration_rad_s2 + psi.a11 * f.current_rate_a_s;
    const EffectSignals<Real> middle = middle_of(frame, x, dw, di);
    added_ = terms_.applied(middle, false);
    const Real rate_w = added_.torque_nm / k.inertia_kgm2;
    const Real rate_i = added_.voltage_v / k.inductance_h;
    const Real free_w = x.speed_rad_s + dw + psi.a00 * rate_w + psi.a01 * rate_i;
    const Real free_i = x.current_a + di + psi.a10 * rate_w + psi.a11 * rate_i;
    on_w.yield = speed_rubbing_.after;
    on_i.yield = current_rubbing_.after;
    const auto w1 = terms_.rub_own(on_w, free_w);
    const auto i1 = terms_.rub_on(on_i, observer_.mean(1), i0, free_i, current_rubbing_);
    const Real rubbed_w = w0.value - observer_.mean(0) + w1.value - free_w;
    const Real rubbed_i = i0.value - observer_.mean(1) + i1.value - free_i;
    if constexpr (kApplied > 0) {
      added_.torque_nm += rubbed_w / (speed_rubbing_.before + speed_rubbing_.after);
      added_.voltage_v += rubbed_i / (current_rubbing_.before + current_rubbing_.after);
    }
    const Real added_w = psi.a00 * rate_w + psi.a01 * rate_i + rubbed_w;
    const Real added_i = psi.a10 * rate_w + psi.a11 * rate_i + rubbed_i;
    if (has_columns_) {
      const Real load_rad_s2 =
          (k.torque_constant_nm_a * x.current_a - k.viscous_friction_nms_rad * x.speed_rad_s) /
              k.inertia_kgm2 -
          f.acceleration_rad_s2;
      const Real driven_w = dw + psi.a01 * rate_i;
      load_columns(middle, load_rad_s2 + driven_w / step_s_, (dw + added_w) / step_s_,
                   (di + added_i) / step_s_);
    }
    const math::BasicMatrix2<Real> first{step.exp.a00 * w0.slope, step.exp.a01 * i0.slope,
                                         step.exp.a10 * w0.slope, step.exp.a11 * i0.slope};
    driven_rad_s_ += w1.value - observer_.mean(0);
    driven_a_ += i1.value - observer_.mean(1);
    observer_.predict(w1.value, i1.value, braked(first, w1.slope, i1.slope), braked(psi, w1.slope, i1.slope),
                      process_noise_, speed_rate_, current_rate_);
    add_own_frictions(terms_, observer_, kSpindleParameters);
    angle_rad_ += step_s_ * (x.speed_rad_s + half * dw);
  }

  /// Of the Jacobian, what brakes the speed alone depends on the state, and only in contact.
  const math::BasicExponentialStep2<Real>& exponential_of(const math::BasicMatrix2<Real>& jacobian) {
    if (!(jacobian.a00 == braking_per_s_)) {
      braking_per_s_ = jacobian.a00;
      exponential_ = math::exponential_step(jacobian, step_s_);
    }
    return exponential_;
  }

  static math::BasicMatrix2<Real> braked(const math::BasicMatrix2<Real>& m, Real speed_slope,
                                         Real current_slope) {
    return {speed_slope * m.a00, speed_slope * m.a01, current_slope * m.a10, current_slope * m.a11};
  }

  /// `unbraked_rad_s2`: acceleration without effects and viscous friction.
  /// The rates are those of the model with its effects: an inductance acts on the current as it changes, not
  /// as it would change without the lag of its drive. What the motor does is what accelerates and what
  /// friction takes, to the last bit but rounding: without a load, all three times the same factor must be no
  /// column, or it is found in noise.
  void load_columns(const EffectSignals<Real>& s, Real unbraked_rad_s2, Real acceleration_rad_s2,
                    Real current_rate_a_s) {
    const auto& k = terms_.scales();
    const Real per_inertia = Real(1) / k.inertia_kgm2;
    const Real per_inductance = Real(1) / k.inductance_h;
    speed_rate_[1] = -k.viscous_friction_nms_rad * s.speed_rad_s * per_inertia;
    speed_rate_[0] = unbraked_rad_s2 - speed_rate_[1];
    speed_rate_[2] = -acceleration_rad_s2;
    current_rate_[3] = -k.resistance_ohm * s.current_a * per_inductance;
    current_rate_[4] = -k.back_emf_constant_vs_rad * s.speed_rad_s * per_inductance;
    current_rate_[5] = -current_rate_a_s;
    terms_.for_each(s, false, [&](std::size_t j, const Contribution<Real>& c) {
      speed_rate_[kSpindleParameters + j] = c.torque_nm * per_inertia;
      current_rate_[kSpindleParameters + j] = c.voltage_v * per_inductance;
    });
  }

  /// Of the middle of an interval from `x` on, in which the states change by `dw` and `di`.
  EffectSignals<Real> middle_of(const GapFrame<Real>& frame, const PlantState<Real>& x, Real dw,
                                Real di) const {
    const Real half = Real(0.5);
    EffectSignals<Real> middle = signals_of(frame, x.speed_rad_s + half * dw, x.current_a + half * di);
    if (terms_.is_empty()) return middle;
    middle.acceleration_rad_s2 = dw / step_s_;
    middle.current_rate_a_s = di / step_s_;
    middle.angle_rad += half * step_s_ * x.speed_rad_s;
    return middle;
  }

  /// What nobody asks for without effects is left out.
  EffectSignals<Real> signals_of(const GapFrame<Real>& frame, Real speed_rad_s, Real current_a) const {
    EffectSignals<Real> s;
    s.speed_rad_s = speed_rad_s;
    s.current_a = current_a;
    if (terms_.is_empty()) return s;
    s.time_s = frame.time_s;
    s.cutting_time_s = frame.cutting_time_s;
    s.armature_voltage_v = frame.input.armature_voltage_v;
    s.feed_force_n = frame.input.feed_force_n;
    s.contact = frame.input.contact;
    s.chip_load_mm = frame.input.chip_load_mm;
    s.angle_rad = angle_rad_;
    s.driven_speed_rad_s = driven_rad_s_;
    s.driven_current_a = driven_a_;
    s.feed_speed_m_s = feed_speed_m_s_;
    s.tool_degc = frame.input.tool_temperature_degc;
    s.winding_degc = frame.winding_degc;
    return s;
  }

  Plant<Real> plant_;
  Terms terms_;
  Real step_s_;
  // What a friction of 1 N m takes from the speed in a step, and one of 1 V from the current; without what a
  // cut brakes of that.
  Rubbing<Real> speed_rubbing_;
  Rubbing<Real> current_rubbing_;
  GapNoise<Real> noise_;
  math::BasicMatrix2<Real> process_noise_;
  Real braking_per_s_;
  math::BasicExponentialStep2<Real> exponential_;
  Observer observer_;
  // What the columns add: to the states' derivatives during an interval, and to what the sensors show. Zero
  // for ever where one does not act.
  typename Observer::Columns speed_rate_{};
  typename Observer::Columns current_rate_{};
  Real angle_rad_ = 0;
  Real driven_rad_s_ = 0;
  Real driven_a_ = 0;
  Real feed_speed_m_s_ = 0;  ///< as last measured
  Contribution<Real> added_;
  Contribution<Real> shown_;
  bool is_started_ = false;
  bool has_columns_ = true;
  typename Observer::Columns speed_error_{};
  typename Observer::Columns current_error_{};
};

}  // namespace morepro::gap
