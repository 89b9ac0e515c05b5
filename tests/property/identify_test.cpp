#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "sim_host/identify/axis_identification.hpp"
#include "sim_host/identify/identification.hpp"
#include "tests/support/excitation_recorder.hpp"
#include "tests/support/wrong_datasheet.hpp"

namespace morepro::host {
namespace {

using test::Recorder;
using test::wrong_by;

constexpr int kSeeds = 20;
struct Tally {
  int covered = 0;
  int counted = 0;
  int freedom = 0;
  double nees = 0.0;
  double largest = 0.0;

  template <class Traits>
  void add(const RecordingSignals& signals, const MonitorConfiguration& truth,
           const MonitorConfiguration& datasheet) {
    const AxisEstimate found = identify_axis<Traits>(signals, datasheet, [] {});
    Eigen::VectorXd error(found.covariance.rows());
    for (Eigen::Index j = 0; j < error.size(); ++j) {
      const auto k = static_cast<std::size_t>(j);
      error(j) = std::log(found.value[k] / value_in(truth.machine, found.names[k]));
      covered += std::abs(error(j)) < 3.0 * std::sqrt(found.covariance(j, j)) ? 1 : 0;
      largest = std::max(largest, std::abs(error(j)));
      ++counted;
    }
    EXPECT_TRUE(found.has_settled);
    nees += error.dot(found.covariance.ldlt().solve(error));
    freedom += static_cast<int>(error.size());
  }
};

struct Start {
  const char* name;
  bool is_thesis;
  double factor;
};

class Identify : public testing::TestWithParam<Start> {};

// Goals: 1 % from starts that are off by 30 %, 2 % from a factor of two; reached: a tenth of that. NEES: a
// chi-square number of 140 degrees of freedom stays inside mean +- 3.3 sigma in 999 of 1000 cases.
TEST_P(Identify, FindsAllSevenAndKnowsHowWell) {
  const auto truth = GetParam().is_thesis ? thesis_configuration() : reference_configuration();
  const auto datasheet = wrong_by(truth, GetParam().factor);
  Tally tally;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const RecordingSignals signals = Recorder(truth, seed).excited();
    tally.add<SpindleTraits>(signals, truth, datasheet);
    tally.add<FeedTraits>(signals, truth, datasheet);
  }
  EXPECT_LE(tally.largest, 0.01);
  EXPECT_GE(tally.covered, tally.counted * 95 / 100);
  const double spread = std::sqrt(2.0 * tally.freedom);
  EXPECT_NEAR(tally.nees, tally.freedom, 3.3 * spread);
  RecordProperty("largest_error_percent", std::to_string(100.0 * tally.largest));
  RecordProperty("nees_per_freedom", std::to_string(tally.nees / tally.freedom));
}

INSTANTIATE_TEST_SUITE_P(Starts, Identify,
                         testing::Values(Start{"thesis_30_percent", true, 1.3},
                                         Start{"thesis_double", true, 2.0}, Start{"thesis_half", true, 0.5},
                                         Start{"reference_30_percent", false, 1.3},
                                         Start{"reference_double", false, 2.0},
                                         Start{"reference_half", false, 0.5}),
                         [](const auto& instance) { return instance.param.name; });

MachineDescription described(const MonitorConfiguration& configuration) {
  MachineDescription machine;
  machine.configuration = configuration;
  return machine;
}

const ParameterResult& named(const IdentificationResult& result, std::string_view name) {
  for (const auto& parameter : result.parameters)
    if (parameter.name == name) return parameter;
  throw std::runtime_error("no such parameter");
}

TEST(IdentifySteadyCut, TellsTheTorqueConstantAndSaysWhatItDoesNotTell) {
  const auto truth = thesis_configuration();
  auto wrong = wrong_by(truth, 1.3);
  const auto result = identify(Recorder(truth, 3).steady(), described(wrong), IdentificationFilter::kStates,
                               [](const auto&) {});
  const auto& torque = named(result, "torque_constant_nm_a");
  EXPECT_TRUE(torque.is_identifiable) << torque.reason;
  EXPECT_NEAR(torque.refit, 1.5, 3.0 * torque.standard_error);
  EXPECT_NE(torque.reason.find("viscous_friction_nms_rad"), std::string::npos);
  for (const char* name : {"inertia_kgm2", "inductance_h", "resistance_ohm", "back_emf_constant_vs_rad",
                           "mass_kg", "contact_force_n"}) {
    EXPECT_FALSE(named(result, name).is_identifiable) << name;
    EXPECT_FALSE(named(result, name).reason.empty()) << name;
  }
  EXPECT_NE(named(result, "resistance_ohm").reason.find("back_emf_constant_vs_rad"), std::string::npos);
  EXPECT_NE(named(result, "back_emf_constant_vs_rad").reason.find("resistance_ohm"), std::string::npos);
  EXPECT_FALSE(result.is_sufficient);
  EXPECT_FALSE(result.advice.empty());
}

/// Nothing in a steady cut tells the friction: what is balanced with it is known no better than it is.
TEST(IdentifySteadyCut, IsNoSurerThanTheFrictionOfTheMachineFile) {
  const auto truth = thesis_configuration();
  const RecordingSignals signals = Recorder(truth, 5).steady();
  for (const double factor : {0.8, 0.9, 1.0, 1.1, 1.25}) {
    auto wrong = wrong_by(truth, 1.3);
    wrong.machine.spindle.viscous_friction_nms_rad *= factor;
    const auto result =
        identify(signals, described(wrong), IdentificationFilter::kStates, [](const auto&) {});
    const auto& torque = named(result, "torque_constant_nm_a");
    EXPECT_TRUE(torque.is_identifiable) << factor << " " << torque.reason;
    EXPECT_NEAR(torque.refit, 1.5, 3.0 * torque.standard_error) << factor;
    EXPECT_NE(torque.reason.find("viscous_friction_nms_rad"), std::string::npos);
    EXPECT_NE(torque.reason.find("10 %"), std::string::npos);
  }
}

TEST(IdentifyFriction, AWrongFrictionIsFoundWithTheRest) {
  const auto truth = reference_configuration();
  auto wrong = wrong_by(truth, 1.3);
  wrong.machine.spindle.viscous_friction_nms_rad *= 0.7;
  wrong.machine.feed.viscous_friction_ns_m *= 1.3;
  const auto result = identify(Recorder(truth, 4).excited(), described(wrong), IdentificationFilter::kStates,
                               [](const auto&) {});
  ASSERT_EQ(result.parameters.size(), kMachineValueCount);
  for (std::size_t j = 0; j < kMachineValueCount; ++j) {
    const auto& parameter = result.parameters[j];
    const double expected = value_in(truth.machine, static_cast<MachineValue>(j));
    EXPECT_TRUE(parameter.is_identifiable) << parameter.name << " " << parameter.reason;
    EXPECT_NEAR(parameter.refit, expected, std::min(0.01 * expected, 4.0 * parameter.standard_error))
        << parameter.name;
  }
}

// In the air torque constant, inertia and friction may grow together and nothing changes: from passes whose
// prior was the result of the pass before, the torque constant walked to 0.84 +- 0.035 of 1.5.
TEST(IdentifyNullLine, StaysAtTheDatasheetAsUncertainAsItIs) {
  const auto truth = thesis_configuration();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto result = identify(Recorder(truth, seed).excited_in_the_air(), described(truth),
                                 IdentificationFilter::kStates, [](const auto&) {});
    for (const char* name : {"torque_constant_nm_a", "inertia_kgm2"}) {
      const auto& value = named(result, name);
      EXPECT_FALSE(value.is_identifiable) << name;
      EXPECT_NEAR(value.refit, value.datasheet, 0.5 * value.standard_error) << name;
      EXPECT_NEAR(value.standard_error, 0.1 * value.datasheet, 0.01 * value.datasheet) << name;
    }
    for (const char* name : {"inductance_h", "resistance_ohm", "back_emf_constant_vs_rad", "mass_kg"}) {
      const auto& value = named(result, name);
      EXPECT_TRUE(value.is_identifiable) << name << " " << value.reason;
      EXPECT_NEAR(value.refit, value.datasheet, 4.0 * value.standard_error) << name;
    }
  }
}

