// Compliant shafts as machines have them: damped somehow, with the cut at the far end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

/// J2 = 1.2 J1, a resonance of 160 Hz.
gap::AppliedEffect shaft(std::uint8_t damping, double cut) {
  return {.form = {.effect = Effect::kShaftCompliance, .kind = damping, .parts = 2, .shape = 160.0F},
          .coefficient = {1.2, cut}};
}

class Shafts : public testing::TestWithParam<gap::AppliedEffect> {};

// Six seeds of each are within 0.4 % of the stiffness and 0.08 % of the inertia. With a resonance that was
// half a percent off the stiffness was 3 % off and the inertia 0.8 %, at ten standard errors. With the cut at
// the motor's end and a damping ratio of 0.05 whatever it is, friction of a tenth per degree of the tool
// stood beside the shaft at 96 %, and an inertia 4 % off.
TEST_P(Shafts, AreOneCauseAndLeaveTheParametersAlone) {
  const auto result = diagnosed(record({.effects = {GetParam()}, .duration_s = 4.0}), datasheet(0.15));
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kShaftCompliance);
  const auto& machine = reference_machine();
  const double stiffness = gap::size_of(GetParam(), gap::EffectScales<double>(machine, {}));
  EXPECT_NEAR(result.which.front().magnitude, stiffness, 0.01 * stiffness);
  const auto inertia = std::find_if(result.parameters.begin(), result.parameters.end(),
                                    [](const auto& p) { return p.name == "inertia_kgm2"; });
  ASSERT_NE(inertia, result.parameters.end());
  EXPECT_NEAR(inertia->refit, machine.spindle.inertia_kgm2, 0.002 * machine.spindle.inertia_kgm2);
}

// A resonance that hardly anything damps is seen near its frequency alone: between those that are tried it
// was structure without a name.
TEST(LightlyDampedShaft, IsFoundBetweenTheFrequenciesThatAreTried) {
  for (const auto& [frequency_hz, ratio] : {std::pair{85.0F, 0.1}, std::pair{175.0F, 0.3}}) {
    const gap::AppliedEffect light{
        .form = {.effect = Effect::kShaftCompliance, .kind = 2, .parts = 2, .shape = frequency_hz},
        .coefficient = {ratio, 1.0 + ratio}};
    const auto result = diagnosed(record({.effects = {light}, .duration_s = 4.0}), datasheet(0.0));
    EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result) << " at " << frequency_hz;
    ASSERT_EQ(result.which.size(), 1U) << said(result) << " at " << frequency_hz;
    EXPECT_EQ(result.which.front().effect, Effect::kShaftCompliance);
    const double stiffness = gap::size_of(light, gap::EffectScales<double>(reference_machine(), {}));
    EXPECT_NEAR(result.which.front().magnitude, stiffness, 0.01 * stiffness);
  }
}

// In a production nothing but the cut makes a shaft swing, at its far end. The motor's end, which turns
// evenly, shows nothing of it: what the cut does there passed for random forces, "no_gap" in seven of seven
// of another simulator's. The third one seemed to set in with the first cut, which it had lost then:
// "unexplained".
TEST(ShaftOfAProduction, IsSeenByWhatTheCutDoesAtItsFarEnd) {
  struct Case {
    std::uint8_t damping;
    float frequency_hz;
    double ratio;
    double noise_rad_s;
  };
  for (const Case& one : {Case{0, 45.0F, 0.6, 1.0}, Case{0, 100.0F, 0.4, 1.0}, Case{6, 150.0F, 0.6, 0.1}}) {
    const gap::AppliedEffect shaft{.form = {.effect = Effect::kShaftCompliance,
                                            .kind = one.damping,
                                            .parts = 2,
                                            .shape = one.frequency_hz},
                                   .coefficient = {one.ratio, 1.0 + one.ratio}};
    SimulatedRun run{.effects = {shaft}, .duration_s = 6.0, .profile = host::ProfileKind::kProduction};
    run.configuration.sensors[Channel::kSpindleSpeed].noise = one.noise_rad_s;
    MachineDescription sheet = datasheet(0.0);
    sheet.configuration.sensors = run.configuration.sensors;
    const auto result = diagnosed(record(run), sheet);
    EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result) << " at " << one.frequency_hz;
    ASSERT_EQ(result.which.size(), 1U) << said(result) << " at " << one.frequency_hz;
    const auto& found = result.which.front();
    EXPECT_EQ(found.effect, Effect::kShaftCompliance);
    const double stiffness = gap::size_of(shaft, gap::EffectScales<double>(reference_machine(), {}));
    EXPECT_LT(found.standard_error, 0.1 * stiffness) << one.frequency_hz;
    EXPECT_NEAR(found.magnitude, stiffness, std::max(0.02 * stiffness, 3.0 * found.standard_error));
  }
}

std::string name_of_shaft(const testing::TestParamInfo<gap::AppliedEffect>& one) {
  return "Kind" + std::to_string(one.param.form.kind) +
         (one.param.coefficient[1] > 0.0 ? "FarCut" : "NearCut");
}

INSTANTIATE_TEST_SUITE_P(Damped, Shafts,
                         testing::Values(shaft(0, 0.0), shaft(0, 2.2), shaft(2, 2.2), shaft(3, 2.2)),
                         name_of_shaft);

}  // namespace
}  // namespace morepro::diagnose_test
