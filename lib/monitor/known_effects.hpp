#pragma once
#include <cstdint>

#include "lib/frame/frame_view.hpp"
#include "lib/gap/board_forms.hpp"
#include "lib/gap/column_set.hpp"
#include "lib/gap/reference_point.hpp"
#include "lib/math/matrix_exponential.hpp"
#include "lib/monitor/held_inputs.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/plant/dynamics.hpp"

namespace morepro {

/// What the filters know of the nominal machine at one frame.
struct NominalState {
  float speed_rad_s = 0.0F;
  float current_a = 0.0F;
  float feed_speed_m_s = 0.0F;
};

/// The effects that the machine is known to have, taken out of its frames: the estimators behind see what the
/// nominal machine would have shown. Exact where the machine is linear; nothing changes inside a filter.
///
/// Sensor errors are subtracted from what is measured, voltages U and forces F are added to the inputs. For a
/// torque M the nominal machine has another current, i' = i + M / Kt: with it Kt i' is Kt i + M, and
/// L di'/dt = V + U + R M / Kt + (L / Kt) dM/dt - R i' - Kv w. A wrong M is thus wrong in the torque balance
/// only.
///
/// An effect with an onset sets in at that time after the first frame. Bounded time; may run in an interrupt.
class KnownEffects {
 public:
  [[gnu::cold]] explicit KnownEffects(const MonitorConfiguration& c)
      : count_(c.effects.count),
        period_s_(static_cast<float>(1.0 / c.sampling.rate_hz)),
        plant_(c.machine),
        terms_({c.machine, gap::reference_point_of(c.machine)}, 1.0 / c.sampling.rate_hz) {
    const double decay = -c.machine.feed.viscous_friction_ns_m / c.machine.feed.mass_kg;
    const auto feed = math::exponential_step(math::Matrix2{.a00 = decay}, 1.0 / c.sampling.rate_hz);
    feed_share_s_ = static_cast<float>(feed.integral.a00);
    for (std::size_t i = 0; i < count_; ++i) (void)terms_.apply(c.effects.effect[i]);
  }

  [[nodiscard]] bool is_empty() const { return count_ == 0; }

  /// The frame of the nominal machine, valid until the next call. To be called once per frame. `is_restart`:
  /// nothing is known of the interval before it.
  [[nodiscard, gnu::noinline]] FrameView take_out(const FrameView& seen, bool is_restart) {
    if (is_restart) restart(seen);
    frame_ = seen.frame;
    const auto add = [this](Channel channel, float value) { frame_.value[index_of(channel)] += value; };
    add(Channel::kSpindleSpeed, -shown_.speed_rad_s);
    add(Channel::kArmatureCurrent, next_torque_a_ - shown_.current_a);
    add(Channel::kFeedSpeed, -shown_.feed_speed_m_s);
    return {frame_, seen.usable};
  }

  /// One interval ahead, from the frame whose inputs hold now: from now on `held` has the inputs of the
  /// nominal machine. `measured`: bit_of(channel) of what the frame holds, 0 where it is missing. Not
  /// inlined: its variables need no room on the stack while the filters work.
  [[gnu::noinline]] void look_ahead(const NominalState& nominal, std::uint16_t measured, HeldInputs& held) {
    torque_a_ = next_torque_a_;
    PlantState<float> now{nominal.speed_rad_s, nominal.feed_speed_m_s, nominal.current_a - torque_a_};
    if (!held.knows(Channel::kArmatureVoltage)) now.speed_rad_s = held.get(Channel::kSpindleSpeed);
    if (!held.knows(Channel::kFeedForce)) now.feed_speed_m_s = held.get(Channel::kFeedSpeed);
    take_inputs(measured, held);
    place(measured, held);
    act(now, held);
    ++intervals_;
    cutting_intervals_ += held.is_in_contact() ? 1U : 0U;
  }

  /// Current of the machine beside that of the nominal one, at the frame.
  [[nodiscard]] float current_a(float nominal_a) const { return nominal_a - torque_a_; }

 private:
  using Terms = gap::ColumnSet<float, 0, MachineEffects::kMost, gap::kBoardDelaySteps>;
  using Signals = gap::EffectSignals<float>;
  using Sum = gap::Contribution<float>;

  /// No sum of effects is larger than what its channel can show, and none is no number.
  static float bounded(float value, Channel channel) {
    const float most = info_of(channel).highest;
    return value >= -most && value <= most ? value : 0.0F;
  }

  [[nodiscard]] float time_s() const { return static_cast<float>(intervals_) * period_s_; }

  /// Where the frame has no voltage or force, `held` still has those of the nominal machine.
  void take_inputs(std::uint16_t measured, const HeldInputs& held) {
    const float voltage_v = input_.armature_voltage_v, force_n = input_.feed_force_n;
    input_ = held.plant();
    if ((measured & bit_of(Channel::kArmatureVoltage)) == 0) input_.armature_voltage_v = voltage_v;
    if ((measured & bit_of(Channel::kFeedForce)) == 0) input_.feed_force_n = force_n;
  }

