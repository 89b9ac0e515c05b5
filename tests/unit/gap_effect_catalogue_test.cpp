#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "lib/gap/effect_catalogue.hpp"

namespace morepro::gap {
namespace {

// The names that recordings, machine files and scripts of users hold.
constexpr std::string_view kNames =
    "spindle_coulomb_friction spindle_stribeck_friction spindle_windage spindle_cogging tooth_passing_torque "
    "contact_speed_dependence contact_chip_load_dependence contact_temperature_dependence tool_wear_ramp "
    "viscous_temperature_dependence torque_constant_saturation shaft_compliance "
    "feed_coulomb_friction feed_viscous_friction feed_stribeck_friction feed_asymmetric_friction "
    "feed_force_offset feed_screw_periodic feed_cutting_speed_dependence feed_tooth_passing_force "
    "feed_spring "
    "feed_contact_drift feed_force_saturation feed_drive_lag feed_backlash feed_presliding "
    "brush_voltage_drop resistance_temperature_drift inductance_saturation supply_voltage_offset drive_lag "
    "armature_reaction magnet_temperature_drift "
    "spindle_speed_bias current_bias spindle_speed_delay current_delay feed_speed_delay "
    "spindle_speed_bandwidth current_bandwidth encoder_eccentricity current_nonlinearity sensor_quantization "
    "clock_jitter sample_dropout";

TEST(EffectCatalogue, HoldsTheAgreedNamesInTheirOrder) {
  std::string names;
  for (const EffectInfo& info : kEffects) {
    if (!names.empty()) names += ' ';
    names += info.name;
  }
  EXPECT_EQ(names, kNames);
}

TEST(EffectCatalogue, FindsEveryEffectByItsNameAndNothingElse) {
  for (const EffectInfo& info : kEffects) EXPECT_EQ(effect_named(info.name), info.effect);
  EXPECT_FALSE(effect_named("spindle_coulomb"));
  EXPECT_FALSE(effect_named(""));
}

TEST(EffectCatalogue, EveryBalanceHasTheNameOfItsGroup) {
  EXPECT_EQ(name_of(EffectGroup::kSpindleTorque), name_of(Balance::kSpindleTorque));
  EXPECT_EQ(name_of(EffectGroup::kFeedForce), name_of(Balance::kFeedForce));
  EXPECT_EQ(name_of(EffectGroup::kArmatureVoltage), name_of(Balance::kArmatureVoltage));
}

TEST(EffectCatalogue, EveryRowSaysWhatAnEngineerNeeds) {
  for (const EffectInfo& info : kEffects) {
    EXPECT_FALSE(info.unit.empty()) << info.name;
    EXPECT_FALSE(info.excitation.empty()) << info.name;
    EXPECT_EQ(info.separate_by.back(), '.') << info.name;
    EXPECT_FALSE(info.equation.empty()) << info.name;
  }
}

TEST(EffectCatalogue, KnowsThePairsThatThePrototypeConfused) {
  const auto is_pair = [](Effect a, Effect b) { return info_of(a).aliases.contains(b); };
  EXPECT_TRUE(is_pair(Effect::kSupplyVoltageOffset, Effect::kSpindleSpeedBias));
  EXPECT_TRUE(is_pair(Effect::kCurrentDelay, Effect::kCurrentBandwidth));
  EXPECT_TRUE(is_pair(Effect::kCurrentDelay, Effect::kDriveLag));
  EXPECT_TRUE(is_pair(Effect::kSpindleSpeedDelay, Effect::kSpindleSpeedBandwidth));
  EXPECT_TRUE(is_pair(Effect::kFeedCoulombFriction, Effect::kFeedStribeckFriction));
  EXPECT_FALSE(is_pair(Effect::kFeedCoulombFriction, Effect::kFeedForceOffset));
  EXPECT_EQ(info_of(Effect::kBrushVoltageDrop).also_known, "inverter dead time");
}

}  // namespace
}  // namespace morepro::gap