TEST(IdentifyNullLine, ASpindleThatRunsSteadilyTellsNothing) {
  const auto truth = thesis_configuration();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto result = identify(Recorder(truth, seed).steady(0.0), described(truth),
                                 IdentificationFilter::kStates, [](const auto&) {});
    for (std::size_t j = 0; j < kParameterCount; ++j) {
      const auto& value = result.parameters[j];
      if (is_of_feed(static_cast<MachineValue>(j))) continue;  // a table without friction is accelerated
      EXPECT_FALSE(value.is_identifiable) << value.name;
      if (std::isfinite(value.refit)) {
        EXPECT_NEAR(value.refit, value.datasheet, value.standard_error) << value.name;
      }
    }
  }
}

TEST(IdentifyPrior, IsTheDatasheetWhereverAPassIsLinearised) {
  const auto machine = thesis_configuration().machine;
  SpindleParameterFilter<double, AnchoredWithFriction> filter(machine, 1.0e-4, kDatasheetFraction, 0.0);
  const auto& s = machine.spindle;
  filter.anchor_at({2.0 * s.torque_constant_nm_a, 0.5 * s.inertia_kgm2, 3.0 * s.inductance_h,
                    s.resistance_ohm, s.back_emf_constant_vs_rad, 1.5 * s.viscous_friction_nms_rad});
  EXPECT_NEAR(filter.value(SpindleParameter::kTorqueConstant), s.torque_constant_nm_a, 1.0e-9);
  EXPECT_NEAR(filter.value(SpindleParameter::kInertia), s.inertia_kgm2, 1.0e-12);
  EXPECT_NEAR(filter.value(SpindleParameter::kInductance), s.inductance_h, 1.0e-12);
  EXPECT_NEAR(filter.value(SpindleParameter::kViscousFriction), s.viscous_friction_nms_rad, 1.0e-9);
}

