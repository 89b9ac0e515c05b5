#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "lib/monitor/parameter_tracker.hpp"
#include "tests/support/spindle_simulation.hpp"
#include "tests/support/wrong_datasheet.hpp"

namespace morepro {
namespace {

using test::values_of;

/// With a tracker that is told how far off its datasheet may be.
MonitorConfiguration wrong_by(const MonitorConfiguration& truth, double factor) {
  auto wrong = test::wrong_by(truth, factor);
  wrong.tuning.parameter_start_fraction = factor > 1.5 ? 0.7 : 0.3;
  return wrong;
}

struct Experiment {
  MonitorConfiguration truth;
  MonitorConfiguration datasheet;
  void (*stimulate)(test::SpindleSimulation&, int frame);
  int frames = 20000;
  std::uint64_t seed = 1;
  int settled = 0;  ///< frames before the first one that is recorded
};

/// Voltage with a 1 ms and a 20 ms random part, feed force with a 30 ms one, contact on and off every 100 ms.
void excite(test::SpindleSimulation& machine, int k) {
  auto& u = machine.input;
  static double fast = 6.0, slow = 6.0, force = 4.0;
  const auto sign = [&] { return (machine.random()() & 1U) != 0 ? 1.0 : -1.0; };
  if (k % 10 == 0) fast = 6.0 * sign();
  if (k % 200 == 0) slow = 6.0 * sign();
  if (k % 300 == 0) force = 4.0 * sign();
  u.armature_voltage_v = 48.0 + fast + slow;
  u.feed_force_n = 26.0 + force;
  u.contact = (k / 1000) % 2;
}

/// One spin-up, in contact, and nothing more.
void stay_in_contact(test::SpindleSimulation& machine, int /*frame*/) { machine.input.contact = 1.0; }

void stay_in_the_air(test::SpindleSimulation& machine, int /*frame*/) { machine.input.contact = 0.0; }

/// The speed swings a little: enough not to be at rest, not enough to tell resistance from back-EMF constant.
void swing(test::SpindleSimulation& machine, int k) {
  machine.input.contact = 0.0;
  machine.input.armature_voltage_v = 48.0 + 1.5 * std::sin(2.0e-3 * k);
}

void step_the_voltage(test::SpindleSimulation& machine, int k) {
  machine.input.contact = 0.0;
  machine.input.armature_voltage_v = (k / 3000) % 2 != 0 ? 40.0 : 48.0;
}

std::array<ParameterEstimate, kParameterCount> identify(const Experiment& run) {
  const auto& c = run.truth;
  auto tracker = std::make_unique<ParameterTracker>(run.datasheet);
  test::SpindleSimulation machine(c, run.seed);
  machine.input = {.armature_voltage_v = 48.0,
                   .feed_force_n = 26.0,
                   .chip_load_mm = c.machine.tool.chip_load_mm,
                   .tool_temperature_degc = 500.0};
  const double noise_m_s = c.sensors[Channel::kFeedSpeed].noise;
  std::normal_distribution<double> normal;
  HeldInputs held(c.machine, c.sampling.rate_hz);
  for (int k = -run.settled; k < run.frames; ++k) {
    run.stimulate(machine, k);
    if (k < 0) {
      machine.step();
      continue;
    }
    SensorFrame frame;
    frame.set(Channel::kArmatureVoltage, static_cast<float>(machine.input.armature_voltage_v));
    frame.set(Channel::kFeedForce, static_cast<float>(machine.input.feed_force_n));
    frame.set(Channel::kContact, static_cast<float>(machine.input.contact));
    frame.set(Channel::kToolTemperature, 500.0F);
    held.take({frame, frame.present});
    machine.step();
    const FeedMeasurement<float> feed{
        static_cast<float>(machine.state().feed_speed_m_s + noise_m_s * normal(machine.random())), 0.0F,
        static_cast<float>(noise_m_s * noise_m_s), kUnmeasured};
    tracker->step_spindle(held, machine.measure(), true);
    tracker->step_feed(held, feed, static_cast<float>(noise_m_s));
    tracker->refresh();
  }
  return tracker->estimates();
}

double relative_error(const Experiment& run, std::size_t j, const ParameterEstimate& estimate) {
  return std::abs(static_cast<double>(estimate.value) / values_of(run.truth.machine)[j] - 1.0);
}

struct ExcitedCase {
  const char* name;
  MonitorConfiguration truth;
  double factor;
  double goal;  // relative
};

class Excited : public testing::TestWithParam<ExcitedCase> {};

TEST_P(Excited, FindsAllSevenParametersAndCoversTheErrors) {
  int covered = 0, counted = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Experiment run{.truth = GetParam().truth,
                         .datasheet = test::wrong_at_random(GetParam().truth, GetParam().factor, seed),
                         .stimulate = excite,
                         .seed = seed};
    const auto estimates = identify(run);
    for (std::size_t j = 0; j < kParameterCount; ++j) {
      const double error = relative_error(run, j, estimates[j]);
      EXPECT_EQ(estimates[j].status, ParameterStatus::kIdentifiable) << j;
      EXPECT_LE(error, GetParam().goal) << "parameter " << j << " seed " << seed;
      covered +=
          error * values_of(run.truth.machine)[j] < 3.0 * static_cast<double>(estimates[j].standard_error)
              ? 1
              : 0;
      ++counted;
    }
  }
  EXPECT_GE(covered, counted * 95 / 100);
}

// Goals: 1 % from starts wrong by 30 %, 2 % from starts wrong by a factor of two, after 2 s.
INSTANTIATE_TEST_SUITE_P(
    Identification, Excited,
    testing::Values(ExcitedCase{"thesis_30_percent", thesis_configuration(), 1.3, 0.01},
                    ExcitedCase{"reference_30_percent", reference_configuration(), 1.3, 0.01},
                    ExcitedCase{"thesis_factor_2", thesis_configuration(), 2.0, 0.02},
                    ExcitedCase{"reference_factor_2", reference_configuration(), 2.0, 0.02}),
    [](const auto& instance) { return instance.param.name; });

#ifdef __SANITIZE_ADDRESS__
constexpr int kLong = 1'000'000;  // a tenth: it is slow there, and the arithmetic is the same
#else
constexpr int kLong = 10'000'000;  // 1000 s
#endif

TEST(Identification, ConstantInputsMakeNothingDrift) {
  const Experiment run{.truth = thesis_configuration(),
                       .datasheet = thesis_configuration(),
                       .stimulate = stay_in_contact,
                       .frames = 10000};
  Experiment longer = run;
  longer.frames = kLong;
  const auto before = identify(run), after = identify(longer);
  for (std::size_t j = 0; j < kParameterCount; ++j)
    EXPECT_NEAR(after[j].value, before[j].value, 0.01F * before[j].value) << "parameter " << j;
}

TEST(Identification, ConstantInputsLeaveParametersUnknownAndClaimNothingFalse) {
  const Experiment experiment{.truth = thesis_configuration(),
                              .datasheet = wrong_by(thesis_configuration(), 1.3),
                              .stimulate = stay_in_contact};
  const auto estimates = identify(experiment);
  for (Parameter parameter : {Parameter::kContactForce, Parameter::kInductance, Parameter::kInertia})
    EXPECT_LT(estimates[index_of(parameter)].status, ParameterStatus::kIdentifiable) << index_of(parameter);
  for (std::size_t j = 0; j < kParameterCount; ++j) {
    if (estimates[j].status != ParameterStatus::kIdentifiable) continue;
    EXPECT_NEAR(static_cast<double>(estimates[j].value), values_of(experiment.truth.machine)[j],
                3.0 * static_cast<double>(estimates[j].standard_error))
        << "parameter " << j;
  }
}

TEST(Identification, NamesWithWhatAParameterIsToldOnly) {
  const auto steady = identify({.truth = thesis_configuration(),
                                .datasheet = wrong_by(thesis_configuration(), 1.3),
                                .stimulate = stay_in_contact,
                                .settled = 5000});
  const auto excited =
      identify({.truth = thesis_configuration(), .datasheet = thesis_configuration(), .stimulate = excite});
  const auto expect_partner = [](const auto& estimates, Parameter parameter, ParameterStatus status,
                                 Partner partner) {
    EXPECT_EQ(estimates[index_of(parameter)].status, status) << index_of(parameter);
    EXPECT_EQ(estimates[index_of(parameter)].partner, partner) << index_of(parameter);
  };
  constexpr auto kPair = ParameterStatus::kCorrelated, kAlone = ParameterStatus::kIdentifiable;
  expect_partner(steady, Parameter::kResistance, kPair, partner_named(Parameter::kBackEmfConstant));
  expect_partner(steady, Parameter::kBackEmfConstant, kPair, partner_named(Parameter::kResistance));
  expect_partner(steady, Parameter::kMass, kPair, partner_named(Parameter::kContactForce));
  expect_partner(steady, Parameter::kContactForce, kPair, partner_named(Parameter::kMass));
  expect_partner(excited, Parameter::kResistance, kAlone, Partner::kNone);
  expect_partner(excited, Parameter::kMass, kAlone, Partner::kNone);
  expect_partner(excited, Parameter::kContactForce, kAlone, Partner::kContactOffset);
}

/// Claimed and true distance of resistance and back-EMF constant, in standard errors, after six seconds in
/// which the speed only swings a little: enough not to be at rest, not enough to tell the two apart.
TEST(Identification, NoiseDoesNotTellResistanceFromBackEmf) {
  const auto c = thesis_configuration();
  auto tracker = std::make_unique<ParameterTracker>(c);
  test::SpindleSimulation machine(c, 3);
  machine.input = {.armature_voltage_v = 48.0, .contact = 0.0, .tool_temperature_degc = 500.0};
  HeldInputs held(c.machine, c.sampling.rate_hz);
  for (int k = 0; k < 60000; ++k) {
    machine.input.armature_voltage_v = 48.0 + 1.5 * std::sin(2.0e-3 * k);
    SensorFrame frame;
    frame.set(Channel::kArmatureVoltage, static_cast<float>(machine.input.armature_voltage_v));
    frame.set(Channel::kContact, 0.0F);
    held.take({frame, frame.present});
    machine.step();
    tracker->step_spindle(held, machine.measure(), true);
    tracker->refresh();
  }
  for (Parameter parameter : {Parameter::kTorqueConstant, Parameter::kInertia, Parameter::kInductance}) {
    const auto& estimate = tracker->estimates()[index_of(parameter)];
    EXPECT_NEAR(static_cast<double>(estimate.value), values_of(c.machine)[index_of(parameter)],
                3.0 * static_cast<double>(estimate.standard_error))
        << index_of(parameter);
  }
}

/// Parameters that were called identifiable, and those of them that are farther off than three standard
/// errors.
struct Claims {
  int all = 0;
  int wrong = 0;

