#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/friction_models.hpp"
#include "sim_host/thesis/figure.hpp"

namespace morepro::host::thesis {
namespace {

// What the thesis prints: the range of chip loads in section 4.3, the temperatures of figure 25.
constexpr Range kChipLoadMm{0.1, 1.1};
constexpr Range kTemperatureDegc{480.0, 550.0};
constexpr int kPoints = 121;

std::vector<double> steps(Range range) {
  std::vector<double> values;
  for (int k = 0; k < kPoints; ++k)
    values.push_back(range.low + (range.high - range.low) * k / (kPoints - 1));
  return values;
}

Curve curve(std::string label, const std::vector<double>& x, const std::function<double(double)>& f) {
  Curve result{.label = std::move(label), .y = {}};
  for (const double value : x) result.y.push_back(f(value));
  return result;
}

/// Where a falling function takes a value, by bisection.
double where(const std::function<double(double)>& f, double value, Range range) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (range.low + range.high);
    (f(middle) > value ? range.low : range.high) = middle;
  }
  return range.low;
}

Range single(double value) { return {value, value}; }

/// Equation 12 by cutting speed in m/min and feed in mm per revolution.
double equation12(double cutting_speed, double feed) {
  static const MachineParameters machine = reference_machine();
  static const FrictionModels<double> models(machine);
  static const ContactLaw<double> law(machine);
  return models.machining_speed(cutting_speed / law.cutting_speed_scale(), feed / machine.tool.teeth).beta;
}

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

constexpr Range kSpeedRange{ContactRange::kLowestCuttingSpeed, ContactRange::kHighestCuttingSpeed};
constexpr Range kFeedRange{ContactRange::kLowestFeed, ContactRange::kHighestFeed};

Chart equation12_chart() {
  Chart chart{.title = "Friction coefficient",
              .unit = "1",
              .x_name = "cutting speed, m/min",
              .x = steps(kSpeedRange),
              .curves = {}};
  for (const double feed : {kFeedRange.low, 0.2, 0.33, kFeedRange.high})
    chart.curves.push_back(
        curve(fmt::format("{:g} mm/rev", feed), chart.x, [feed](double v) { return equation12(v, feed); }));
  return chart;
}

Figure figure21() {
  Figure figure{.number = 21, .section = "4.2.2", .title = "Friction coefficient by cutting speed"};
  figure.charts = {equation12_chart()};
  const double low = equation12(kSpeedRange.high, kFeedRange.low),
               high = equation12(kSpeedRange.low, kFeedRange.low);
  figure.comparisons = {
      {.quantity = "coefficient at the smallest feed", .unit = "1", .printed = {}, .ours = Range{low, high}}};
  figure.remark =
      "The figure is cited from another work: measurements, dry, wet and with minimum lubrication. Equation "
      "12 is the "
      "one formula that the thesis takes from it; the other curves have no formula and are not recomputed.";
  return figure;
}

/// The literal equation 15 at the ends of figure 24, and where it takes the printed bounds.
struct LiteralRange {
  double slowest = where([](double n) { return equation15(n, kChipLoadMm.low); }, 0.77, {1.0, 1000.0});
  double fastest = where([](double n) { return equation15(n, kChipLoadMm.high); }, 0.22, {1.0, 1000.0});
};

Figure figure22() {
  const ContactLaw<double> literal(thesis_machine());
  MachineParameters machine = thesis_machine();
  machine.contact.form = ContactForm::kConsistent;
  const ContactLaw<double> consistent(machine);
  Figure figure{.number = 22, .section = "4.2.2", .title = "Machining speeds (equations 13 and 14)"};
  Chart chart{.title = "Cutting speed",
              .unit = "m/min",
              .x_name = "spindle speed, rad/s",
              .x = steps({0.0, 250.0}),
              .curves = {}};
  chart.curves = {
      curve("as printed, n in rad/s", chart.x, [&](double n) { return literal.cutting_speed_scale() * n; }),
      curve("consistent", chart.x, [&](double n) { return consistent.cutting_speed_scale() * n; })};
  figure.charts = {chart};
  const double ratio = consistent.cutting_speed_scale() / literal.cutting_speed_scale();
  const double legal_low = kFeedRange.low / machine.tool.teeth,
               legal_high = kFeedRange.high / machine.tool.teeth;
  figure.comparisons = {{.quantity = "cutting speed over the printed one",
                         .unit = "1",
                         .printed = single(1.0),
                         .ours = single(ratio)},
                        {.quantity = "chip loads inside equation 12's range",
                         .unit = "mm",
                         .printed = kChipLoadMm,
                         .ours = Range{legal_low, legal_high}}};
  figure.remark = fmt::format(
      "Equation 13 wants revolutions per minute; with rad/s the cutting speed is {:.2f} times too small. "
      "Equation 14 is "
      "in mm/min, equation 12 wants mm per revolution: {:g} teeth leave {:.3f} .. {:.3f} mm of chip load.",
      ratio, machine.tool.teeth, legal_low, legal_high);
  return figure;
}

Figure figure23() {
  Figure figure{
      .number = 23, .section = "4.3", .title = "Friction by feed rate and cutting speed (equation 12)"};
  figure.charts = {equation12_chart()};
  std::vector<double> values;
  for (const double speed : steps(kSpeedRange))
    for (const double feed : steps(kFeedRange)) values.push_back(equation12(speed, feed));
  const Range ours = range_of(values);
  figure.comparisons = {{.quantity = "coefficient", .unit = "1", .printed = Range{0.15, 0.45}, .ours = ours}};
  figure.remark = fmt::format(
      "On the stated box of speeds and feeds equation 12 gives {:.4f} .. {:.4f}; the printed range looks "
      "like the limits of an axis.",
      ours.low, ours.high);
  return figure;
}

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
  const Range ours{equation15(speeds.high, kChipLoadMm.high), equation15(speeds.low, kChipLoadMm.low)};
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
  return {figure21(), figure22(), figure23(), figure24(), figure25(), figure26()};
}

}  // namespace morepro::host::thesis
