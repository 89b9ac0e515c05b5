#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

#include "lib/monitor/monitor.hpp"
#include "tests/support/gap_runs.hpp"

namespace morepro {
namespace {

using gap::Effect;
using gap::GapVerdict;
using host::ProfileKind;
using test::gap_effect;

using Effects = std::vector<gap::AppliedEffect>;

MonitorConfiguration knowing(const Effects& effects) {
  MonitorConfiguration configuration = test::gap_configuration();
  for (const gap::AppliedEffect& one : effects) configuration.effects.effect[configuration.effects.count++] = one;
  return configuration;
}

/// What a monitor has made of a run, the worst of it and its end.
struct Seen {
  Health last;
  float highest_ratio = 0.0F;         ///< of the spindle, after the first second
  float worst_current_a = 0.0F;       ///< root mean square against the measured current, after the first second
  float chip_load_deviations = 0.0F;  ///< largest error of a valid chip load, in its standard errors, late in a cut
  std::size_t valid = 0;
};

struct Run {
  ProfileKind profile = ProfileKind::kRich;
  double duration_s = 8.0;
};

Seen seen_by(const MonitorConfiguration& configuration, const Effects& of_machine, const Run& run = {}) {
  auto monitor = std::make_unique<BoardMonitor>();
  EXPECT_TRUE(monitor->configure(configuration).ok());
  host::SimulationOptions options{.profile = run.profile, .duration_s = run.duration_s, .effects = of_machine};
  host::Simulation simulation(test::gap_configuration(), options);
  Seen seen;
  std::size_t frames_in_cut = 0;
  SensorFrame frame;
  for (std::size_t i = 0; simulation.next(frame); ++i) {
    const Health& health = monitor->step(frame);
    if (i < 10000) continue;
    seen.highest_ratio = std::max(seen.highest_ratio, health.innovation_ratio);
    frames_in_cut = frame.get(Channel::kContact) > 0.5F ? frames_in_cut + 1 : 0;
    if (frames_in_cut < 500 || health.chip_load_state != ChipLoadState::kValid) continue;
    ++seen.valid;
    const float error = health.chip_load_mm - frame.get(Channel::kChipLoad);
    seen.chip_load_deviations =
        std::max(seen.chip_load_deviations, std::fabs(error) / health.chip_load_standard_error_mm);
  }
  seen.last = monitor->health();
  return seen;
}

void print(const char* what, std::size_t effect, const Seen& s) {
  std::cout << what << ' ' << effect << ": ratio " << s.highest_ratio << " dev " << s.chip_load_deviations << " valid "
            << s.valid << " verdict " << int(s.last.gap.verdict) << " effect " << int(s.last.gap.effect) << " ev "
            << s.last.gap.evidence << " state " << int(s.last.state);
  for (auto& p : s.last.parameters) std::cout << ' ' << p.value << '/' << int(p.status);
  std::cout << std::endl;
}

TEST(MonitorKnownEffects, Explore) {
  const Effects all{gap_effect(Effect::kSpindleCoulombFriction, 0.03), gap_effect(Effect::kBrushVoltageDrop, 1.5),
                    gap_effect(Effect::kFeedForceOffset, 3.0), gap_effect(Effect::kCurrentBias, 0.5),
                    gap_effect(Effect::kDriveLag, 1.0e-3), gap_effect(Effect::kSpindleWindage, 2.0e-7),
                    gap_effect(Effect::kFeedCoulombFriction, 8.0), gap_effect(Effect::kSpindleSpeedDelay, 1.0e-3), gap_effect(Effect::kFeedDriveLag, 3.0e-3),
                    gap_effect(Effect::kSpindleCogging, 0.02), gap_effect(Effect::kToothPassingTorque, 0.05), gap_effect(Effect::kTorqueConstantSaturation, 1e-4), gap_effect(Effect::kSpindleSpeedBias, 5), gap_effect(Effect::kArmatureReaction, 0.003), gap_effect(Effect::kShaftCompliance, 60.0),
                    gap_effect(Effect::kEncoderEccentricity, 0.01)};
  print("none", 0, seen_by(knowing({}), {}));
  for (const auto& one : all) {
    print("unknown", gap::index_of(one.form.effect), seen_by(knowing({}), {one}));
    print("known  ", gap::index_of(one.form.effect), seen_by(knowing({one}), {one}));
  }
}

}  // namespace
}  // namespace morepro