  void count(const Experiment& run) {
    const auto estimates = identify(run);
    for (std::size_t j = 0; j < kParameterCount; ++j) {
      if (estimates[j].status != ParameterStatus::kIdentifiable) continue;
      const double error = relative_error(run, j, estimates[j]) * values_of(run.truth.machine)[j];
      ++all;
      if (error > 3.0 * static_cast<double>(estimates[j].standard_error)) ++wrong;
    }
  }
};

// Of 7,459 claims over both machines, four datasheets, eight excitations and 30 seeds 0.5 % were farther off
// than three standard errors; 11 % were, up to 475 % off, when slopes were those of the noisy estimate and
// what was learnt at the wrong datasheet's values stayed.
TEST(Identification, ClaimsNothingFalseOfAMachineThatHardlyMoves) {
  Claims claims;
  for (const auto& truth : {thesis_configuration(), reference_configuration()})
    for (const double factor : {1.0, 1.3, 2.0})
      for (const auto stimulate : {stay_in_contact, stay_in_the_air, swing, step_the_voltage})
        for (std::uint64_t seed = 1; seed <= 3; ++seed)
          claims.count({truth, wrong_by(truth, factor), stimulate, 20000, seed});
  EXPECT_GT(claims.all, 150) << "what is told is said";
  EXPECT_LE(claims.wrong, claims.all / 50);
}

// With slopes of the noisy estimate the torque constant was up to 9 standard errors off in a third of these.
TEST(Identification, NoiseInTheSlopesIsNoKnowledge) {
  Claims claims;
  const auto truth = thesis_configuration();
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    claims.count({truth, wrong_by(truth, 2.0), swing, 20000, seed});
  EXPECT_GE(claims.all, 10);
  EXPECT_EQ(claims.wrong, 0);
}

TEST(Identification, IsNotRunWhereTheSamplingMissesTheInductance) {
  auto slow = reference_configuration();
  slow.sampling.rate_hz = 500.0;
  const auto estimates = identify({.truth = slow, .datasheet = slow, .stimulate = excite, .frames = 2000});
  EXPECT_EQ(estimates[index_of(Parameter::kInductance)].status, ParameterStatus::kSamplingTooSlow);
}

}  // namespace
}  // namespace morepro
