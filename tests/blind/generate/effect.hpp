#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "machine.hpp"
#include "random.hpp"

namespace blind {

/// Length of one integration step.
inline constexpr double kStep_s = 1e-5;

enum Balance { kSpindleTorque, kFeedForce, kArmatureVoltage, kBalances };

/// Inputs held from one sample to the next.
struct Inputs {
  double voltage_v = 0.0, force_n = 0.0, contact = 0.0, engagement = 1.0, chip_load_mm = 0.05;
};

/// The machine at one instant, as the laws of the effects see it.
struct Point {
  const Machine& machine;
  Inputs in;
  double t = 0.0, w = 0.0, v = 0.0, i = 0.0, angle = 0.0, x = 0.0;
  double tool_c = 20.0, slow_heat_k = 0.0, fast_heat_k = 0.0;
  double cut_s = 0.0;           ///< time in contact since the effect that looks has set in
  double contact_torque = 0.0;  ///< nominal law, N m, before the switch `in.contact`
  double speed_rate = 0.0, feed_rate = 0.0, current_rate = 0.0;

  double winding_c() const { return 25.0 + slow_heat_k + fast_heat_k; }
  /// The hottest place of the winding: not the one that the sensor sees.
  double hot_spot_c() const { return 25.0 + 0.85 * slow_heat_k + 1.4 * fast_heat_k; }
};

/// What an effect may change in the balances. Factors are relative to the machine's values.
struct Loads {
  double torque_nm = 0.0, force_n = 0.0, voltage_v = 0.0;
  double torque_constant = 1.0, back_emf = 1.0, resistance = 1.0, inductance = 1.0, viscous = 1.0,
         inertia = 1.0;
  double mass = 1.0;
  double shaft_contact = 1.0, feed_contact = 1.0, feed_viscous = 1.0;
  double applied_voltage_v = 0.0, applied_force_n = 0.0;
};

/// What the sensors deliver before noise and steps.
struct Reading {
  double w = 0.0, v = 0.0, i = 0.0, angle = 0.0, x = 0.0;
  double w_step = 0.0, i_step = 0.0;  ///< of the converter, where it is coarser than the sensor's last bit
};

/// One difference between machine and model. `strength` is chosen by the sizing; 0 must mean no difference.
class Effect {
 public:
  virtual ~Effect() = default;
  virtual int states() const { return 0; }
  virtual void act(const Point&, const double*, Loads&) const {}
  virtual void flow(const Point&, const double*, double*) const {}
  /// Sensors with a memory see the machine at every integration step.
  virtual void track(const Point&, double) {}
  virtual void read(const Point&, Reading&) {}
  /// The whole frame is the previous one again.
  virtual bool repeats_frame() { return false; }
  /// The row is not in the recording.
  virtual bool drops_row() { return false; }

  double strength = 0.0;
};

/// How to make one effect and what its strength means.
struct EffectKind {
  std::string name;
  Balance balance = kSpindleTorque;
  std::string unit;
  std::function<double(const Machine&)> guess;  ///< a plausible strength
  std::function<std::unique_ptr<Effect>(Random&, const Machine&)> make;
  double limit = 15.0;      ///< largest strength in guesses before it is absurd
  bool is_inverse = false;  ///< the magnitude of the contract is 1/strength
  bool may_start_late = true;
};

const std::vector<EffectKind>& catalogue_effects();
const std::vector<EffectKind>& unknown_structures();

/// Shared shapes.
double soft_sign(double value, double scale);
/// A pulse per tooth, without its mean; `phase` in teeth times angle.
double pulse(double phase, int sharpness);

}  // namespace blind
