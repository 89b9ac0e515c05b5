#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "lib/monitor/monitor.hpp"
#include "sim_host/machine/estimator_choice.hpp"
#include "sim_host/machine/machine_file_reader.hpp"
#include "sim_host/machine/machine_file_writer.hpp"
#include "sim_host/machine/machine_key.hpp"
#include "sim_host/machine/setting_key.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {

MachineDescription read(const std::string& text) {
  const std::string path =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml";
  std::ofstream(path) << text;
  MachineDescription machine = read_machine_file(path);
  std::filesystem::remove(path);
  return machine;
}

TEST(MachineFile, GivesBackEveryValueThatWasWritten) {
  for (const char* name : {"reference", "thesis"}) {
    MachineDescription written = built_in_machine(name);
    MachineDescription machine = read(machine_file_text(written));
    EXPECT_EQ(machine.name, name);
    for (const MachineKey& key : machine_keys()) {
      EXPECT_EQ(key.of(machine.configuration.machine), key.of(written.configuration.machine))
          << full_name(key);
    }
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      const auto channel = static_cast<Channel>(i);
      EXPECT_EQ(machine.configuration.sensors[channel].noise, written.configuration.sensors[channel].noise);
    }
    EXPECT_EQ(machine.assumed_noise, 0);
  }
}

// Who measures an input says how, too.
TEST(MachineFile, KeepsTheStepOfAnInput) {
  MachineDescription written = built_in_machine("reference");
  written.configuration.sensors[Channel::kArmatureVoltage] = {0.0, 0.01};
  const MachineDescription machine = read(machine_file_text(written));
  EXPECT_EQ(machine.configuration.sensors[Channel::kArmatureVoltage].lsb, 0.01);
}

TEST(MachineFile, TakesAnInputForExact) {
  const std::string text = machine_file_text(built_in_machine("reference"));
  EXPECT_NO_THROW(read(text + "\n[sensors.feed_force_n]\nnoise = 0\n"));
}

TEST(MachineFile, ChoosesTheBuiltInMachinesOwnGrids) {
  for (const char* name : {"reference", "thesis"}) {
    const HypothesisGrid built_in = built_in_machine(name).configuration.grid;
    const HypothesisGrid chosen = read(machine_file_text(built_in_machine(name))).configuration.grid;
    EXPECT_NEAR(chosen.first_mm, built_in.first_mm, 1e-12);
    EXPECT_NEAR(chosen.step_mm, built_in.step_mm, 1e-12);
    EXPECT_EQ(chosen.count, built_in.count);
  }
}

TEST(MachineFile, KeepsEverySettingThatIsStated) {
  MachineDescription written = built_in_machine("reference");
  for (const SettingKey& key : setting_keys()) {
    const double usual = key.get(written.configuration);
    const double other = key.is_whole ? 7.0 : key.key == "low_ratio" ? 0.7 : 1.0625 * usual;
    key.set(written.configuration, other);
    written.stated.insert(full_name(key));
  }
  written.configuration.rule = DecisionRule::kBayesian;
  const MachineDescription machine = read(machine_file_text(written));
  EXPECT_EQ(machine.stated, written.stated);
  EXPECT_EQ(machine.configuration.rule, DecisionRule::kBayesian);
  for (const SettingKey& key : setting_keys())
    EXPECT_EQ(key.get(machine.configuration), key.get(written.configuration)) << full_name(key);
}

TEST(MachineFile, WhatIsNotStatedIsChosenFromTheRest) {
  for (const char* name : {"reference", "thesis"}) {
    const MonitorConfiguration built_in = built_in_machine(name).configuration;
    const MonitorConfiguration chosen = chosen_for(built_in, true);
    const MachineDescription machine = read(machine_file_text(built_in_machine(name)));
    for (const SettingKey& key : setting_keys()) {
      EXPECT_NEAR(key.get(machine.configuration), key.get(chosen), 1e-12) << full_name(key);
      if (key.table != "tuning") {
        EXPECT_NEAR(key.get(machine.configuration), key.get(built_in), 1e-12) << full_name(key);
      }
      EXPECT_EQ(machine.stated.contains(full_name(key)), key.origin.empty()) << full_name(key);
    }
  }
}

TEST(MachineFile, ATableMayStateOnlySomeKeys) {
  const GapTuning gap = read("[feed]\nmass_kg = 95\n[gap]\nfeed_evidence = 77\n").configuration.gap;
  EXPECT_EQ(gap.feed.evidence, 77.0);
  EXPECT_EQ(gap.spindle.evidence, gap::GapLimits{}.evidence);
}

