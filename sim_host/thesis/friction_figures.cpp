#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/friction_models.hpp"
#include "sim_host/thesis/machining_figures.hpp"
#include "sim_host/thesis/sweep.hpp"

namespace morepro::host::thesis {
namespace {

// The temperatures of figure 25.
constexpr Range kTemperatureDegc{480.0, 550.0};
/// Equation 15 to the letter.
double equation15(double spindle_speed, double chip_load_mm) {
  static const FrictionModels<double> models(thesis_machine());
  return models.machining_speed(spindle_speed, chip_load_mm).beta;
}

double equation17(double spindle_speed, double chip_load_mm, double degc) {
  static const FrictionModels<double> models(thesis_machine());
  return models.product(spindle_speed, chip_load_mm, degc).beta;
}

double thermal(double degc, double exponent = thesis_machine().thermal.exponent) {
  MachineParameters machine = thesis_machine();
  machine.thermal.exponent = exponent;
  return FrictionModels<double>(machine).temperature(degc).beta;
}

/// The literal equation 15 at the ends of figure 24, and where it takes the printed bounds.
struct LiteralRange {
  double slowest = where([](double n) { return equation15(n, kPrintedChipLoadMm.low); }, 0.77, {1.0, 1000.0});
  double fastest =
      where([](double n) { return equation15(n, kPrintedChipLoadMm.high); }, 0.22, {1.0, 1000.0});
};

Figure figure24() {
  Figure figure{.number = 24, .section = "4.3", .title = "Friction by spindle speed (equation 15)"};
  const Range speeds{80.0, 210.0};
  Chart chart{.title = "Friction coefficient, literal",
              .unit = "1",
              .x_name = "n, rad/s",
              .x = steps(speeds),
              .curves = {}};
  for (const double chip : {0.1, 0.3, 0.5, 0.8, 1.1})
    chart.curves.push_back(
        curve(fmt::format("{:g} mm", chip), chart.x, [chip](double n) { return equation15(n, chip); }));
  figure.charts = {chart};
  const Range ours{equation15(speeds.high, kPrintedChipLoadMm.high),
                   equation15(speeds.low, kPrintedChipLoadMm.low)};
  const LiteralRange bounds;
  const auto middle = [](double n) { return equation15(n, 0.5); };
  figure.comparisons = {
      {.quantity = "coefficient, n = 80 .. 210 rad/s",
       .unit = "1",
       .printed = Range{0.22, 0.77},
       .ours = ours},
      {.quantity = "n where the printed bounds are met",
       .unit = "rad/s",
       .printed = {},
       .ours = Range{bounds.slowest, bounds.fastest}},
      {.quantity = "n for the bracketed 0.57 .. 0.32 at 0.5 mm",
       .unit = "rad/s",
       .printed = {},
       .ours = Range{where(middle, 0.57, {1.0, 1000.0}), where(middle, 0.32, {1.0, 1000.0})}}};
  figure.remark = fmt::format(
      "The range is met with chip loads entered in metres and one number n = {:.1f} .. {:.1f} in both terms; "
      "in millimetres "
      "the coefficient would be negative. The unit of n and the bracketed second range cannot be determined.",
      bounds.slowest, bounds.fastest);
  return figure;
}

/// Exponents with which a printed value is met after rounding to its two digits.
Range exponents_for(double degc, double printed) {
  const auto falls = [degc](double exponent) { return -thermal(degc, exponent); };
  return {where(falls, -(printed - 0.005), {0.1, 2.0}), where(falls, -(printed + 0.005), {0.1, 2.0})};
}

Figure figure25() {
  Figure figure{.number = 25, .section = "4.3", .title = "Friction by temperature (equation 16)"};
  Chart chart{.title = "Friction coefficient",
              .unit = "1",
              .x_name = "temperature, degC",
              .x = steps({380.0, 700.0}),
              .curves = {}};
  chart.curves = {curve("1/sqrt(3) th(T)", chart.x, [](double degc) { return thermal(degc); })};
  figure.charts = {chart};
  const Range cold = exponents_for(kTemperatureDegc.low, 0.43),
              hot = exponents_for(kTemperatureDegc.high, 0.38);
  const Range both{std::max(cold.low, hot.low), std::min(cold.high, hot.high)};
  figure.comparisons = {
      {.quantity = "coefficient at 480 degC",
       .unit = "1",
       .printed = single(0.43),
       .ours = single(thermal(kTemperatureDegc.low))},
      {.quantity = "coefficient at 550 degC",
       .unit = "1",
       .printed = single(0.38),
       .ours = single(thermal(kTemperatureDegc.high))},
      {.quantity = "exponent that meets both when rounded", .unit = "1", .printed = {}, .ours = both}};
  figure.remark = fmt::format(
      "The exponent is not printed; only {:.4f} .. {:.4f} gives both values after rounding, the built-in "
      "machine has {:g}.",
      both.low, both.high, thesis_machine().thermal.exponent);
  return figure;
}

Figure figure26() {
  Figure figure{.number = 26, .section = "4.3", .title = "Global effect (equation 17)"};
  const Range speeds{80.0, 210.0};
  std::vector<double> values;
  for (const double degc : {kTemperatureDegc.low, kTemperatureDegc.high}) {
    Chart chart{.title = fmt::format("Friction coefficient at {:g} degC", degc),
                .unit = "1",
                .x_name = "n, rad/s",
                .x = steps(speeds),
                .curves = {}};
    for (const double chip : {0.1, 0.5, 1.1})
      chart.curves.push_back(
          curve(fmt::format("{:g} mm", chip), chart.x, [=](double n) { return equation17(n, chip, degc); }));
    for (const Curve& one : chart.curves) values.insert(values.end(), one.y.begin(), one.y.end());
    figure.charts.push_back(chart);
  }
  const double cold = equation17(100.0, 0.5, kTemperatureDegc.low),
               hot = equation17(100.0, 0.5, kTemperatureDegc.high);
  figure.comparisons = {{.quantity = "coefficient", .unit = "1", .printed = {}, .ours = range_of(values)},
                        {.quantity = "550 over 480 degC (print: of figure 25)",
                         .unit = "1",
                         .printed = single(0.38 / 0.43),
                         .ours = single(hot / cold)}};
  figure.remark =
      "No values are printed. The product counts temperature twice: equation 12 was fitted to cutting tests "
      "in which the tool was hot already.";
  return figure;
}

}  // namespace

std::vector<Figure> friction_figures() {
  return {cited_figure(), speeds_figure(), equation12_figure(), figure24(), figure25(), figure26()};
}

}  // namespace morepro::host::thesis
