#include <gtest/gtest.h>

#include <cmath>

#include "sim_host/diagnose/search/newest_effect.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using diagnose_test::datasheet;
using diagnose_test::diagnosed;
using diagnose_test::effect;
using diagnose_test::record;
using diagnose_test::said;
using gap::Effect;

gap::AppliedEffect bent(Effect name, double size, double bend) {
  gap::AppliedEffect one = effect(name, size);
  one.form.parts = 2;
  one.coefficient[1] = bend;
  return one;
}

struct Law {
  Effect effect;
  double size;
  double bend;
};

class BentLaw : public testing::TestWithParam<Law> {};

// A machine whose exponents are not the catalogue's: before, what the plain law left of it was named as a
// second effect. The bend of this size is as large as the law itself within what the recording shows.
TEST_P(BentLaw, IsOneEffectWithItsBend) {
  const auto& [name, size, bend] = GetParam();
  DiagnosisOptions options;
  options.bootstrap_runs = 0;
  MachineDescription with_effects;
  const DiagnosisResult result = diagnose(record({.effects = {bent(name, size, bend)}, .duration_s = 5.0}),
                                          datasheet(0.1), options, with_effects);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  const EffectResult& found = result.which.front();
  EXPECT_EQ(found.effect, name) << said(result);
  // Four standard errors: once in 16,000 by chance.
  EXPECT_NEAR(found.magnitude, size, 4.0 * found.standard_error);
  ASSERT_EQ(with_effects.effects.size(), 1U);
  ASSERT_EQ(with_effects.effects.front().form.parts, 2);
  EXPECT_NEAR(with_effects.effects.front().coefficient[1], bend, 0.2 * std::fabs(bend));
}

TEST_P(BentLaw, StaysPlainWhereTheMachinesIs) {
  const auto& [name, size, bend] = GetParam();
  const DiagnosisResult result =
      diagnosed(record({.effects = {effect(name, size)}, .duration_s = 5.0}), datasheet(0.1));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, name) << said(result);
  EXPECT_EQ(result.which.front().applied.form.parts, 1);
}

INSTANTIATE_TEST_SUITE_P(Laws, BentLaw,
                         testing::Values(Law{Effect::kContactTemperatureDependence, 0.2, 0.2},
                                         Law{Effect::kSpindleWindage, 2.0e-8, 4.0e-8},
                                         Law{Effect::kFeedForceSaturation, 2.0e-5, 1.0e-8}),
                         [](const auto& param) { return std::string(gap::name_of(param.param.effect)); });

TEST(Bends, OfFrictionStayNearThePlainLaw) {
  gap::AppliedEffect friction{.form = {.effect = gap::Effect::kFeedAsymmetricFriction, .parts = 2}};
  const auto is_too_far = [&friction](double share) {
    friction.coefficient = {-2.0, share * -2.0};
    return bends_too_far(friction, 0.15, 0.01);
  };
  EXPECT_FALSE(is_too_far(0.0));
  EXPECT_FALSE(is_too_far(0.06));
  EXPECT_FALSE(is_too_far(-0.03));
  EXPECT_TRUE(is_too_far(-0.05));
  EXPECT_TRUE(is_too_far(0.3));
  friction.form.parts = 1;
  EXPECT_FALSE(is_too_far(-0.05));
}

}  // namespace
}  // namespace morepro::host
