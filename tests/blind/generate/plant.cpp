#include "plant.hpp"

#include <algorithm>
#include <cmath>

namespace blind {
namespace {
enum Slot { kW, kV, kI, kAngle, kX, kTool, kSlow, kFast };
}

Plant::Plant(const Machine& machine, std::vector<ActiveEffect> effects, double winding_time_s,
             double tool_time_s)
    : machine_(machine),
      effects_(std::move(effects)),
      point_{.machine = machine, .in = {}},
      winding_time_s_(winding_time_s),
      tool_time_s_(tool_time_s) {
  state_[kTool] = 20.0;
  for (const ActiveEffect& active : effects_) used_ += active.effect->states();
}

void Plant::set_point(const Vector& s) {
  point_.w = s[kW];
  point_.v = s[kV];
  point_.i = s[kI];
  point_.angle = s[kAngle];
  point_.x = s[kX];
  point_.tool_c = s[kTool];
  point_.slow_heat_k = s[kSlow];
  point_.fast_heat_k = s[kFast];
}

void Plant::balances(const Loads& l, const Disturbance& d, Vector& rate) {
  const Machine& m = machine_;
  const Point& p = point_;
  const double contact = p.in.contact;
  rate[kW] = (m.torque_constant * l.torque_constant * p.i - m.viscous * l.viscous * p.w -
              contact * l.shaft_contact * p.contact_torque + l.torque_nm + d.torque_nm) /
             (m.inertia * l.inertia);
  rate[kV] = (l.applied_force_n - m.feed_viscous * l.feed_viscous * p.v -
              contact * l.feed_contact * (m.contact_force * p.in.engagement + m.contact_offset) + l.force_n +
              d.force_n) /
             (m.mass * l.mass);
  rate[kI] = (l.applied_voltage_v + l.voltage_v + d.voltage_v - m.resistance * l.resistance * p.i -
              m.back_emf_constant * l.back_emf * p.w) /
             (m.inductance * l.inductance);
  rate[kAngle] = p.w;
  rate[kX] = p.v;
  point_.speed_rate = rate[kW];
  point_.feed_rate = rate[kV];
  point_.current_rate = rate[kI];
}

void Plant::heat(Vector& rate) const {
  const Point& p = point_;
  const double share = std::min(1.3, std::abs(p.w) / machine_.working_speed());
  const double tool_goal =
      std::min(720.0, 20.0 + p.in.contact * 1000.0 * share * std::min(1.0, p.in.engagement));
  rate[kTool] = (tool_goal - p.tool_c) / tool_time_s_;
  const double power = std::min(20.0, std::pow(p.i / machine_.working_current(), 2));
  rate[kSlow] = (12.0 * power - p.slow_heat_k) / winding_time_s_;
  rate[kFast] = (5.0 * power - p.fast_heat_k) / (0.15 * winding_time_s_);
}

void Plant::derivative(const Vector& state, const Disturbance& disturbance, Vector& rate) {
  set_point(state);
  point_.contact_torque = point_.in.contact > 0.0
                              ? contact_torque(machine_, point_.w, point_.in.chip_load_mm, heat_factor_)
                              : 0.0;
  Loads loads{.applied_voltage_v = point_.in.voltage_v, .applied_force_n = point_.in.force_n};
  int slot = kBase;
  for (const ActiveEffect& active : effects_) {
    point_.cut_s = active.cut_s;
    if (point_.t >= active.onset_s) active.effect->act(point_, state.data() + slot, loads);
    slot += active.effect->states();
  }
  balances(loads, disturbance, rate);
  heat(rate);
  slot = kBase;
  for (const ActiveEffect& active : effects_) {
    active.effect->flow(point_, state.data() + slot, rate.data() + slot);
    slot += active.effect->states();
  }
}

void Plant::step(const Inputs& inputs, const Disturbance& disturbance, double h) {
  point_.in = inputs;
  heat_factor_ = heat_factor(machine_, state_[kTool]);
  Vector k[4], at = state_;
  static constexpr double kReach[] = {0.5, 0.5, 1.0};
  derivative(state_, disturbance, k[0]);
  for (int stage = 1; stage < 4; ++stage) {
    for (int j = 0; j < used_; ++j) at[j] = state_[j] + h * kReach[stage - 1] * k[stage - 1][j];
    derivative(at, disturbance, k[stage]);
  }
  for (int j = 0; j < used_; ++j) state_[j] += h / 6.0 * (k[0][j] + 2.0 * (k[1][j] + k[2][j]) + k[3][j]);
  set_point(state_);
  point_.t += h;
  for (ActiveEffect& active : effects_)
    if (inputs.contact > 0.0 && point_.t >= active.onset_s) active.cut_s += h;
  for (const ActiveEffect& active : effects_) active.effect->track(point_, h);
}

bool Plant::is_finite() const {
  return std::all_of(state_.begin(), state_.begin() + used_,
                     [](double value) { return std::abs(value) < 1e6; });
}

}  // namespace blind