// A swing hardly tells the inductance: a far start of it must not keep the rest from settling.
TEST(IdentifySwing, TellsTheSameWhateverTheInductanceOfTheDatasheet) {
  const auto truth = thesis_configuration();
  const RecordingSignals signals = Recorder(truth, 1).swinging();
  for (const double factor : {0.1, 1.0, 10.0}) {
    auto datasheet = truth;
    datasheet.machine.spindle.inductance_h *= factor;
    const auto result =
        identify(signals, described(datasheet), IdentificationFilter::kStates, [](const auto&) {});
    for (const char* name : {"torque_constant_nm_a", "resistance_ohm", "back_emf_constant_vs_rad"}) {
      const auto& value = named(result, name);
      EXPECT_TRUE(value.is_identifiable) << factor << " " << name << " " << value.reason;
      EXPECT_NEAR(value.refit, value.datasheet, 4.0 * value.standard_error) << factor << " " << name;
    }
  }
}

// 2 kHz: one period is three times the thesis machine's L/R.
TEST(IdentifySlowSampling, IsAsHonest) {
  for (auto truth : {thesis_configuration(), reference_configuration()}) {
    truth.sampling.rate_hz = 2000.0;
    const auto result = identify(Recorder(truth, 6).excited(), described(wrong_by(truth, 1.3)),
                                 IdentificationFilter::kStates, [](const auto&) {});
    for (std::size_t j = 0; j < kParameterCount; ++j) {
      const auto& value = result.parameters[j];
      EXPECT_TRUE(value.is_identifiable) << value.name << " " << value.reason;
      EXPECT_NEAR(value.refit, value_in(truth.machine, static_cast<MachineValue>(j)),
                  4.0 * value.standard_error)
          << value.name;
    }
  }
}

// With slopes of the current's rate halfway, eight runs were 5.1 claimed standard errors off (root mean
// square).
TEST(IdentifySlowSampling, KnowsHowWellItKnowsTheInductance) {
  auto truth = thesis_configuration();
  truth.sampling.rate_hz = 2000.0;
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto result = identify(Recorder(truth, seed).excited(), described(truth),
                                 IdentificationFilter::kStates, [](const auto&) {});
    const auto& inductance = named(result, "inductance_h");
    ASSERT_TRUE(inductance.is_identifiable) << inductance.reason;
    squares +=
        std::pow((inductance.refit - truth.machine.spindle.inductance_h) / inductance.standard_error, 2);
  }
  EXPECT_GT(squares, 0.86);  // chi square of 8: 0.1 % on either side
  EXPECT_LT(squares, 26.1);
}

