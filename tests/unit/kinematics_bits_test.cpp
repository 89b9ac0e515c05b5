#include <gtest/gtest.h>

#include "lib/kinematics/clik.hpp"
#include "lib/kinematics/path.hpp"
#include "lib/kinematics/pose_search.hpp"
#include "tests/support/bit_hash.hpp"
#include "tests/support/chains.hpp"

namespace morepro::kinematics {
namespace {

Path<float, 3> arm_path_in_float() {
  Path<float, 3> path;
  EXPECT_EQ(path.add({{0.45F, 0.1F, 0.75F}, {0.1F, 0.5F, 0.2F}}, 0.0F), PathError::kNone);
  EXPECT_EQ(path.add({{0.35F, -0.2F, 0.6F}, {-0.4F, 0.8F, -0.3F}}, 2.0F), PathError::kNone);
  EXPECT_EQ(path.add({{0.5F, 0.0F, 0.5F}, {0.5F, 1.1F, 0.0F}}, 2.0F), PathError::kNone);
  return path;
}

void add(test::BitHash& hash, const JointVector<float>& values) {
  for (const float value : values) hash.add(value);
}

// The number is the same on x86-64, aarch64, riscv64 and s390x. Where it differs, something sums or fuses in
// the order of the machine's vectors.
TEST(Bits, SearchPathAndClikAreTheSameOnEveryMachine) {
  const auto path = arm_path_in_float();
  const Chain<float> chain(test::six_joint_arm());
  const auto start =
      PoseSearch<float>(chain, kAllRows, 1.0e-5F)
          .find({path.at(0.0F).position_m, path.at(0.0F).angles_rad}, {0.1F, 0.2F, 0.3F, 0.2F, 0.5F, 0.1F});
  Clik<float> clik(chain, {.gain_per_s = 50.0, .period_s = 2.0e-3, .rows = kAllRows}, start.joints);
  test::BitHash hash;
  for (int k = 0; k < 2000; ++k) {
    const ToolState<float> wanted = path.at(static_cast<float>(k) * 2.0e-3F);
    add(hash, clik.acceleration(wanted));
    const ClikStep<float> step = clik.step(wanted);
    add(hash, step.rate);
    for (int row = 0; row < 6; ++row) hash.add(step.error(row));
    add(hash, clik.joints());
  }
  EXPECT_TRUE(start.is_reached);
  EXPECT_EQ(hash.value(), 0x4A79EC41U);
}

// A chain with still directions, none of them along an axis.
TEST(Bits, AMachineOfTwoSkewedSlidesIsTheSameOnEveryMachine) {
  DhTable table{.count = 2};
  table.joints[0] = {JointKind::kPrismatic, 0.2, 0.0, 0.9, 0.5};
  table.joints[1] = {JointKind::kPrismatic, 0.1};
  const Chain<float> chain(table);
  Clik<float> clik(chain, {.gain_per_s = 50.0, .period_s = 2.0e-3, .rows = kPositionRows}, {0.1F, 0.2F});
  ToolState<float> wanted;
  wanted.position_m = chain.frames({0.4F, -0.3F}).tool().position_m;
  test::BitHash hash;
  for (int k = 0; k < 100; ++k) {
    const ClikStep<float> step = clik.step(wanted);
    EXPECT_EQ(step.damping, 0.0F);
    add(hash, step.rate);
    add(hash, clik.joints());
  }
  EXPECT_EQ(hash.value(), 0x5BB78D79U);
}

}  // namespace
}  // namespace morepro::kinematics
