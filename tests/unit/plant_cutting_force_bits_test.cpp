#include <gtest/gtest.h>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/cutting_force.hpp"
#include "lib/plant/friction_models.hpp"
#include "tests/support/bit_hash.hpp"

namespace morepro {
namespace {

// The number is the same on x86-64, aarch64, riscv64 and s390x.
TEST(Bits, CuttingForceAndFrictionModelsAreTheSameOnEveryMachine) {
  const CuttingForceModel<float> model{MillingCut{.teeth = 3, .entry_rad = 0.2, .exit_rad = 2.5}};
  test::BitHash hash;
  for (int k = 0; k < 360; ++k) {
    const auto force = model.at(static_cast<float>(k) * 0.05F);
    for (const float value : {force.x_n, force.y_n, force.axial_n, force.torque_nm}) hash.add(value);
    hash.add(model.literal_coefficient(static_cast<float>(k) * 0.05F).value);
  }
  hash.add(model.friction_coefficient());
  for (const MachineParameters& machine : {reference_machine(), thesis_machine()}) {
    const FrictionModels<float> models(machine);
    for (int k = -10; k < 200; ++k) {
      const auto x = static_cast<float>(k);
      hash.add(models.product(10.0F * x, 0.005F * x, 300.0F + 7.0F * x).beta);
    }
  }
  EXPECT_EQ(hash.value(), 0xA6889852U);
}

}  // namespace
}  // namespace morepro