  /// What the sensors add is what they show.
  void restart(const FrameView& seen) {
    has_middle_ = false;
    next_torque_a_ = 0.0F;
    Signals signals;
    signals.time_s = time_s();
    if (seen.has(Channel::kSpindleSpeed)) signals.speed_rad_s = seen.get(Channel::kSpindleSpeed);
    if (seen.has(Channel::kArmatureCurrent)) signals.current_a = seen.get(Channel::kArmatureCurrent);
    if (seen.has(Channel::kFeedSpeed)) signals.feed_speed_m_s = seen.get(Channel::kFeedSpeed);
    if (seen.has(Channel::kSpindleAngle)) signals.angle_rad = seen.get(Channel::kSpindleAngle);
    signals.driven_speed_rad_s = signals.speed_rad_s;
    signals.driven_current_a = signals.current_a;
    signals.driven_feed_speed_m_s = signals.feed_speed_m_s;
    show(signals);
  }

  /// Angle and position: measured, or followed by integration.
  void place(std::uint16_t measured, const HeldInputs& held) {
    if ((measured & bit_of(Channel::kSpindleAngle)) != 0) angle_rad_ = held.get(Channel::kSpindleAngle);
    if ((measured & bit_of(Channel::kFeedPosition)) == 0) return;
    if (!has_origin_) origin_m_ = held.get(Channel::kFeedPosition) - position_m_;
    has_origin_ = true;
    position_m_ = held.get(Channel::kFeedPosition) - origin_m_;
  }

  /// Half of the dry friction before the interval and half of it after, all other effects in its middle,
  /// those of the sensors at its end.
  void act(const PlantState<float>& now, HeldInputs& held) {
    constexpr float kHalf = 0.5F;
    const auto& k = terms_.scales();
    const float yield_w = kHalf * period_s_ / k.inertia_kgm2;
    const float yield_i = kHalf * period_s_ / k.inductance_h;
    const float yield_v = kHalf * feed_share_s_ / k.mass_kg;
    const PlantState<float> rubbed = after_friction(now, yield_w, yield_i, yield_v);
    const PlantState<float> change = nominal_change(rubbed, held);
    Signals middle = signals_of(held, moved(rubbed, change, kHalf));
    middle.time_s += kHalf * period_s_;
    middle.angle_rad += kHalf * period_s_ * rubbed.speed_rad_s;
    middle.feed_position_m += kHalf * period_s_ * rubbed.feed_speed_m_s;
    middle.acceleration_rad_s2 = change.speed_rad_s / period_s_;
    middle.current_rate_a_s = change.current_a / period_s_;
    Sum added = terms_.applied(middle, false);
    PlantState<float> free = moved(rubbed, change, 1.0F);
    free.speed_rad_s += 2.0F * yield_w * added.torque_nm;
    free.current_a += 2.0F * yield_i * added.voltage_v;
    free.feed_speed_m_s += 2.0F * yield_v * added.force_n;
    PlantState<float> end = after_friction(free, yield_w, yield_i, yield_v);
    gap::FrictionStep<float> first{rubbed.current_a};
    end.current_a = gap::around_a_turn(now.current_a, first, free.current_a, {end.current_a},
                                       gap::Rubbing<float>(yield_i))
                        .value;
    const auto load = [](float before, float after, float freely, float start, float yield) {
      return 0.5F * (before - start + after - freely) / yield;
    };
    added.torque_nm += load(rubbed.speed_rad_s, end.speed_rad_s, free.speed_rad_s, now.speed_rad_s, yield_w);
    added.voltage_v += load(rubbed.current_a, end.current_a, free.current_a, now.current_a, yield_i);
    added.force_n +=
        load(rubbed.feed_speed_m_s, end.feed_speed_m_s, free.feed_speed_m_s, now.feed_speed_m_s, yield_v);
    hold(added, held);
    go_on(now, end);
    Signals at_end = signals_of(held, end);
    at_end.time_s += period_s_;
    show(at_end);
  }

  PlantState<float> after_friction(const PlantState<float>& x, float yield_w, float yield_i,
                                   float yield_v) const {
    using enum gap::BrakedState;
    const float t = time_s();
    return {terms_.rub({kSpindleSpeed, yield_w, t}, x.speed_rad_s).value,
            terms_.rub({kFeedSpeed, yield_v, t}, x.feed_speed_m_s).value,
            terms_.rub({kCurrent, yield_i, t}, x.current_a).value};
  }

