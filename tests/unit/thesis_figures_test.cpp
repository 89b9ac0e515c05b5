#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/plant/built_in_machines.hpp"
#include "sim_host/thesis/figure.hpp"
#include "sim_host/thesis/identification_run.hpp"

namespace morepro::host::thesis {
namespace {

const std::vector<Figure>& figures() {
  static const std::vector<Figure> all = all_figures();
  return all;
}

const Figure& figure(int number) {
  for (const Figure& one : figures())
    if (one.number == number) return one;
  throw std::runtime_error("no such figure");
}

const Comparison& comparison(int number, const std::string& quantity) {
  for (const Comparison& one : figure(number).comparisons)
    if (one.quantity == quantity) return one;
  throw std::runtime_error("no such comparison: " + quantity);
}

void expect_range(int number, const std::string& quantity, Range expected, double tolerance) {
  const Range ours = comparison(number, quantity).ours.value();
  EXPECT_NEAR(ours.low, expected.low, tolerance) << quantity;
  EXPECT_NEAR(ours.high, expected.high, tolerance) << quantity;
}

TEST(ThesisFigures, AreThoseThatHoldData) {
  std::vector<int> numbers;
  for (const Figure& one : figures()) numbers.push_back(one.number);
  EXPECT_EQ(numbers, (std::vector{13, 14, 15, 16, 17, 21, 22, 23, 24, 25, 26, 28, 29, 30, 31, 32, 33}));
}

TEST(ThesisFigures, HaveCurvesOfOneLengthComparisonsAndARemark) {
  for (const Figure& one : figures()) {
    EXPECT_FALSE(one.remark.empty()) << one.number;
    EXPECT_FALSE(one.comparisons.empty()) << one.number;
    ASSERT_FALSE(one.charts.empty()) << one.number;
    for (const Chart& chart : one.charts) {
      EXPECT_TRUE(std::is_sorted(chart.x.begin(), chart.x.end())) << one.number;
      for (const Curve& curve : chart.curves) {
        EXPECT_EQ(curve.y.size(), chart.x.size()) << one.number << " " << curve.label;
        EXPECT_TRUE(std::all_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); }));
      }
    }
  }
}

// Values of an independent computation, to the digits that it gave.
TEST(ThesisFigures, FrictionHasTheRangesOfTheIndependentProgram) {
  expect_range(23, "coefficient", {0.1745, 0.4716}, 1.0e-4);
  expect_range(24, "coefficient, n = 80 .. 210 rad/s", {0.227, 0.769}, 1.0e-3);
  expect_range(24, "n where the printed bounds are met", {79.7, 212.8}, 0.1);
  expect_range(24, "n for the bracketed 0.57 .. 0.32 at 0.5 mm", {122.0, 247.0}, 0.5);
  expect_range(25, "coefficient at 480 degC", {0.4347, 0.4347}, 5.0e-5);
  expect_range(25, "coefficient at 550 degC", {0.3753, 0.3753}, 5.0e-5);
  expect_range(25, "exponent that meets both when rounded", {0.5527, 0.5544}, 1.0e-4);
  expect_range(22, "cutting speed over the printed one", {9.549, 9.549}, 1.0e-3);
}

// Predicted 2.85e-6 m for 0.28466 m/s2; the roll accelerates by 1.57 rad/s2.
TEST(ThesisFigures, ClikLagsAsItsTheorySays) {
  const double theory = comparison(17, "h a/(2 K), its theory").ours->low;
  EXPECT_NEAR(theory, 1.0e-3 * 1.5708 / 100.0, 1.0e-8);
  expect_range(17, "CLIK minus closed form, largest", {theory, theory}, 0.01 * theory);
}

TEST(ThesisFigures, ThePrintedResistanceAndBackEmfExplainTheSteadyState) {
  const Comparison& line = comparison(32, "R i/w + Kv at 108.8 rad/s");
  EXPECT_NEAR(line.printed->low, line.ours->low, 1.0e-3);
  EXPECT_NE(figure(31).remark.find("4900 times"), std::string::npos) << figure(31).remark;
}

TEST(ThesisFigures, TheThesisFilterFailsWithConstantInputsOnly) {
  const ParameterValues truth = parameters_of(thesis_machine());
  const auto off = [&](const IdentificationTrace& trace, Parameter parameter) {
    return std::abs(trace.end(parameter) / truth[index_of(parameter)] - 1.0);
  };
  ParameterValues start = truth;
  for (double& value : start) value *= 1.2;
  const auto constant = run_printed_filter({.drive = Drive::kConstant, .start = start});
  const auto excited = run_printed_filter({.drive = Drive::kExcited, .start = start});
  EXPECT_LT(off(constant, Parameter::kTorqueConstant), 0.01);
  for (const Parameter parameter : {Parameter::kInertia, Parameter::kInductance, Parameter::kContactForce})
    EXPECT_GT(off(constant, parameter), 0.1) << index_of(parameter);
  for (std::size_t j = 0; j < kParameterCount; ++j)
    EXPECT_LT(off(excited, static_cast<Parameter>(j)), 0.02) << j;
}

