// Which of the names of an axis are causes of their own.
#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>
#include <vector>

#include "lib/gap/effect_size.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/outcome/causes.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"

namespace morepro::host {
namespace {

using gap::Effect;
using Effects = std::vector<Effect>;

std::size_t causes(std::initializer_list<Effect> effects) {
  std::vector<Finding> found;
  for (const Effect effect : effects) found.emplace_back().effect.form.effect = effect;
  return causes_of(found);
}

TEST(Causes, AreCountedOneByOne) {
  EXPECT_EQ(causes({}), 0U);
  EXPECT_EQ(causes({Effect::kFeedSpring}), 1U);
  EXPECT_EQ(causes({Effect::kSpindleWindage, Effect::kDriveLag, Effect::kCurrentBias}), 3U);
}

// What a slide's friction is made of is named in parts and is one cause.
TEST(Causes, OfFrictionAreOne) {
  EXPECT_EQ(causes({Effect::kFeedCoulombFriction, Effect::kFeedForceOffset, Effect::kFeedAsymmetricFriction}),
            1U);
  EXPECT_EQ(causes({Effect::kFeedCoulombFriction, Effect::kFeedForceOffset, Effect::kFeedSpring}), 2U);
}

bool may_be_one(Effect first, double evidence, Effect second, double of_second, bool has_third = false) {
  std::vector<Finding> found(has_third ? 3 : 2);
  found[0].effect.form.effect = first;
  found[0].evidence = evidence;
  found[1].effect.form.effect = second;
  found[1].evidence = of_second;
  if (has_third) found[2].effect.form.effect = Effect::kFeedContactDrift;
  return may_be_one_cause(found);
}

// What a shape that is not quite the machine's leaves is weak and slow.
TEST(Causes, OfWhichOneIsAWeakSlowLawMayBeOne) {
  EXPECT_TRUE(may_be_one(Effect::kFeedForceOffset, 1000.0, Effect::kFeedSpring, 300.0));
  EXPECT_TRUE(may_be_one(Effect::kFeedSpring, 300.0, Effect::kFeedForceOffset, 1000.0));
  EXPECT_FALSE(may_be_one(Effect::kFeedForceOffset, 1000.0, Effect::kFeedSpring, 400.0));
  EXPECT_FALSE(may_be_one(Effect::kFeedForceOffset, 1000.0, Effect::kFeedSpring, 300.0, true)) << "three";
  EXPECT_FALSE(may_be_one(Effect::kFeedForceOffset, 1000.0, Effect::kFeedCoulombFriction, 300.0)) << "parts";
  for (const Effect unlike :
       {Effect::kFeedDriveLag, Effect::kFeedScrewPeriodic, Effect::kFeedBacklash,
        Effect::kFeedToothPassingForce, Effect::kShaftCompliance, Effect::kSpindleCogging})
    EXPECT_FALSE(may_be_one(Effect::kFeedSpring, 1000.0, unlike, 300.0)) << gap::name_of(unlike);
}

// A drop at the brushes leaves nothing of its shape in the torque.
TEST(Causes, OfWhichOneBrakesTheSpindleAreTwo) {
  EXPECT_FALSE(may_be_one(Effect::kBrushVoltageDrop, 1000.0, Effect::kSpindleCoulombFriction, 50.0));
  EXPECT_FALSE(may_be_one(Effect::kSpindleWindage, 50.0, Effect::kCurrentBias, 1000.0));
  EXPECT_TRUE(may_be_one(Effect::kSpindleStribeckFriction, 1000.0, Effect::kSpindleWindage, 50.0));
  EXPECT_TRUE(may_be_one(Effect::kMagnetTemperatureDrift, 1000.0, Effect::kResistanceTemperatureDrift, 50.0));
}

/// A finding of this size in the unit of the catalogue.
Finding found_as(Effect effect, double size) {
  Finding finding;
  finding.effect = gap::applied(effect, size, {});
  return finding;
}

/// What the second of two effects gives its shape to.
std::optional<std::size_t> shaped_by_second(Effect first, double size, Effect second, double other) {
  return shaped_by(std::vector{found_as(first, size), found_as(second, other)}, 1);
}

TEST(Causes, ADelayBesideALagIsItsSecondPole) {
  EXPECT_EQ(shaped_by_second(Effect::kCurrentBandwidth, 2.0e-4, Effect::kCurrentDelay, 1.0e-4), 0U);
  EXPECT_EQ(shaped_by_second(Effect::kDriveLag, 2.0e-4, Effect::kCurrentBandwidth, 1.0e-4), 0U);
  EXPECT_FALSE(shaped_by_second(Effect::kCurrentBandwidth, 2.0e-4, Effect::kCurrentDelay, 1.6e-4));
  EXPECT_FALSE(shaped_by_second(Effect::kCurrentBandwidth, 2.0e-4, Effect::kSpindleSpeedDelay, 1.0e-4));
}

TEST(Causes, ALagOfBothSensorsIsAPoleOfTheDrive) {
  std::vector found{found_as(Effect::kDriveLag, 4.0e-4), found_as(Effect::kCurrentBandwidth, 6.5e-4),
                    found_as(Effect::kSpindleSpeedBandwidth, 6.4e-4)};
  EXPECT_EQ(shaped_by(found, 1), 0U);
  EXPECT_EQ(shaped_by(found, 2), 1U);
  EXPECT_EQ(causes_of(found), 1U);
  found[2] = found_as(Effect::kSpindleSpeedBandwidth, 5.0e-4);
  EXPECT_EQ(causes_of(found), 3U);
  found[2] = found[0];
  found[0] = found_as(Effect::kSpindleSpeedBandwidth, 6.4e-4);
  found.pop_back();
  EXPECT_EQ(causes_of(found), 2U);
}

TEST(Causes, ALittleFrictionAtRestIsTheShapeOfFriction) {
  EXPECT_EQ(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedStribeckFriction, -0.6), 0U);
  EXPECT_FALSE(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedStribeckFriction, 2.0));
  EXPECT_EQ(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedPresliding, 0.2), 0U);
  EXPECT_EQ(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedPresliding, 2.9), 0U);
  EXPECT_FALSE(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedPresliding, 3.1));
  EXPECT_FALSE(shaped_by_second(Effect::kFeedAsymmetricFriction, 5.0, Effect::kFeedForceOffset, 0.3));
}

