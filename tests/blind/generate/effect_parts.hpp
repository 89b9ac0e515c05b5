#pragma once
#include <cmath>
#include <memory>
#include <utility>

#include "effect.hpp"

namespace blind {

/// An effect without memory: a law of the present point.
template <typename Law>
class Instant final : public Effect {
 public:
  explicit Instant(Law law) : law_(std::move(law)) {}
  void act(const Point& p, const double*, Loads& loads) const override { law_(p, strength, loads); }

 private:
  Law law_;
};

template <typename Law>
std::unique_ptr<Effect> instant(Law law) {
  return std::make_unique<Instant<Law>>(std::move(law));
}

/// An effect with own states: `flow(point, strength, z, dz)` and `law(point, strength, z, loads)`.
template <int kCount, typename Flow, typename Law>
class Dynamic final : public Effect {
 public:
  Dynamic(Flow flow, Law law) : flow_(std::move(flow)), law_(std::move(law)) {}
  int states() const override { return kCount; }
  void act(const Point& p, const double* z, Loads& loads) const override { law_(p, strength, z, loads); }
  void flow(const Point& p, const double* z, double* dz) const override { flow_(p, strength, z, dz); }

 private:
  Flow flow_;
  Law law_;
};

template <int kCount, typename Flow, typename Law>
std::unique_ptr<Effect> dynamic(Flow flow, Law law) {
  return std::make_unique<Dynamic<kCount, Flow, Law>>(std::move(flow), std::move(law));
}

/// Two equal poles between a command and what acts; the strength is their total time constant. Solved in
/// closed form over one integration step, because a small lag is far faster than the step.
class Lag final : public Effect {
 public:
  Lag(double Inputs::*command, double Loads::*acting) : command_(command), acting_(acting) {}
  void act(const Point& p, const double*, Loads& loads) const override {
    const double u = p.in.*command_, steps = kStep_s / pole_s(), left = std::exp(-steps);
    loads.*acting_ = u + ((second_ - u) * (1.0 - left) + (first_ - u) * (1.0 - left * (1.0 + steps))) / steps;
  }
  void track(const Point& p, double) override {
    const double u = p.in.*command_, steps = kStep_s / pole_s(), left = std::exp(-steps);
    second_ = u + (second_ - u + (first_ - u) * steps) * left;
    first_ = u + (first_ - u) * left;
  }

 private:
  double pole_s() const { return 0.5 * strength + 1e-9; }
  double Inputs::*command_;
  double Loads::*acting_;
  double first_ = 0.0, second_ = 0.0;
};

inline double torque_scale(const Machine& m) { return 0.1 * m.torque_constant * m.working_current(); }
inline double force_scale(const Machine& m) {
  return 0.15 * (m.contact_force + m.contact_offset) + 0.005 * m.feed_viscous;
}
inline double voltage_scale(const Machine&) { return 0.4; }

std::vector<EffectKind> shaft_effects();
std::vector<EffectKind> cutting_effects();
std::vector<EffectKind> feed_friction_effects();
std::vector<EffectKind> feed_drive_effects();
std::vector<EffectKind> voltage_effects();
std::vector<EffectKind> sensor_effects();
std::vector<EffectKind> clock_effects();

}  // namespace blind
