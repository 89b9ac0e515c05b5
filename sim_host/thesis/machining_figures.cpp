#include "sim_host/thesis/machining_figures.hpp"

#include <fmt/format.h>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/friction_models.hpp"
#include "sim_host/thesis/sweep.hpp"

namespace morepro::host::thesis {
namespace {

/// Equation 12 by cutting speed in m/min and feed in mm per revolution.
double equation12(double cutting_speed, double feed) {
  static const MachineParameters machine = reference_machine();
  static const FrictionModels<double> models(machine);
  static const ContactLaw<double> law(machine);
  return models.machining_speed(cutting_speed / law.cutting_speed_scale(), feed / machine.tool.teeth).beta;
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

}  // namespace

Figure cited_figure() {
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

Figure speeds_figure() {
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
                         .printed = kPrintedChipLoadMm,
                         .ours = Range{legal_low, legal_high}}};
  figure.remark = fmt::format(
      "Equation 13 wants revolutions per minute; with rad/s the cutting speed is {:.2f} times too small. "
      "Equation 14 is "
      "in mm/min, equation 12 wants mm per revolution: {:g} teeth leave {:.3f} .. {:.3f} mm of chip load.",
      ratio, machine.tool.teeth, legal_low, legal_high);
  return figure;
}

Figure equation12_figure() {
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

}  // namespace morepro::host::thesis
