#include "sim_host/report/diff_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim_host/report/channel_label.hpp"
#include "sim_host/report/recording_trace.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kSeriesPerSignal = 4;

std::string key(std::string_view side, std::string_view column) { return fmt::format("{}.{}", side, column); }

const ChannelLabel& label_of(std::string_view column) {
  for (std::size_t c = 0; c < kChannelCount; ++c)
    if (kChannels[c].column == column) return kChannelLabels[c];
  return kChannelLabels.front();
}

bool is_in(std::uint16_t recorded, std::size_t channel) { return (recorded >> channel & 1U) != 0; }

}  // namespace

void DiffReport::begin(const RecordingInfo& a, const RecordingInfo& b, const Tolerances& tolerances) {
  in_a_ = a.recorded;
  in_b_ = b.recorded;
  rate_hz_ = std::min(a.rate_hz, b.rate_hz);
  start_us_ = std::min(a.start_us, b.start_us);
  const auto signals = static_cast<std::size_t>(std::popcount(static_cast<std::uint16_t>(in_a_ | in_b_)));
  table_ = SeriesTable(1.0 / rate_hz_, buckets_for(kSeriesPerSignal * signals));
  for (std::size_t c = 0; c < kChannelCount; ++c) {
    if (!is_in(in_a_ | in_b_, c)) continue;
    const std::string_view column = kChannels[c].column;
    tolerance_[c] = tolerances.of(column);
    const std::string unit(kChannelLabels[c].unit);
    columns_[c] = {table_.add(key("a", column), "A", unit), table_.add(key("b", column), "B", unit),
                   table_.add(key("difference", column), "B − A", unit),
                   table_.add(key("allowed", column), "allowed", unit)};
  }
  flags_ = {table_.add("phase", "", "1"), table_.add("out", "", "1"), table_.add("only_in_a", "", "1"),
            table_.add("only_in_b", "", "1")};
}

bool DiffReport::take_signal(std::size_t channel, const AlignedRow& row) {
  const auto a = sample_of(row.a, static_cast<Channel>(channel));
  const auto b = sample_of(row.b, static_cast<Channel>(channel));
  const Columns& columns = columns_[channel];
  if (a) table_.set(columns.a, *a);
  if (b) table_.set(columns.b, *b);
  if (!row.a || !row.b || !is_in(in_a_ & in_b_, channel)) return true;
  if (!a || !b) return !a && !b;
  const double allowed = allowed_difference(*a, tolerance_[channel]);
  table_.set(columns.difference, *a == *b ? 0.0 : *b - *a);
  table_.set(columns.allowed, -allowed, allowed);
  return is_within(*a, *b, tolerance_[channel]);
}

void DiffReport::take(const AlignedRow& row) {
  const double place = std::round(seconds(row.time_us() - start_us_) * rate_hz_);
  const auto at = static_cast<std::uint64_t>(std::fmax(place, 0.0));
  // Rows of one side only may lie closer than the grid is wide.
  const std::uint64_t number = rows_ == 0 ? at : std::max(at, rows_ - 1);
  rows_ = number + 1;
  table_.begin_row(number);
  bool is_within = true;
  for (std::size_t c = 0; c < kChannelCount; ++c)
    if (is_in(in_a_ | in_b_, c)) is_within &= take_signal(c, row);
  table_.set(flags_.out, is_within ? 0.0 : 1.0);
  table_.set(flags_.only_in_a, row.b ? 0.0 : 1.0);
  table_.set(flags_.only_in_b, row.a ? 0.0 : 1.0);
  if (row.a) table_.set(flags_.phase, static_cast<double>(phase_.step(row.a->frame)));
}

void DiffReport::add_strips() {
  const auto source = [&](std::size_t flag) {
    return Json{{"bucket_s", table_.bucket_s()}, {"runs", runs_of(table_.pyramid(flag))}};
  };
  if (PhaseWatch::can_tell(in_a_)) {
    page_.part("phases") = source(flags_.phase);
    page_.part("phases")["tool_change_s"] = kToolChangeS;
  }
  const auto add = [&](std::string_view title, std::string_view meaning, std::size_t flag) {
    Json strip = source(flag);
    strip["title"] = title;
    strip["meaning"] = meaning;
    page_.part("strips").push_back(std::move(strip));
  };
  add("Differ", "a signal is out of tolerance, or missing on one side", flags_.out);
  add("Only in A", "rows without a partner in B", flags_.only_in_a);
  add("Only in B", "rows without a partner in A", flags_.only_in_b);
}

void DiffReport::add_charts(const SignalDiff& signal) {
  const auto& [name, unit] = label_of(signal.name);
  TimeChart both{.section = signal.name,
                 .title = std::string(name),
                 .unit = std::string(unit),
                 .lines = {key("a", signal.name), key("b", signal.name)}};
  if (signal.first_out_s) both.marks = {{*signal.first_out_s - seconds(start_us_), "differs first"}};
  TimeChart difference = both;
  difference.title = fmt::format("{}: B − A", name);
  difference.lines = {key("difference", signal.name)};
  difference.band = key("allowed", signal.name);
  page_.add(both);
  page_.add(difference);
}

std::string DiffReport::html(const DiffResult& compared, std::string_view result,
                             std::string_view command_line, const std::vector<std::string>& files) {
  if (compared.is_of_recordings) {
    table_.finish(rows_);
    add_strips();
    page_.add(table_);
    for (const SignalDiff& signal : compared.signals) add_charts(signal);
    page_.set_span(seconds(start_us_), static_cast<double>(rows_) / rate_hz_, rate_hz_);
  }
  return page_.html(result, command_line, files);
}

}  // namespace morepro::host