TEST(MachineFile, HoldsTheFormsThatABoardLooksFor) {
  MachineDescription written = built_in_machine("reference");
  auto& gap = written.configuration.gap;
  gap.spindle.forms.form[0] = {.effect = gap::Effect::kSpindleCogging, .parts = 2, .shape = 7.0F};
  gap.spindle.forms.form[1] = {.effect = gap::Effect::kArmatureReaction, .kind = 1};
  gap.spindle.forms.count = 2;
  gap.feed.forms.form[0] = {.effect = gap::Effect::kFeedSpeedDelay, .shape = 0.001F};
  gap.feed.forms.count = 1;
  const GapTuning read_back = read(machine_file_text(written)).configuration.gap;
  ASSERT_EQ(read_back.spindle.forms.count, 2U);
  EXPECT_EQ(read_back.spindle.forms.form[0].effect, gap::Effect::kSpindleCogging);
  EXPECT_EQ(read_back.spindle.forms.form[0].parts, 2);
  EXPECT_EQ(read_back.spindle.forms.form[0].shape, 7.0F);
  EXPECT_EQ(read_back.spindle.forms.form[1].kind, 1);
  ASSERT_EQ(read_back.feed.forms.count, 1U);
  EXPECT_EQ(read_back.feed.forms.form[0].shape, 0.001F);
}

TEST(MachineFile, WhatFollowsAStatedValueFollowsIt) {
  const std::string machine = machine_file_text(built_in_machine("reference"));
  const std::string bank = "[bank]\n";
  std::string text = machine;
  text.replace(text.find(bank), bank.size(),
               "[bank]\nfirst_hypothesis_mm = 0.04\nhypothesis_step_mm = 0.02\n");
  const MonitorConfiguration c = read(text).configuration;
  EXPECT_EQ(c.grid.count, 4U) << "0.04 .. 0.1 mm: the law ends at 0.1175 mm";
  EXPECT_NEAR(c.tuning.chip_load_drift_mm, 0.005 * 0.02, 1e-15);
}

TEST(MachineFile, DescribesOnlyTheTablesThatAreThere) {
  const MachineDescription machine = read("[feed]\nmass_kg = 95\n");
  EXPECT_TRUE(machine.has_feed);
  EXPECT_FALSE(machine.has_spindle || machine.has_contact || machine.has_thermal || machine.has_rate);
  EXPECT_EQ(machine.configuration.machine.feed.viscous_friction_ns_m, 0.0);
  EXPECT_FALSE(machine.usable_channels() & bit_of(Channel::kSpindleSpeed));
  EXPECT_TRUE(machine.usable_channels() & bit_of(Channel::kFeedPosition));
}

TEST(MachineFile, WithoutAThermalTableTheContactDoesNotDependOnTemperature) {
  const auto& thermal = read("[feed]\nmass_kg = 95\n").configuration.machine.thermal;
  EXPECT_LT(thermal.tool_degc, thermal.reference_degc);
}

TEST(EstimatorChoice, GridHoldsTheNominalChipLoadInsideTheLawWithinTheBank) {
  for (const double teeth : {1.0, 2.0, 4.0, 6.0, 12.0}) {
    for (double share = 0.0; share <= 1.0; share += 0.05) {
      MachineParameters machine = reference_machine();
      machine.tool.teeth = teeth;
      machine.tool.chip_load_mm = (0.08 + share * (0.47 - 0.08)) / teeth;
      const HypothesisGrid grid = grid_for(machine);
      const double steps = (machine.tool.chip_load_mm - grid.first_mm) / grid.step_mm;
      EXPECT_NEAR(steps, std::round(steps), 1e-6);
      EXPECT_TRUE(steps > -0.5 && steps < grid.count - 0.5) << teeth << ' ' << share;
      EXPECT_GE(grid.count, 10U);
      MonitorConfiguration configuration;
      configuration.machine = machine;
      configuration.grid = grid;
      EXPECT_TRUE(std::make_unique<BoardMonitor>()->configure(configuration).ok()) << teeth << ' ' << share;
    }
  }
}

TEST(EstimatorChoice, NoRateMakesAStatedSwitchProbabilitySmaller) {
  MonitorConfiguration configuration = reference_configuration();
  configuration.tuning.switch_probability = 0.5;
  set_rate(configuration, 9999.0);
  EXPECT_EQ(configuration.tuning.switch_probability, 0.5);
}

TEST(EstimatorChoice, RateChangesTheNoisePerStepAndNotPerSecond) {
  MonitorConfiguration configuration = reference_configuration();
  set_rate(configuration, 2500.0);
  EXPECT_EQ(configuration.sampling.rate_hz, 2500.0);
  EXPECT_NEAR(configuration.tuning.speed_process_noise_rad_s, 0.04, 1e-12);
  EXPECT_NEAR(configuration.tuning.switch_probability, 4e-4, 1e-12);
}

TEST(Suggestion, FindsTheWordThatWasMeantAndNoOther) {
  constexpr std::array<std::string_view, 3> kWords{"resistance_ohm", "inductance_h", "inertia_kgm2"};
  EXPECT_EQ(nearest("resistence_ohm", kWords), "resistance_ohm");
  EXPECT_EQ(nearest("resistance", kWords), "resistance_ohm");
  EXPECT_EQ(nearest("resistenc", kWords), "resistance_ohm");
  EXPECT_EQ(nearest("RESISTANCE_OHM", kWords), "resistance_ohm");
  EXPECT_EQ(nearest("colour", kWords), "");
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

}  // namespace
}  // namespace morepro::host
