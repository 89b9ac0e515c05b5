#include "sim_host/diagnose/balances/where.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim_host/diagnose/balances/order_cells.hpp"
#include "sim_host/diagnose/balances/significance.hpp"
#include "sim_host/diagnose/balances/window_rows.hpp"
#include "sim_host/diagnose/search/onset.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kTimeCells = 8;

/// Mean of a recorded signal over a window.
class WindowMean {
 public:
  explicit WindowMean(const RecordingSignals& signals) : signals_(signals) {}
  double operator()(Channel channel, std::size_t first) const {
    const auto& column = signals_.value[index_of(channel)];
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = first; i < std::min(first + kWindowLength, column.size()); i += 8) {
      if (!(column[i] == column[i])) continue;
      sum += static_cast<double>(column[i]);
      count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
  }

 private:
  const RecordingSignals& signals_;
};

struct Powers {
  const std::vector<WindowPower>& before;
  const std::vector<WindowPower>& after;
};

template <class Chosen>
GapCell cell_of(std::string_view by, double from, double to, const Powers& powers, Chosen chosen) {
  double before = 0.0;
  double after = 0.0;
  double rows = 0.0;
  for (std::size_t i = 0; i < std::min(powers.before.size(), powers.after.size()); ++i) {
    for (std::size_t band = 0; band < kBands; ++band) {
      if (!chosen(i, band)) continue;
      before += rows_of_band(band) * powers.before[i].power[band];
      after += rows_of_band(band) * powers.after[i].power[band];
      rows += rows_of_band(band);
    }
  }
  const double ratio = after > 0.0 ? before / after : 1.0;
  return {by, from, to, ratio, p_value_of(ratio, kOverlap * rows)};
}

void add_range_cells(std::string_view by, const std::vector<double>& value, const Powers& powers,
                     std::vector<GapCell>& cells) {
  constexpr std::size_t kRanges = 3;
  std::vector<double> sorted = value;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || !(sorted.back() > sorted.front())) return;
  for (std::size_t r = 0; r < kRanges; ++r) {
    const double from = sorted[r * (sorted.size() - 1) / kRanges];
    const double to = sorted[(r + 1) * (sorted.size() - 1) / kRanges];
    const bool is_last = r + 1 == kRanges;
    cells.push_back(cell_of(by, from, to, powers, [&](std::size_t i, std::size_t) {
      return value[i] >= from && (value[i] < to || (is_last && value[i] <= to));
    }));
  }
}

void add_side_cells(std::string_view by, const std::vector<double>& value, const Powers& powers, double least,
                    std::vector<GapCell>& cells, double low, double high) {
  const bool has_low = std::any_of(value.begin(), value.end(), [least](double v) { return v <= least; });
  const bool has_high = std::any_of(value.begin(), value.end(), [least](double v) { return v > least; });
  if (!has_low || !has_high) return;
  cells.push_back(
      cell_of(by, low, low, powers, [&](std::size_t i, std::size_t) { return value[i] <= least; }));
  cells.push_back(
      cell_of(by, high, high, powers, [&](std::size_t i, std::size_t) { return value[i] > least; }));
}

