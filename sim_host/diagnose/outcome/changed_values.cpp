#include "sim_host/diagnose/outcome/changed_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim_host/diagnose/leftover/leftover.hpp"
#include "sim_host/diagnose/outcome/parameter_report.hpp"
#include "sim_host/diagnose/search/onset.hpp"

namespace morepro::host {
namespace {

using Parts = std::array<AxisFit, 2>;

/// A model of what comes before a time, and of what comes after.
Parts parts_of(const AxisFit& fit, double time_s) {
  Parts parts{fit, fit};
  parts[0].look_until(time_s);
  parts[1].look_at_the_end(time_s);
  return parts;
}

/// Short enough that little of one machine is taken for the other's.
GapStatistics in_short_blocks(const AxisFit& fit) {
  constexpr double kMostBlocks = 2000.0;
  constexpr double kShortestS = 0.01;
  const double block_s = std::max(fit.signals().duration_s() / kMostBlocks, kShortestS);
  return collect(fit.axis(), fit.signals(), all_of(fit.signals()), fit.model(), Disturbances{},
                 fit.whitening(), block_s);
}

/// `fit` from the noise that there is, and from little: what one model has needed for all of the recording
/// hides how well it does for a part.
void fit_from_both_noises(AxisFit& part, void (*fit)(AxisFit&)) {
  AxisFit quiet = part;
  fit(part);
  quiet.expect_little_noise();
  fit(quiet);
  if (quiet.unlikeliness() < part.unlikeliness()) part = std::move(quiet);
}

double unlikeliness_of(const Parts& parts) { return parts[0].unlikeliness() + parts[1].unlikeliness(); }

/// Each part with the noise that suits it, which none of the models to compare is to gain by.
Parts with_noise_of_parts(const AxisFit& fit, double time_s) {
  Parts parts = parts_of(fit, time_s);
  for (AxisFit& part : parts) fit_from_both_noises(part, [](AxisFit& one) { one.match_noise(); });
  return parts;
}

Parts with_values_of_parts(const AxisFit& fit, double time_s) {
  Parts parts = parts_of(fit, time_s);
  for (AxisFit& part : parts) fit_from_both_noises(part, [](AxisFit& one) { one.polish(); });
  return parts;
}

/// Is something left of which neither machine knows? Then its cause is no change of their values.
bool leaves_structure(const Parts& parts, double gained, double least_evidence) {
  constexpr double kLittle = 0.1;
  double left = 0.0;
  for (const AxisFit& part : parts) left += leftover_of(part, least_evidence).gain;
  return left > kLittle * gained;
}

/// Is the common factor of a spindle's torques known in neither part, or in one only?
bool has_free_factor(const Parts& parts) {
  return parts[0].axis() == Axis::kSpindle && !(parts[0].tells(0) && parts[1].tells(0));
}

/// Of the ways that an axis goes in a stretch, forwards and backwards, the net one as a share of all: 1 where
/// it only goes forwards.
double net_share(const AxisFit& fit, Stretch stretch) {
  constexpr double kStepS = 0.02;  // of a position, so long that its noise is no way
  const RecordingSignals& signals = fit.signals();
  const Channel speed = fit.axis() == Axis::kSpindle ? Channel::kSpindleSpeed : Channel::kFeedSpeed;
  const bool has_speed = signals.has(speed);
  const auto& column = signals.value[index_of(has_speed ? speed : Channel::kFeedPosition)];
  const std::size_t step =
      has_speed ? 1 : std::max<std::size_t>(1, static_cast<std::size_t>(kStepS * signals.rate_hz));
  double net = 0.0;
  double all = 0.0;
  for (std::size_t i = stretch.first + step; i < std::min(stretch.last, column.size()); i += step) {
    const double way = static_cast<double>(has_speed ? column[i] : column[i] - column[i - step]);
    if (std::isnan(way)) continue;
    net += way;
    all += std::fabs(way);
  }
  return all > 0.0 ? net / all : 0.0;
}

/// Does it only go one way before a time, and only the other way after it? Then what depends on the direction
/// is another machine's as well.
bool turns_for_good(const AxisFit& fit, double time_s) {
  constexpr double kOneWay = 0.8;
  const Stretch end = after(fit.signals(), time_s);
  const double before = net_share(fit, {0, end.first});
  const double later = net_share(fit, end);
  return before * later < 0.0 && std::min(std::fabs(before), std::fabs(later)) > kOneWay;
}

/// The parameters of a part, with friction and inertia as shares of the torque constant.
std::vector<ParameterResult> for_one_torque_constant(const AxisFit& part) {
  constexpr double kLeastError = 0.004;  // relative: less than that is rounding, of two that all but agree
  std::vector<ParameterResult> values = parameters_of(part);
  const Eigen::MatrixXd& covariance = part.covariance();
  const double torque_constant = values.front().refit;
  values.front().is_identifiable = false;
  for (Eigen::Index i = 1; i < std::min(kTorqueParameters, covariance.cols()); ++i) {
    ParameterResult& value = values[static_cast<std::size_t>(i)];
    const double variance = covariance(0, 0) + covariance(i, i) - 2.0 * covariance(i, 0);
    const double error = std::max(std::sqrt(std::max(variance, 0.0)), kLeastError);
    value.refit /= torque_constant;
    value.standard_error = error * std::fabs(value.refit);
    value.is_identifiable = error < kTold;
  }
  return values;
}

/// Friction and loads may depend on the direction, nothing else does.
bool may_depend_on_direction(std::string_view value) {
  return value.find("friction") != std::string_view::npos || value.find("contact") != std::string_view::npos;
}

/// Values that both parts tell, and tell apart, and more than what depends on a direction that only one of
/// them has. Are there any?
bool tell_values(const Parts& parts, ChangedValues& changed) {
  constexpr double kSurely = 5.0;  // standard errors
  constexpr double kNoticeably = 0.02;
  const bool has_factor = has_free_factor(parts);
  const auto before = has_factor ? for_one_torque_constant(parts[0]) : parameters_of(parts[0]);
  const auto after = has_factor ? for_one_torque_constant(parts[1]) : parameters_of(parts[1]);
  std::vector<std::string> told;
  double torques = 0.0;
  bool may_be_direction = turns_for_good(parts[0], changed.time_s);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double change = std::fabs(after[i].refit - before[i].refit);
    const double error = std::hypot(before[i].standard_error, after[i].standard_error);
    if (!before[i].is_identifiable || !after[i].is_identifiable) continue;
    if (!(change > kSurely * error && change > kNoticeably * std::fabs(before[i].refit))) continue;
    const bool is_torque = i < static_cast<std::size_t>(kTorqueParameters);
    told.push_back(fmt::format("{} is {:.3g} times as large{}", before[i].name,
                               after[i].refit / before[i].refit,
                               has_factor && is_torque ? " for one torque constant" : ""));
    torques += is_torque ? 1.0 : 0.0;
    may_be_direction = may_be_direction && may_depend_on_direction(before[i].name);
  }
  if (told.empty() || may_be_direction) return false;
  changed.torque_share = torques / static_cast<double>(told.size());
  changed.words = fmt::format("the machine's values, which are others from about {:.4g} s on: {}",
                              changed.time_s, fmt::join(told, ", "));
  return true;
}

}  // namespace