TEST(Causes, ALittleForceBesideABentFrictionIsItsShape) {
  std::vector found{found_as(Effect::kFeedAsymmetricFriction, 5.0), found_as(Effect::kFeedForceOffset, 0.3)};
  found[0].effect.form.parts = 2;
  EXPECT_EQ(shaped_by(found, 1), 0U);
  found[1].effect.coefficient[0] = -1.0;
  EXPECT_FALSE(shaped_by(found, 1));
}

TEST(Causes, AForceOfTheSenseOfAFrictionIsItsDryPart) {
  std::vector found{found_as(Effect::kFeedAsymmetricFriction, 5.0), found_as(Effect::kFeedForceOffset, 8.0)};
  found[0].evidence = 2000.0;
  found[1].evidence = 1000.0;
  EXPECT_EQ(shaped_by(found, 1), 0U);
  found[1].effect.coefficient[0] = -8.0;
  EXPECT_FALSE(shaped_by(found, 1));
  found[1] = found_as(Effect::kFeedForceOffset, 8.0);
  found[1].evidence = 3000.0;
  EXPECT_FALSE(shaped_by(found, 1));
  found[1].evidence = 1000.0;
  found.push_back(found_as(Effect::kFeedCoulombFriction, 1.0));
  EXPECT_FALSE(shaped_by(found, 1));
}

