#include <fmt/format.h>

#include <cmath>

#include "lib/plant/built_in_machines.hpp"
#include "sim_host/replay/names.hpp"
#include "sim_host/thesis/figure.hpp"
#include "sim_host/thesis/identification_run.hpp"
#include "sim_host/thesis/sweep.hpp"

namespace morepro::host::thesis {
namespace {

// Results of section 5.1.2.
constexpr double kPrintedTorqueConstant = 1.45, kPrintedBackEmf = 0.358, kPrintedInductance = 0.49,
                 kPrintedResistance = 0.28;
constexpr Range kPrintedContactForce{0.0, 5.0};

/// A datasheet that is wrong by 30 %, up and down by turns.
ParameterValues wrong_start() {
  ParameterValues start = parameters_of(thesis_machine());
  for (std::size_t j = 0; j < kParameterCount; ++j) start[j] *= j % 2 == 0 ? 1.3 : 1.0 / 1.3;
  return start;
}

/// The true values, except that resistance and back-EMF constant are those that the thesis found.
ParameterValues printed_start() {
  ParameterValues start = parameters_of(thesis_machine());
  start[index_of(Parameter::kResistance)] = kPrintedResistance;
  start[index_of(Parameter::kBackEmfConstant)] = kPrintedBackEmf;
  return start;
}

/// Every run that the figures show.
struct Runs {
  IdentificationTrace printed_constant =
      run_printed_filter({.drive = Drive::kConstant, .start = wrong_start()});
  IdentificationTrace printed_from_print =
      run_printed_filter({.drive = Drive::kConstant, .start = printed_start()});
  IdentificationTrace printed_excited =
      run_printed_filter({.drive = Drive::kExcited, .start = wrong_start()});
  IdentificationTrace guarded_constant =
      run_guarded_filter({.drive = Drive::kConstant, .start = wrong_start()});
  IdentificationTrace guarded_excited =
      run_guarded_filter({.drive = Drive::kExcited, .start = wrong_start()});
  IdentificationTrace ours_constant = run_library_filter({.drive = Drive::kConstant, .start = wrong_start()});
  IdentificationTrace ours_excited = run_library_filter({.drive = Drive::kExcited, .start = wrong_start()});
  ParameterValues truth = parameters_of(thesis_machine());
  SteadyState steady = steady_state();
};

Comparison library_comparison(const std::string& quantity, const std::string& unit,
                              const ParameterEstimate& estimate, double truth, std::optional<Range> printed) {
  Comparison comparison{.quantity = quantity, .unit = unit, .printed = printed, .ours = {}};
  if (estimate.status == ParameterStatus::kIdentifiable) {
    const double value{estimate.value}, error{estimate.standard_error};
    comparison.ours = single(value);
    comparison.note =
        fmt::format("standard error {:.2g}, {:.1f} of them off", error, std::abs(value - truth) / error);
  } else {
    comparison.note = fmt::format("undetermined: {}", reason_of(estimate));
  }
  return comparison;
}

/// Of the thesis's filter with its guards: the value where the last window told it by itself.
Comparison guarded_comparison(const std::string& quantity, const std::string& unit,
                              const IdentificationTrace& trace, Parameter parameter,
                              std::optional<Range> printed) {
  Comparison comparison{.quantity = quantity, .unit = unit, .printed = printed, .ours = {}};
  switch (trace.information[index_of(parameter)]) {
    case Information::kAlone:
      comparison.ours = single(trace.end(parameter));
      break;
    case Information::kPair:
      comparison.note = fmt::format("undetermined: only a combination with {} is told",
                                    name_of(trace.partner[index_of(parameter)]));
      break;
    case Information::kNone:
      comparison.note = "undetermined: nothing tells it, so it is frozen";
      break;
  }
  return comparison;
}

Figure figure_of(int number, Parameter parameter, const std::string& title, const std::string& unit,
                 std::optional<Range> printed, const Runs& runs) {
  const std::size_t j = index_of(parameter);
  Figure figure{.number = number, .section = "5.1.2", .title = title};
  const auto nominal = std::vector<double>(runs.printed_constant.time_s.size(), runs.truth[j]);
  figure.charts = {
      {.title = title,
       .unit = unit,
       .x_name = "time, s",
       .x = runs.printed_constant.time_s,
       .curves = {{"the thesis's filter, constant inputs", runs.printed_constant.value[j]},
                  {"the thesis's filter, excited", runs.printed_excited.value[j]},
                  {"the thesis's filter, guarded, constant inputs", runs.guarded_constant.value[j]},
                  {"this library, excited", runs.ours_excited.value[j]},
                  {"true value", nominal, true}}}};
  // Beside a printed value that is thousands of times larger no curve would be seen.
  constexpr double kLargestOnTheChart = 5.0;
  if (printed && printed->low == printed->high && printed->low < kLargestOnTheChart * runs.truth[j])
    figure.charts.front().curves.push_back(
        {"printed", std::vector<double>(nominal.size(), printed->low), true});
  figure.comparisons = {
      {.quantity = "true value of the simulated machine",
       .unit = unit,
       .printed = printed,
       .ours = single(runs.truth[j])},
      {.quantity = "the thesis's filter, constant inputs",
       .unit = unit,
       .printed = printed,
       .ours = single(runs.printed_constant.end(parameter))},
      {.quantity = "the thesis's filter, excited",
       .unit = unit,
       .printed = printed,
       .ours = single(runs.printed_excited.end(parameter))},
      guarded_comparison("the thesis's filter, guarded, constant inputs", unit, runs.guarded_constant,
                         parameter, printed),
      guarded_comparison("the thesis's filter, guarded, excited", unit, runs.guarded_excited, parameter,
                         printed),
      library_comparison("this library, constant inputs", unit, runs.ours_constant.last[j], runs.truth[j],
                         printed),
      library_comparison("this library, excited", unit, runs.ours_excited.last[j], runs.truth[j], printed)};
  return figure;
}

/// On the steady state only V = R i + Kv w is seen: every pair on that line explains the data.
Comparison null_line(const Runs& runs) {
  const auto [voltage, speed, current] = runs.steady;
  return {.quantity = fmt::format("R i/w + Kv at {:.1f} rad/s", speed),
          .unit = "V s/rad",
          .printed = single(kPrintedResistance * current / speed + kPrintedBackEmf),
          .ours = single(voltage / speed)};
}

/// What the pair that the thesis prints becomes when its filter starts from it.
Comparison from_print(const Runs& runs, Parameter parameter, const std::string& unit, double printed) {
  return {.quantity = "the thesis's filter, started from the printed pair",
          .unit = unit,
          .printed = single(printed),
          .ours = single(runs.printed_from_print.end(parameter))};
}

Figure contact_force(const Runs& runs) {
  Figure figure = figure_of(28, Parameter::kContactForce, "Trend of F2", "N", kPrintedContactForce, runs);
  figure.remark =
      "With constant inputs only (F1 - F2 - c)/m is seen: mass and contact force lie on one line, so a "
      "changing F2 is no finding. "
      "The printed range holds the true value and everything around it.";
  return figure;
}

Figure torque_constant(const Runs& runs) {
  Figure figure =
      figure_of(29, Parameter::kTorqueConstant, "Trend of Kt", "N m/A", single(kPrintedTorqueConstant), runs);
  const double truth = runs.truth[index_of(Parameter::kTorqueConstant)];
  figure.remark = fmt::format(
      "The one parameter that constant inputs determine, because friction and contact torque are taken as "
      "known: the print is {:.1f} % off.",
      100.0 * std::abs(kPrintedTorqueConstant / truth - 1.0));
  return figure;
}

Figure back_emf(const Runs& runs) {
  Figure figure =
      figure_of(30, Parameter::kBackEmfConstant, "Trend of Kv", "V s/rad", single(kPrintedBackEmf), runs);
  figure.comparisons.push_back(null_line(runs));
  figure.comparisons.push_back(from_print(runs, Parameter::kBackEmfConstant, "V s/rad", kPrintedBackEmf));
  const double truth = runs.truth[index_of(Parameter::kBackEmfConstant)];
  figure.remark = fmt::format(
      "The printed value is {:+.0f} % off and yet fits: with constant inputs R and Kv only appear as R i/w + "
      "Kv, and the printed pair lies on that line.",
      100.0 * (kPrintedBackEmf / truth - 1.0));
  return figure;
}

Figure inductance(const Runs& runs) {
  Figure figure = figure_of(31, Parameter::kInductance, "Trend of L", "H", single(kPrintedInductance), runs);
  const double truth = runs.truth[index_of(Parameter::kInductance)];
  figure.remark = fmt::format(
      "L = {:.2f} H is {:.0f} times the nominal value: R and Kv lie on a null line, and the column of L is "
      "the current's rate, "
      "which is zero with constant inputs, so nothing in the data speaks of L.",
      kPrintedInductance, kPrintedInductance / truth);
  return figure;
}

Figure resistance(const Runs& runs) {
  Figure figure =
      figure_of(32, Parameter::kResistance, "Trend of R", "ohm", single(kPrintedResistance), runs);
  figure.comparisons.push_back(null_line(runs));
  figure.comparisons.push_back(from_print(runs, Parameter::kResistance, "ohm", kPrintedResistance));
  const double truth = runs.truth[index_of(Parameter::kResistance)];
  figure.remark = fmt::format(
      "{:+.0f} % off, on the same line as figure 30: the thesis's filter ends on it at {:.2f} ohm from one "
      "start and at "
      "{:.2f} ohm from another, where prior and noise put it. Table 2 prints {:g} kohm, which must be ohm: "
      "with kohm "
      "the spindle would hardly turn.",
      100.0 * (kPrintedResistance / truth - 1.0), runs.printed_constant.end(Parameter::kResistance),
      runs.printed_from_print.end(Parameter::kResistance), truth);
  return figure;
}

Figure rising(const Runs& runs) {
  Figure figure = figure_of(33, Parameter::kInertia, "Inertia", "kg m2", {}, runs);
  const Figure mass = figure_of(33, Parameter::kMass, "Mass", "kg", {}, runs);
  figure.title = "Parameters that are not within the expected range";
  figure.charts.push_back(mass.charts.front());
  for (Comparison& comparison : figure.comparisons) comparison.quantity = "inertia: " + comparison.quantity;
  for (Comparison comparison : mass.comparisons) {
    comparison.quantity = "mass: " + comparison.quantity;
    figure.comparisons.push_back(comparison);
  }
  const auto growth = [&](Parameter parameter) {
    const auto& values = runs.printed_from_print.value[index_of(parameter)];
    return 100.0 * (values.back() / values.front() - 1.0);
  };
  figure.comparisons.push_back({.quantity = "inertia: growth from the true value in 4 s",
                                .unit = "%",
                                .printed = {},
                                .ours = single(growth(Parameter::kInertia)),
                                .note = "printed: increasing"});
  figure.remark =
      "Not a lack of correlation: their columns are the accelerations, which are zero with constant inputs, "
      "so their variance only grows, and noise in "
      "the regressors pushes the estimate in one direction. With excitation both are found.";
  return figure;
}

}  // namespace

std::vector<Figure> identification_figures() {
  const Runs runs;
  return {contact_force(runs), torque_constant(runs), back_emf(runs),
          inductance(runs),    resistance(runs),      rising(runs)};
}

}  // namespace morepro::host::thesis