std::vector<GapCell> cells_of(Axis axis, const RecordingSignals& signals, const Powers& powers) {
  std::vector<GapCell> cells;
  const std::size_t windows = std::min(powers.before.size(), powers.after.size());
  const WindowMean mean(signals);
  const auto means = [&](Channel channel) {
    std::vector<double> values;
    for (std::size_t i = 0; i < windows; ++i) values.push_back(mean(channel, powers.before[i].first));
    return values;
  };
  if (signals.has(Channel::kContact))
    add_side_cells("contact", means(Channel::kContact), powers, 0.5, cells, 0, 1);
  const Channel speed = axis == Axis::kSpindle ? Channel::kSpindleSpeed : Channel::kFeedSpeed;
  if (signals.has(speed)) {
    std::vector<double> values = means(speed);
    add_side_cells("direction", values, powers, 0.0, cells, -1, 1);
    for (double& value : values) value = std::fabs(value);
    add_range_cells("speed", values, powers, cells);
  }
  const Channel heat = axis == Axis::kSpindle && signals.has(Channel::kWindingTemperature)
                           ? Channel::kWindingTemperature
                           : Channel::kToolTemperature;
  if (signals.has(heat)) add_range_cells("temperature", means(heat), powers, cells);
  const double resolution_hz = signals.rate_hz / static_cast<double>(kWindowLength);
  for (std::size_t band = 0; band < kBands; ++band) {
    const double centre = kBandPeriods[band] * resolution_hz;
    cells.push_back(cell_of("frequency", std::max(centre - 1.5 * resolution_hz, 0.0),
                            centre + 1.5 * resolution_hz, powers,
                            [band](std::size_t, std::size_t b) { return b == band; }));
  }
  // Windows overlap by half; cells meet where the middles of neighbours do.
  const auto border_s = [&](std::size_t window) {
    if (window == 0) return signals.time_s(powers.before.front().first);
    if (window == windows) return signals.time_s(powers.before.back().first + kWindowLength);
    return signals.time_s(powers.before[window].first + kWindowLength / 4);
  };
  for (std::size_t t = 0; t < kTimeCells && windows >= kTimeCells; ++t) {
    const std::size_t from = t * windows / kTimeCells;
    const std::size_t to = (t + 1) * windows / kTimeCells;
    cells.push_back(cell_of("time", border_s(from), border_s(to), powers,
                            [from, to](std::size_t i, std::size_t) { return i >= from && i < to; }));
  }
  return cells;
}

BalanceResult balance_of(const BalanceRows& rows, const AxisDiagnosis& diagnosis) {
  BalanceResult result{.balance = rows.balance};
  result.is_evaluated = !diagnosis.runs_away() && !rows.after.empty();
  if (!result.is_evaluated) {
    result.reason = diagnosis.runs_away()
                        ? "with the values and effects of the machine file a model runs away"
                    : rows.balance == gap::Balance::kSpindleTorque
                        ? "the recording is too short, has too many holes, or the spindle stands in the cut"
                        : "the recording is too short or has too many holes";
    return result;
  }
  result.residual_ratio = mean_power(rows.before);
  result.residual_ratio_after = mean_power(rows.after);
  result.cells = cells_of(diagnosis.fit.axis(), diagnosis.fit.signals(), {rows.before, rows.after});
  if (result.residual_ratio > kLeastGap * result.residual_ratio_after) {
    const std::vector<GapCell> orders = order_cells(rows.balance, diagnosis);
    result.cells.insert(result.cells.end(), orders.begin(), orders.end());
  }
  correct_for_number(result.cells);
  return result;
}

}  // namespace

std::vector<BalanceResult> balances_of(const AxisDiagnosis& diagnosis, const std::vector<BalanceRows>& rows) {
  std::vector<BalanceResult> results;
  for (const BalanceRows& balance : rows) results.push_back(balance_of(balance, diagnosis));
  return results;
}

std::optional<double> onset_of(const AxisDiagnosis& diagnosis, const gap::AppliedEffect& effect) {
  if (effect.onset_s > 0.0) return effect.onset_s;
  AxisFit without = diagnosis.fit;
  std::erase_if(without.change_model().effects,
                [&effect](const gap::AppliedEffect& e) { return e.form.effect == effect.form.effect; });
  const GapStatistics statistics = without.collect_with(std::array{effect.form});
  const LateStart start = best_start(
      without, statistics, static_cast<Eigen::Index>(parameter_count(without.axis())), effect.form.parts);
  if (!is_surely_late(start, statistics.total_rows())) return std::nullopt;
  return start.onset_s;
}

}  // namespace morepro::host
