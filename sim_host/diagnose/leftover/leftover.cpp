#include "sim_host/diagnose/leftover/leftover.hpp"

#include <algorithm>
#include <cmath>

#include "sim_host/diagnose/search/candidate_forms.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kMostStructures = 8;

/// Functions worth the evidence, one after the other, `most` of them.
void take_functions(const AxisFit& fit, const std::vector<gap::EffectForm>& forms,
                    const GapStatistics& statistics, double least_evidence, std::size_t most,
                    Leftover& leftover) {
  const Eigen::MatrixXd moments = statistics.total();
  if (moments.size() == 0) return;
  const Eigen::Index width = moments.cols();
  std::vector<Eigen::Index> active = fit.parameter_columns();
  const auto first = static_cast<Eigen::Index>(active.size());
  const double rows = statistics.total_rows();
  double torque = 0.0;
  for (std::size_t i = 0; i < most; ++i) {
    const Remainder rest = remainder(moments, active, fit.precision(width), fit.target(width));
    double best = 0.0;
    Eigen::Index chosen = first;
    Eigen::VectorXd coefficient;
    for (Eigen::Index column = first; column < width - 1; ++column) {
      const double gain = gain_of(rest, moments, column, 1, coefficient);
      if (gain > best) {
        best = gain;
        chosen = column;
      }
    }
    const double deviance = rows * std::log(rest.rss / std::max(rest.rss - best, 1.0e-9 * rest.rss));
    if (!(deviance > least_evidence)) break;
    active.push_back(chosen);
    leftover.by_functions += deviance;
    leftover.functions.push_back(forms[static_cast<std::size_t>(chosen - first)]);
    if (leftover.functions.back().effect == gap::Effect::kUnnamedTorque) torque += deviance;
  }
  if (!(leftover.by_functions > 0.0)) return;
  leftover.gain = leftover.by_functions;
  leftover.torque_share = leftover.torque_share_of_functions = torque / leftover.gain;
}

void take_lines(LeftLines left, Leftover& leftover) {
  if (!(left.gain > leftover.gain)) return;
  leftover.torque_share = left.of_first_sensor / left.gain;
  leftover.gain = left.gain;
  leftover.lines = std::move(left.lines);
}

}  // namespace

Leftover leftover_of(const AxisFit& fit, double least_evidence) {
  Leftover leftover;
  const auto forms = unnamed_forms(fit.axis(), fit.signals());
  // Mostly there is none, and that is known without what they have in common.
  GapStatistics statistics = fit.collect_with_each(forms);
  take_functions(fit, forms, statistics, least_evidence, 1, leftover);
  if (leftover.gain > 0.0) {
    leftover = {};
    statistics = fit.collect_with(forms);
    take_functions(fit, forms, statistics, least_evidence, kMostStructures, leftover);
  }
  take_lines(lines_left(fit, statistics), leftover);
  return leftover;
}

void tell_lines_from_functions(const AxisFit& with_functions, Leftover& leftover) {
  constexpr double kMostly = 0.5;
  constexpr double kLittle = 0.1;
  if (leftover.lines.empty() || leftover.functions.empty()) return;
  LeftLines rest = lines_left(with_functions, with_functions.innovations());
  const bool explain_lines = rest.gain < kMostly * leftover.gain;
  // What functions take of lines is missing in the rest; and parameters bend to strong lines, which functions
  // then undo.
  const double of_lines = leftover.gain - rest.gain;
  const bool take_lines = of_lines > kMostly * leftover.by_functions;
  const bool take_little = leftover.by_functions < kLittle * leftover.gain;
  leftover.is_lines_only = !explain_lines && (take_lines || take_little);
  if (leftover.is_lines_only) return;
  leftover.lines = std::move(rest.lines);
  if (explain_lines) leftover.torque_share = leftover.torque_share_of_functions;
}

}  // namespace morepro::host