TEST(Causes, WhatGivesAShapeIsNone) {
  const std::vector found{found_as(Effect::kSpindleSpeedBandwidth, 1.0e-3),
                          found_as(Effect::kSpindleSpeedDelay, 1.0e-4),
                          found_as(Effect::kSpindleWindage, 1.0e-6)};
  EXPECT_EQ(causes_of(found), 2U);
  EXPECT_TRUE(is_cause_of_its_own(found, 0));
  EXPECT_FALSE(is_cause_of_its_own(found, 1));
}

TEST(Causes, NeedMoreBesideOneWhoseShapeTheyMayBe) {
  const auto share = [](Effect effect, Effect beside) { return least_share(effect, beside, kLeastShare); };
  EXPECT_EQ(share(Effect::kSpindleWindage, Effect::kCurrentBias), kLeastShare);
  EXPECT_GE(share(Effect::kDriveLag, Effect::kCurrentDelay), kLeastShare);
  EXPECT_GT(least_share(Effect::kDriveLag, Effect::kCurrentDelay, 0.02), 0.02) << "beside a known one";
  EXPECT_GT(share(Effect::kContactSpeedDependence, Effect::kContactTemperatureDependence), 0.17);
  EXPECT_GT(share(Effect::kContactSpeedDependence, Effect::kToothPassingTorque), 0.17);
  EXPECT_EQ(share(Effect::kToothPassingTorque, Effect::kContactSpeedDependence), kLeastShare);
  EXPECT_EQ(share(Effect::kContactSpeedDependence, Effect::kSpindleWindage), kLeastShare);
}

TEST(Causes, LagsOneAfterTheOtherAddUp) {
  EffectResult lag{.effect = Effect::kDriveLag, .magnitude = 2.0e-4, .standard_error = 1.0e-6};
  lag.alias_set = {Effect::kDriveLag};
  take_shape({.effect = Effect::kCurrentDelay, .magnitude = 1.0e-4, .standard_error = 1.0e-6}, lag);
  EXPECT_DOUBLE_EQ(lag.magnitude, 3.0e-4);
  EXPECT_NEAR(lag.standard_error, 0.5e-4, 1.0e-6);
  EXPECT_EQ(lag.alias_set, (std::vector{Effect::kDriveLag, Effect::kCurrentDelay}));
  EffectResult asymmetric{.effect = Effect::kFeedAsymmetricFriction, .magnitude = 5.0};
  take_shape({.effect = Effect::kFeedForceOffset, .magnitude = 8.0}, asymmetric);
  EXPECT_EQ(asymmetric.magnitude, 5.0);
  EXPECT_EQ(asymmetric.alias_set, Effects{Effect::kFeedForceOffset});
  EffectResult friction{.effect = Effect::kFeedCoulombFriction, .magnitude = 5.0};
  take_shape({.effect = Effect::kFeedStribeckFriction, .magnitude = 0.6}, friction);
  EXPECT_EQ(friction.magnitude, 5.0);
}

// The parts of a friction are one cause, whatever one of them is worth by itself.
TEST(Causes, ArePartsOfOneOrHaveAShareOfTheStrongest) {
  const RecordingSignals signals;
  const AxisFit fit{Axis::kFeed, signals, {}};
  const auto share_beside = [&](Effect strongest) {
    AxisOutcome outcome{.diagnosis = {.fit = fit, .nominal = fit}};
    outcome.diagnosis.found = {found_as(strongest, 5.0), found_as(Effect::kFeedForceOffset, 4.0),
                               found_as(Effect::kFeedPresliding, 1.0)};
    outcome.diagnosis.found[0].evidence = 4000.0;
    outcome.diagnosis.found[1].evidence = 100.0;
    outcome.diagnosis.found[2].evidence = 60.0;
    return outcome.context_of(outcome.diagnosis.found[1], 0.0).share;
  };
  EXPECT_DOUBLE_EQ(share_beside(Effect::kFeedSpring), 0.025);
  EXPECT_DOUBLE_EQ(share_beside(Effect::kFeedCoulombFriction), 1.0);
  EXPECT_DOUBLE_EQ(share_beside(Effect::kFeedDriveLag), 0.025) << "whatever else is found";
}

}  // namespace
}  // namespace morepro::host
