#include <cstdint>

#include "lib/identification/derivative_parameter_filter.hpp"
#include "lib/math/register_copy.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "tests/support/bit_hash.hpp"
#include "tests/support/check.hpp"

namespace morepro {
namespace {

// The hash holds for x86, ARM, RISC-V and s390x alike; on a Cortex-M it goes through load and store of
// several registers.

template <class T>
bool comes_back(T& memory, const T& value) {
  math::store(memory, value);
  return math::loaded(memory) == value;
}

TEST(RegisterCopy, BringsEveryNumberBack) {
  std::array<float, 5> five{};
  std::array<float, 9> nine{};
  std::array<float, 4> four{};
  EXPECT_TRUE(comes_back(five, {1.0F, -2.0F, 3.0F, -4.0F, 5.0F}));
  EXPECT_TRUE(comes_back(nine, {1.0F, -2.0F, 3.0F, -4.0F, 5.0F, -6.0F, 7.0F, -8.0F, 9.0F}));
  EXPECT_TRUE(comes_back(four, {1.0F, -2.0F, 3.0F, -4.0F}));
  // What the compiler itself reads of it is what was stored.
  EXPECT_TRUE(five[4] == 5.0F && nine[8] == 9.0F);
}

TEST(DerivativeParameterFilter, HasTheSameBitsEverywhere) {
  DerivativeParameterFilter<float> filter(reference_machine(), 0.3F);
  std::uint32_t random = 1;
  const auto noise = [&random] {
    random = random * 1664525U + 1013904223U;
    return static_cast<float>(static_cast<std::int32_t>(random)) * 4.6566129e-10F;
  };
  test::BitHash hash;
  for (int k = 0; k < 300; ++k) {
    // Every hundredth derivative is absurd: a divisor would leave what is positive.
    const float wild = k % 100 == 99 ? 1.0e4F : 1.0F;
    const float contact = k > 100 ? 1.0F : 0.0F;
    const DerivativeInput<float> input{
        400.0F + 100.0F * noise(), 0.02F * noise(), 2.0F + noise(), 48.0F,
        26.0F + 4.0F * noise(),    contact,         1.0F,           0.1F * contact};
    filter.step(input,
                {3000.0F * wild * noise(), noise() * wild, 9000.0F * wild * noise(), 4.0e4F, 0.09F, 4.0e6F});
    for (std::size_t j = 0; j < kParameterCount; ++j) {
      const auto parameter = static_cast<Parameter>(j);
      hash.add(filter.value(parameter));
      hash.add(filter.covariance(parameter, Parameter::kInertia));
      hash.add(filter.covariance(parameter, parameter));
    }
  }
  EXPECT_TRUE(filter.value(Parameter::kInertia) > 0.0F && filter.value(Parameter::kMass) > 0.0F &&
              filter.value(Parameter::kInductance) > 0.0F);
  EXPECT_EQ(hash.value(), 3725057809U);
}

}  // namespace
}  // namespace morepro