  /// Of the nominal machine over the interval; an axis whose input is not known goes on as it is.
  [[nodiscard]] PlantState<float> nominal_change(const PlantState<float>& x, const HeldInputs& held) const {
    const auto linear = plant_.linearise(x, input_);
    const auto& rate = linear.derivative;
    PlantState<float> change;
    if (held.knows(Channel::kArmatureVoltage)) {
      const auto psi = math::exponential_step(linear.spindle_jacobian, period_s_).integral;
      change.speed_rad_s = psi.a00 * rate.acceleration_rad_s2 + psi.a01 * rate.current_rate_a_s;
      change.current_a = psi.a10 * rate.acceleration_rad_s2 + psi.a11 * rate.current_rate_a_s;
    }
    if (held.knows(Channel::kFeedForce)) change.feed_speed_m_s = feed_share_s_ * rate.feed_acceleration_m_s2;
    return change;
  }

  static PlantState<float> moved(const PlantState<float>& x, const PlantState<float>& change, float share) {
    return {x.speed_rad_s + share * change.speed_rad_s, x.feed_speed_m_s + share * change.feed_speed_m_s,
            x.current_a + share * change.current_a};
  }

  /// The torque is known in the middle of each interval; its line through the last two gives the interval's
  /// end. Between two frames it is a straight line, whatever its steps: its voltage is exact.
  void hold(const Sum& added, HeldInputs& held) {
    const auto& k = terms_.scales();
    const float middle_a = bounded(added.torque_nm / k.torque_constant_nm_a, Channel::kArmatureCurrent);
    next_torque_a_ = has_middle_ ? 1.5F * middle_a - 0.5F * middle_torque_a_ : middle_a;
    middle_torque_a_ = middle_a;
    has_middle_ = true;
    const float of_torque_v = 0.5F * k.resistance_ohm * (torque_a_ + next_torque_a_) +
                              k.inductance_h * (next_torque_a_ - torque_a_) / period_s_;
    held.drive(input_.armature_voltage_v + bounded(added.voltage_v, Channel::kArmatureVoltage) + of_torque_v,
               input_.feed_force_n + bounded(added.force_n, Channel::kFeedForce));
  }

  /// Angle and position at the interval's end. The angle starts anew after so many turns, a float's worth.
  void go_on(const PlantState<float>& start, const PlantState<float>& end) {
    constexpr float kManyTurnsRad = 6283.1853F;
    angle_rad_ += 0.5F * period_s_ * (start.speed_rad_s + end.speed_rad_s);
    if (angle_rad_ > kManyTurnsRad) angle_rad_ -= kManyTurnsRad;
    if (angle_rad_ < -kManyTurnsRad) angle_rad_ += kManyTurnsRad;
    position_m_ += 0.5F * period_s_ * (start.feed_speed_m_s + end.feed_speed_m_s);
  }

  void show(const Signals& signals) {
    const Sum error = terms_.applied(signals, true);
    shown_.speed_rad_s = bounded(error.speed_rad_s, Channel::kSpindleSpeed);
    shown_.current_a = bounded(error.current_a, Channel::kArmatureCurrent);
    shown_.feed_speed_m_s = bounded(error.feed_speed_m_s, Channel::kFeedSpeed);
  }

  [[nodiscard]] Signals signals_of(const HeldInputs& held, const PlantState<float>& x) const {
    Signals s;
    s.time_s = time_s();
    s.cutting_time_s = static_cast<float>(cutting_intervals_) * period_s_;
    s.armature_voltage_v = input_.armature_voltage_v;
    s.feed_force_n = input_.feed_force_n;
    s.contact = input_.contact;
    s.chip_load_mm = input_.chip_load_mm;
    s.speed_rad_s = s.driven_speed_rad_s = x.speed_rad_s;
    s.angle_rad = angle_rad_;
    s.current_a = s.driven_current_a = x.current_a;
    s.feed_speed_m_s = s.driven_feed_speed_m_s = x.feed_speed_m_s;
    s.feed_position_m = position_m_;
    s.tool_degc = input_.tool_temperature_degc;
    s.winding_degc = held.winding_degc();
    return s;
  }

  std::size_t count_;
  float period_s_;
  float feed_share_s_ = 0.0F;  ///< a constant acceleration times this is the change of the feed's speed
  Plant<float> plant_;
  Terms terms_;
  PlantInput<float> input_;       ///< as recorded
  SensorFrame frame_;             ///< as the nominal machine would have shown it
  Sum shown_;                     ///< what the sensors add at the next frame
  float torque_a_ = 0.0F;         ///< torque of the effects at the frame, as the current that would give it
  float next_torque_a_ = 0.0F;    ///< at the next frame
  float middle_torque_a_ = 0.0F;  ///< in the middle of the interval before
  float angle_rad_ = 0.0F;
  float position_m_ = 0.0F;
  float origin_m_ = 0.0F;
  bool has_middle_ = false;
  bool has_origin_ = false;
  std::uint32_t intervals_ = 0;
  std::uint32_t cutting_intervals_ = 0;
};

}  // namespace morepro