TEST(ThesisFigures, ExcitedTheLibraryFindsAllSevenWithinFourStandardErrors) {
  ParameterValues start = parameters_of(thesis_machine());
  for (double& value : start) value *= 1.2;
  const auto trace = run_library_filter({.drive = Drive::kExcited, .start = start, .seed = 7});
  for (std::size_t j = 0; j < kParameterCount; ++j) {
    const ParameterEstimate& last = trace.last[j];
    EXPECT_EQ(last.status, ParameterStatus::kIdentifiable) << j;
    const double error = double{last.value} - parameters_of(thesis_machine())[j];
    EXPECT_LT(std::abs(error), 4.0 * double{last.standard_error}) << j;
  }
}

TEST(ThesisFigures, WithGuardsConstantInputsMoveNothingAndSayWhatTheyTell) {
  ParameterValues start = parameters_of(thesis_machine());
  for (double& value : start) value *= 1.2;
  const auto constant = run_guarded_filter({.drive = Drive::kConstant, .start = start});
  const auto told = [&](Parameter parameter) { return constant.information[index_of(parameter)]; };
  EXPECT_EQ(told(Parameter::kTorqueConstant), Information::kAlone);
  EXPECT_EQ(told(Parameter::kInertia), Information::kNone);
  EXPECT_EQ(told(Parameter::kInductance), Information::kNone);
  EXPECT_EQ(told(Parameter::kResistance), Information::kPair);
  EXPECT_EQ(constant.partner[index_of(Parameter::kResistance)], Parameter::kBackEmfConstant);
  EXPECT_EQ(told(Parameter::kMass), Information::kPair);
  EXPECT_EQ(constant.partner[index_of(Parameter::kMass)], Parameter::kContactForce);
  const auto longer = run_guarded_filter({.drive = Drive::kConstant, .start = start, .duration_s = 8.0});
  const auto excited = run_guarded_filter({.drive = Drive::kExcited, .start = start});
  for (std::size_t j = 0; j < kParameterCount; ++j) {
    const auto parameter = static_cast<Parameter>(j);
    EXPECT_NEAR(longer.end(parameter) / constant.end(parameter), 1.0, 0.01) << j;
    EXPECT_EQ(excited.information[j], Information::kAlone) << j;
    EXPECT_NEAR(excited.end(parameter) / parameters_of(thesis_machine())[j], 1.0, 0.02) << j;
  }
}

TEST(ThesisFigures, EveryRunBeginsAtItsStart) {
  ParameterValues start = parameters_of(thesis_machine());
  for (std::size_t j = 0; j < kParameterCount; ++j) start[j] *= 0.7 + 0.1 * static_cast<double>(j);
  const IdentificationSetting setting{.drive = Drive::kConstant, .start = start, .duration_s = 0.0};
  const auto printed = run_printed_filter(setting), library = run_library_filter(setting);
  const auto guarded = run_guarded_filter(setting);
  for (std::size_t j = 0; j < kParameterCount; ++j) {
    EXPECT_EQ(printed.value[j].front(), start[j]) << j;
    EXPECT_NEAR(library.value[j].front(), start[j], 1.0e-6 * start[j]) << j;
    EXPECT_NEAR(guarded.value[j].front(), start[j], 1.0e-6 * start[j]) << j;
  }
}

TEST(ThesisFigures, ADifferenceIsSaidInPercentAsAFactorOrByTheEnds) {
  const auto text = [](Range printed, Range ours) {
    return difference_of({.quantity = "", .unit = "", .printed = printed, .ours = ours});
  };
  EXPECT_EQ(text({1.5, 1.5}, {1.5, 1.5}), "none");
  EXPECT_EQ(text({1.45, 1.45}, {1.5, 1.5}), "+3.4 %");
  EXPECT_EQ(text({0.28, 0.28}, {0.6, 0.6}), "+114 %");
  EXPECT_EQ(text({0.49, 0.49}, {1.0e-4, 1.0e-4}), "printed 4900 times ours");
  EXPECT_EQ(text({1.0, 1.0}, {9.549, 9.549}), "ours 9.55 times the printed");
  EXPECT_EQ(text({0.0, 0.0}, {0.5, 0.5}), "+0.5");
  EXPECT_EQ(text({0.0, 5.0}, {2.5, 2.5}), "inside the printed range");
  EXPECT_EQ(text({0.0, 5.0}, {7.0, 7.0}), "2 above the printed range");
  EXPECT_EQ(text({0.2, 0.8}, {0.25, 0.7}), "+0.05 and -0.1 at its ends");
  EXPECT_EQ(difference_of({.quantity = "", .unit = "", .printed = {}, .ours = Range{1, 1}}), "not printed");
  EXPECT_EQ(difference_of({.quantity = "", .unit = "", .printed = Range{1, 1}, .ours = {}}), "undetermined");
}

}  // namespace
}  // namespace morepro::host::thesis
