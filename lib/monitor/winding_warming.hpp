#pragma once
#include "lib/plant/machine_parameters.hpp"

namespace morepro {

/// How the square of the current warms a winding that has no sensor: one heat capacity.
class WindingWarming {
 public:
  /// rate_hz > 0. A winding whose time constant is not known stays as it is.
  [[gnu::noinline, gnu::cold]] WindingWarming(const MachineParameters::Spindle& spindle, double rate_hz) {
    const auto steps = static_cast<float>(spindle.winding_time_constant_s) * static_cast<float>(rate_hz);
    if (!(steps > 1.0F)) return;
    share_ = 1.0F / steps;
    rise_k_a2_ = static_cast<float>(spindle.winding_rise_k_a2);
  }

  /// One interval that this current lasts through. With what rounding leaves: a step of minutes in samples is
  /// less than the last bit of the sum (Kahan).
  void step(float current_a) {
    const float change_k = share_ * (rise_k_a2_ * current_a * current_a - rise_k_) - too_much_k_;
    const float sum_k = rise_k_ + change_k;
    too_much_k_ = (sum_k - rise_k_) - change_k;
    rise_k_ = sum_k;
  }

  [[nodiscard]] float winding_degc() const { return kDatasheetDegc + rise_k_; }

 private:
  static constexpr float kDatasheetDegc = 25.0F;  ///< at which the datasheet is valid, and a winding begins

  float share_ = 0.0F;
  float rise_k_a2_ = 0.0F;
  float rise_k_ = 0.0F;
  float too_much_k_ = 0.0F;  ///< of it, by rounding
};

}  // namespace morepro
