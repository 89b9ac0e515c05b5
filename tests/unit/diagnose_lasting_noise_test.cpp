// Random loads and a supply's ripple that last for a millisecond, in closed loop, and a datasheet 20 % off:
// the values that are stated are as far off as is stated.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "sim_host/identify/machine_value.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::ProfileKind;

double true_value(const std::string& name) {
  const MachineParameters machine = reference_machine();
  for (std::size_t i = 0; i < host::kMachineValueCount; ++i) {
    const auto value = static_cast<host::MachineValue>(i);
    if (host::name_of(value) == name) return host::value_in(machine, value);
  }
  ADD_FAILURE() << "no such value: " << name;
  return 0.0;
}

/// Deviations of the refitted values, in standard errors, over all seeds.
class LastingNoise : public testing::TestWithParam<ProfileKind> {};

TEST_P(LastingNoise, IsInTheStandardErrors) {
  constexpr int kSeeds = 6;
  std::map<std::string, double> squares;
  double sum = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto result =
        diagnosed(record({.duration_s = 6.0, .seed = seed, .profile = GetParam(), .process_noise = 1.0}),
                  datasheet(0.2));
    for (const host::ParameterResult& value : result.parameters) {
      const double z = (value.refit - true_value(value.name)) / value.standard_error;
      squares[value.name] += z * z / kSeeds;
      sum += z * z;
      count += 1.0;
    }
  }
  // Nine values that partly go together, six seeds: a mean square of 1 spreads by about 0.3, one value's by
  // 0.6. What is left of the bias where nothing but noise moves the axis is of a standard error's size.
  // Without the past's weights fitted along, the mean was 17 in production and the mass's 50.
  RecordProperty("mean_square", std::to_string(sum / count));
  EXPECT_LT(sum / count, 2.0);
  for (const auto& [name, square] : squares) EXPECT_LT(square, 5.0) << name;
}

// What it bends the values by makes a recording likelier: 5 of 8 machines like their datasheet in production
// were a "parameter_error" (tests/blind).
TEST(LastingNoiseOfARightMachine, IsNoWrongDatasheet) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto result = diagnosed(
        record({.duration_s = 6.0, .seed = seed, .profile = ProfileKind::kProduction, .process_noise = 1.0}),
        datasheet(0.0));
    EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << "seed " << seed << ": " << said(result);
  }
}

std::string name_of(const testing::TestParamInfo<ProfileKind>& profile) {
  return profile.param == ProfileKind::kRich ? "Rich" : "Production";
}

// The last fit, beside the noise, was in the machine file alone; what was told was the one before it.
TEST(SizesBesideLastingNoise, AreThoseOfTheMachineFile) {
  const auto signals = record({.effects = {effect(Effect::kFeedCoulombFriction, 8.0)}, .process_noise = 1.0});
  MachineDescription with_effects;
  const host::DiagnosisOptions options{.bootstrap_runs = 0, .excluded = {}};
  const auto result = host::diagnose(signals, datasheet(0.1), options, with_effects);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  ASSERT_EQ(with_effects.effects.size(), 1U);
  EXPECT_DOUBLE_EQ(result.which.front().magnitude, with_effects.effects.front().coefficient[0]);
}

INSTANTIATE_TEST_SUITE_P(Profiles, LastingNoise,
                         testing::Values(ProfileKind::kRich, ProfileKind::kProduction), name_of);

}  // namespace
}  // namespace morepro::diagnose_test
