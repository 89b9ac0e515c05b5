#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "sim_host/diagnose/effect_naming.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

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

}  // namespace
}  // namespace morepro::host
