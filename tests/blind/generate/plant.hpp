#pragma once
#include <array>
#include <memory>
#include <vector>

#include "effect.hpp"

namespace blind {

/// An effect of this run and the time at which it sets in.
struct ActiveEffect {
  Effect* effect = nullptr;
  double onset_s = 0.0;
  double cut_s = 0.0;  ///< time in contact since
};

/// Random load and ripple during one integration step: N m, N, V.
struct Disturbance {
  double torque_nm = 0.0, force_n = 0.0, voltage_v = 0.0;
};

/// The machine with its effects: classical Runge-Kutta steps of the balances, of the temperatures and of the
/// effects' own states.
class Plant {
 public:
  Plant(const Machine& machine, std::vector<ActiveEffect> effects, double winding_time_s, double tool_time_s);

  /// One step of `step_s` with held inputs.
  void step(const Inputs& inputs, const Disturbance& disturbance, double step_s);
  /// The machine now, with the rates of the last step.
  const Point& now() const { return point_; }
  bool is_finite() const;

 private:
  static constexpr int kBase = 8;
  static constexpr int kMost = kBase + 8;
  using Vector = std::array<double, kMost>;

  void derivative(const Vector& state, const Disturbance& disturbance, Vector& rate);
  void set_point(const Vector& state);
  void balances(const Loads& loads, const Disturbance& disturbance, Vector& rate);
  void heat(Vector& rate) const;

  const Machine& machine_;
  std::vector<ActiveEffect> effects_;
  Vector state_{};
  Point point_;
  int used_ = kBase;
  double heat_factor_ = 1.0, winding_time_s_, tool_time_s_;
};

}  // namespace blind
