#include <gtest/gtest.h>

#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using nlohmann::json;

void expect_same(const MachineParameters& machine, const json& golden) {
  EXPECT_EQ(machine.spindle.torque_constant_nm_a, golden["Kt"]);
  EXPECT_EQ(machine.spindle.back_emf_constant_vs_rad, golden["Kv"]);
  EXPECT_EQ(machine.spindle.resistance_ohm, golden["R"]);
  EXPECT_EQ(machine.spindle.inductance_h, golden["L"]);
  EXPECT_EQ(machine.spindle.inertia_kgm2, golden["In"]);
  EXPECT_EQ(machine.spindle.viscous_friction_nms_rad, golden["Att"]);
  EXPECT_EQ(machine.feed.mass_kg, golden["m"]);
  EXPECT_EQ(machine.feed.contact_force_n, golden["F2"]);
  EXPECT_EQ(machine.feed.contact_offset_n, golden["c"]);
  EXPECT_EQ(machine.feed.engagement, golden["alpha"]);
  EXPECT_EQ(machine.feed.viscous_friction_ns_m, golden["bx"]);
}

void expect_same_tool(const MachineParameters& machine, const json& golden) {
  EXPECT_EQ(machine.tool.diameter_mm, golden["DC"]);
  EXPECT_EQ(machine.tool.teeth, golden["teeth"]);
  EXPECT_EQ(machine.tool.chip_load_mm, golden["CL"]);
  EXPECT_EQ(machine.contact.form == ContactForm::kThesis, golden["form"] == "literal");
  EXPECT_EQ(machine.contact.viscous_gain_nms, golden["kap"]);
  EXPECT_EQ(machine.contact.edge_force_n, golden["N0"]);
  EXPECT_EQ(machine.contact.chip_force_n_mm, golden["N1"]);
  EXPECT_EQ(machine.contact.radius_m, golden["r"]);
  EXPECT_EQ(machine.contact.speed_scale_rad_s, 1.0);
  EXPECT_EQ(machine.thermal.reference_degc, golden["T0"]);
  EXPECT_EQ(machine.thermal.melting_degc, golden["Tm"]);
  EXPECT_EQ(machine.thermal.exponent, golden["mr"]);
  EXPECT_EQ(machine.thermal.tool_degc, golden["T"]);
}

TEST(ParametersGolden, BuiltInMachinesAreTheGoldenSets) {
  const json golden = test::golden_json("params.json");
  for (const char* set : {"THESIS", "REF"}) {
    SCOPED_TRACE(set);
    expect_same(test::golden_machine(set), golden[set]);
    expect_same_tool(test::golden_machine(set), golden[set]);
  }
}

}  // namespace
}  // namespace morepro
