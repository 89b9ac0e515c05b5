#include "lib/identification/derivative_parameter_filter.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "tests/target/count/count.hpp"

namespace morepro::count {
namespace {

DerivativeInput<float> input{577.7F, 0.02F, 2.2F, 48.0F, 26.0F, 1.0F, 1.0F, 0.1F};
DerivativeMeasurement<float> derivatives{100.0F, 0.1F, 900.0F, 4.0e4F, 0.09F, 4.0e6F};

DerivativeParameterFilter<float> filter(reference_machine(), 0.3F);

void measure() {
  keep(filter);
  static std::uint32_t random = 1;
  random = random * 1664525U + 1013904223U;
  const float noise = static_cast<float>(static_cast<std::int32_t>(random)) * 8.0e-10F;
  input.current_a = 2.2F + 0.5F * noise;
  input.feed_force_n = 26.0F + 4.0F * noise;
  derivatives.acceleration_rad_s2 = 3000.0F * noise;
}

/// The torque of the contact is an argument: the monitor's bank has it anyway.
[[gnu::flatten]] void step_derivatives() { filter.step(input, derivatives); }

const Entry kDerivatives{"derivative_parameter_step", 1, measure, step_derivatives};

}  // namespace
}  // namespace morepro::count
