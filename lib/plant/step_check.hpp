#pragma once
#include <cstdint>

#include "lib/math/matrix_exponential.hpp"
#include "lib/plant/dynamics.hpp"

namespace morepro {

/// May an integrator run with this machine and this step?
enum class StepStatus : std::uint8_t {
  kOk = 0,
  kNotPositive = 1,  ///< the step is not between 0 and 1 s
  kUnstable = 2,     ///< the step is too long for the machine's fastest mode: shorten it
};

/// Largest h |lambda| that RK4 is let run with. Its stability ends at 2.785 on the negative real axis; the
/// margin pays for the contact law's slope between the speeds that are checked.
inline constexpr double kRk4Limit = 2.5;

/// Are both eigenvalues of a smaller than bound in magnitude? The criterion of Jury, without the eigenvalues
/// and hence without a root. False where an entry is not finite.
template <class Real>
constexpr bool is_spectral_radius_below(const math::BasicMatrix2<Real>& a, Real bound) {
  const Real trace = (a.a00 + a.a11) / bound;
  const Real determinant = (a.a00 * a.a11 - a.a01 * a.a10) / (bound * bound);
  return determinant < Real(1) && math::abs(trace) < Real(1) + determinant;
}

/// Checks h |lambda| < kRk4Limit for the free machine and in contact, at rest and at every power of two of
/// speed up to 8192 rad/s, and for the feed axis. In float, so that a board refuses what a PC refuses.
inline StepStatus check_rk4_step(const MachineParameters& machine, double step_s) {
  if (!(step_s > 0.0) || !(step_s < 1.0)) return StepStatus::kNotPositive;
  const Plant<float> plant(machine);
  const float bound = static_cast<float>(kRk4Limit / step_s);
  PlantInput<float> input{.chip_load_mm = static_cast<float>(machine.tool.chip_load_mm),
                          .tool_temperature_degc = static_cast<float>(machine.thermal.tool_degc)};
  const auto is_stable = [&](float speed) {
    return is_spectral_radius_below(plant.spindle_jacobian({.speed_rad_s = speed}, input), bound);
  };
  bool is_all_stable = is_stable(0.0F) && math::abs(plant.feed_rate()) < bound;
  input.contact = 1.0F;
  for (float speed = 0.0F; speed <= 8192.0F; speed = speed > 0.0F ? 2.0F * speed : 1.0F) {
    is_all_stable = is_all_stable && is_stable(speed);
  }
  return is_all_stable ? StepStatus::kOk : StepStatus::kUnstable;
}

}  // namespace morepro