std::optional<ChangedValues> changed_values_of(const AxisDiagnosis& diagnosis, double least_evidence) {
  constexpr double kMayBe = 0.1;  // of what names take, beside the noise that one machine needs
  constexpr double kSurely = 1.05;
  const AxisFit& nominal = diagnosis.nominal;
  const GapStatistics statistics = in_short_blocks(nominal);
  const auto parameters = static_cast<Eigen::Index>(parameter_count(nominal.axis()));
  const LateStart start = best_start(nominal, statistics, 0, parameters);
  const double rows = statistics.total_rows();
  if (!is_surely_late(start, rows)) return std::nullopt;
  const double promised = rows * std::log(start.rss_without / start.rss);
  if (promised < kMayBe * diagnosis.named_deviance()) return std::nullopt;
  const double one_machine = unlikeliness_of(with_noise_of_parts(nominal, start.onset_s));
  const double named = one_machine - unlikeliness_of(with_noise_of_parts(diagnosis.fit, start.onset_s));
  const Parts two_machines = with_values_of_parts(nominal, start.onset_s);
  const double by_chance = static_cast<double>(parameters + 1) * std::log(rows + 2.0);
  const double gained = one_machine - unlikeliness_of(two_machines) - by_chance;
  if (!(gained > kSurely * named)) return std::nullopt;
  ChangedValues changed{.time_s = start.onset_s, .deviance = gained, .words = {}};
  if (!tell_values(two_machines, changed) || leaves_structure(two_machines, gained, least_evidence))
    return std::nullopt;
  return changed;
}

}  // namespace morepro::host
