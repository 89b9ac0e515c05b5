#include <bit>
#include <cstdint>

#include "lib/math/elementary.hpp"
#include "lib/math/matrix_exponential.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/integrators.hpp"
#include "tests/support/bit_hash.hpp"
#include "tests/support/check.hpp"

namespace morepro {
namespace {

using test::BitHash;

/// Every bit pattern of a float: numbers of all sizes, infinities, NaN.
class Patterns {
 public:
  float next_pattern() { return std::bit_cast<float>(next()); }
  /// In [low, high).
  float next_between(float low, float high) {
    return low + (high - low) * (static_cast<float>(next() >> 8) * 0x1.0p-24F);
  }

 private:
  std::uint32_t next() { return state_ = state_ * 1664525U + 1013904223U; }
  std::uint32_t state_ = 1;
};

constexpr int kPatterns = 20000;

// The five numbers below are the same on x86-64, Cortex-M4F, aarch64, riscv64 and s390x. Where one differs,
// the compiler contracted, reordered or replaced an operation.
TEST(Bits, ElementaryFunctionsAreTheSameOnEveryMachine) {
  BitHash hash;
  Patterns patterns;
  for (int k = 0; k < kPatterns; ++k) {
    const float x = patterns.next_pattern();
    const float y = patterns.next_between(-2.0F, 2.0F);
    hash.add(math::exp(patterns.next_between(-90.0F, 90.0F)));
    hash.add(math::exp(x));
    hash.add(math::exp2(x));
    hash.add(math::log(x));
    hash.add(math::tanh(x));
    hash.add(math::tanh(patterns.next_between(-10.0F, 10.0F)));
    hash.add(math::pow(x, y));
    hash.add(math::pow(patterns.next_between(0.0F, 1000.0F), y));
  }
  EXPECT_EQ(hash.value(), 0xBEA3C3BDU);
}

TEST(Bits, TrigonometryIsTheSameOnEveryMachine) {
  BitHash hash;
  Patterns patterns;
  for (int k = 0; k < kPatterns; ++k) {
    for (const float x : {patterns.next_pattern(), patterns.next_between(-1.0e5F, 1.0e5F),
                          patterns.next_between(-4.0F, 4.0F)}) {
      const auto [sin, cos] = math::sin_cos(x);
      hash.add(sin);
      hash.add(cos);
      hash.add(math::atan2(x, sin));
    }
  }
  EXPECT_EQ(hash.value(), 0x8DF48581U);
}

TEST(Bits, MatrixExponentialIsTheSameOnEveryMachine) {
  BitHash hash;
  Patterns patterns;
  for (int k = 0; k < 500; ++k) {
    const math::Matrix2 a{
        double{patterns.next_between(-9e3F, 0.0F)}, double{patterns.next_between(-2e3F, 2e3F)},
        double{patterns.next_between(-2e3F, 2e3F)}, double{patterns.next_between(-9e3F, 0.0F)}};
    const math::ExponentialStep2 step = math::exponential_step(a, 1.0e-4);
    for (const double x : {step.exp.a00, step.exp.a01, step.integral.a10, step.integral.a11}) hash.add(x);
  }
  EXPECT_EQ(hash.value(), 0x0A05FFCFU);
}

template <class Integrator>
std::uint32_t hash_of_run(const MachineParameters& machine) {
  const Integrator integrator(machine, 1.0e-4);
  PlantState<float> x;
  BitHash hash;
  Patterns patterns;
  for (int k = 0; k < 2000; ++k) {
    x = integrator.step(x, {.armature_voltage_v = patterns.next_between(30.0F, 60.0F),
                            .feed_force_n = patterns.next_between(5.0F, 30.0F),
                            .contact = k % 400 < 200 ? 1.0F : 0.0F,
                            .chip_load_mm = static_cast<float>(machine.tool.chip_load_mm),
                            .tool_temperature_degc = patterns.next_between(350.0F, 600.0F)});
    for (const float value : {x.speed_rad_s, x.feed_speed_m_s, x.current_a}) hash.add(value);
  }
  return hash.value();
}

TEST(Bits, PlantIsTheSameOnEveryMachine) {
  EXPECT_EQ(hash_of_run<ExponentialIntegrator<float>>(reference_machine()), 0x1BDA3B4CU);
  EXPECT_EQ(hash_of_run<Rk4Integrator<float>>(thesis_machine()), 0x112D0126U);
}

}  // namespace
}  // namespace morepro