/// The thesis's own form on a recording without measured accelerations: all derivatives are differences.
void expect_honest(const RecordingSignals& signals, const MonitorConfiguration& truth,
                   const MonitorConfiguration& datasheet, int* claims) {
  const auto result =
      identify(signals, described(datasheet), IdentificationFilter::kDerivatives, [](const auto&) {});
  for (const auto& parameter : result.parameters) {
    if (!parameter.is_identifiable) {
      EXPECT_FALSE(parameter.reason.empty()) << parameter.name;
      continue;
    }
    ++*claims;
    for (std::size_t j = 0; j < kMachineValueCount; ++j) {
      const auto value = static_cast<MachineValue>(j);
      if (name_of(value) != parameter.name) continue;
      EXPECT_NEAR(parameter.refit, value_in(truth.machine, value), 4.0 * parameter.standard_error)
          << parameter.name;
    }
  }
}

class IdentifyByDerivatives : public testing::TestWithParam<Start> {};

// Differences of the reference machine's speed are noisier than its accelerations by 70: torque constant and
// inertia are told to 2 .. 10 % only, beside a friction that is not known. Four standard errors: one claim in
// 16,000 may be farther off by chance, of some 100 here.
TEST_P(IdentifyByDerivatives, TellsMostOfThemAndClaimsNothingFalse) {
  const auto truth = GetParam().is_thesis ? thesis_configuration() : reference_configuration();
  auto datasheet = wrong_by(truth, GetParam().factor);
  datasheet.machine.spindle.viscous_friction_nms_rad *= 0.8;
  datasheet.machine.feed.viscous_friction_ns_m *= 1.2;
  int claims = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    expect_honest(Recorder(truth, seed).excited(), truth, datasheet, &claims);
  EXPECT_GE(claims, 5 * 5);
}

INSTANTIATE_TEST_SUITE_P(Starts, IdentifyByDerivatives,
                         testing::Values(Start{"thesis_30_percent", true, 1.3},
                                         Start{"reference_30_percent", false, 1.3},
                                         Start{"reference_half", false, 0.5}),
                         [](const auto& instance) { return instance.param.name; });

// All that is told of the inductance lies in the few rows of the start, which a fit follows: by their
// residuals alone it was up to five standard errors off.
TEST(IdentifyByDerivativesStart, IsAsSureAsTheNoiseOfAllRowsAllows) {
  const auto truth = thesis_configuration();
  double square = 0.0;
  constexpr int kStarts = 12;
  for (std::uint64_t seed = 1; seed <= kStarts; ++seed) {
    const auto result = identify(Recorder(truth, seed).started(), described(truth),
                                 IdentificationFilter::kDerivatives, [](const auto&) {});
    const auto& value = named(result, "inductance_h");
    ASSERT_TRUE(value.is_identifiable) << value.reason;
    const double off = (value.refit - value.datasheet) / value.standard_error;
    square += off * off;
  }
  EXPECT_LE(square, 32.9);  // of chi-square with 12 degrees of freedom 99.9 %
}

TEST(IdentifyByDerivativesSteadyCut, TellsTheTorqueConstantAndNamesCombinations) {
  const auto truth = thesis_configuration();
  const auto result = identify(Recorder(truth, 3).steady(), described(wrong_by(truth, 1.3)),
                               IdentificationFilter::kDerivatives, [](const auto&) {});
  const auto expect_pair = [&](const char* one, const char* other) {
    EXPECT_FALSE(named(result, one).is_identifiable) << one;
    EXPECT_NE(named(result, one).reason.find(other), std::string::npos)
        << one << ": " << named(result, one).reason;
  };
  const auto& torque = named(result, "torque_constant_nm_a");
  EXPECT_TRUE(torque.is_identifiable) << torque.reason;
  EXPECT_NEAR(torque.refit, 1.5, 3.0 * torque.standard_error);
  EXPECT_NE(torque.reason.find("viscous_friction_nms_rad"), std::string::npos);
  expect_pair("resistance_ohm", "back_emf_constant_vs_rad");
  expect_pair("back_emf_constant_vs_rad", "resistance_ohm");
  for (const char* name : {"inertia_kgm2", "inductance_h", "mass_kg", "contact_force_n"})
    EXPECT_FALSE(named(result, name).is_identifiable) << name;
  EXPECT_FALSE(result.is_sufficient);
}

}  // namespace
}  // namespace morepro::host
