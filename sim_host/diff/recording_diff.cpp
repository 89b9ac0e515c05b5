#include "sim_host/diff/recording_diff.hpp"

#include <array>
#include <cmath>

namespace morepro::host {
namespace {

/// One signal, sample by sample.
class SignalComparison {
 public:
  SignalComparison(std::string_view name, const Tolerance& tolerance) {
    signal_.name = name;
    signal_.tolerance = tolerance;
  }

  /// A sample that is missing is no value.
  void add(double time_s, std::optional<double> a, std::optional<double> b) {
    if (!a && !b) return;
    if (a && b) return compare(time_s, *a, *b);
    ++(a ? signal_.missing_in_b : signal_.missing_in_a);
    note_out(time_s);
  }

  SignalDiff result() {
    if (signal_.compared > 0)
      signal_.rms_difference = std::sqrt(square_sum_ / static_cast<double>(signal_.compared));
    if (signal_.missing_in_a + signal_.missing_in_b > 0) signal_.verdict = SignalVerdict::kMissing;
    if (signal_.out > 0) signal_.verdict = SignalVerdict::kOut;
    return signal_;
  }

 private:
  void compare(double time_s, double a, double b) {
    ++signal_.compared;
    const double difference = a == b ? 0.0 : b - a;
    square_sum_ += difference * difference;
    if (!signal_.largest || !(std::fabs(difference) <= std::fabs(signal_.largest->difference)))
      signal_.largest = {difference, a, b, time_s};
    if (is_within(a, b, signal_.tolerance)) return;
    ++signal_.out;
    note_out(time_s);
  }

  void note_out(double time_s) {
    if (!signal_.first_out_s) signal_.first_out_s = time_s;
  }

  SignalDiff signal_;
  double square_sum_ = 0.0;
};

class Comparison {
 public:
  Comparison(const RecordingInfo& a, const RecordingInfo& b, const Tolerances& tolerances)
      : in_a_(a.recorded), in_b_(b.recorded) {
    for (const ChannelInfo& channel : kChannels)
      signals_.emplace_back(channel.column, tolerances.of(channel.column));
  }

  void add(const AlignedRow& row) {
    if (!row.a || !row.b) return;
    has_rows_ = true;
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      const auto channel = static_cast<Channel>(i);
      if ((in_a_ & in_b_ & bit_of(channel)) == 0) continue;
      signals_[i].add(seconds(row.time_us()), sample_of(row.a, channel), sample_of(row.b, channel));
    }
  }

  std::vector<SignalDiff> results() {
    std::vector<SignalDiff> results;
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      const std::uint16_t bit = bit_of(static_cast<Channel>(i));
      if (((in_a_ | in_b_) & bit) == 0) continue;
      results.push_back(signals_[i].result());
      if (!has_rows_) results.back().verdict = SignalVerdict::kMissing;
      if ((in_b_ & bit) == 0) results.back().verdict = SignalVerdict::kOnlyInA;
      if ((in_a_ & bit) == 0) results.back().verdict = SignalVerdict::kOnlyInB;
    }
    return results;
  }

 private:
  std::uint16_t in_a_, in_b_;
  bool has_rows_ = false;
  std::vector<SignalComparison> signals_;
};

DiffSide side_of(const RecordingReader& recording) {
  return {.file = recording.info().file, .rows = recording.tally().rows, .rate_hz = recording.info().rate_hz};
}

}  // namespace

DiffResult diff_recordings(RecordingReader& a, RecordingReader& b, const Tolerances& tolerances,
                           const std::function<void(const AlignedRow&)>& on_row) {
  DiffResult result{.tolerance = tolerances.common, .time_tolerance_s = tolerances.time_s};
  Comparison comparison(a.info(), b.info(), tolerances);
  check_names(tolerances, comparison.results());
  AlignedFrames rows(a, b, microseconds(tolerances.time_s));
  for (AlignedRow row; rows.next(row);) {
    ++(!row.b ? result.rows_only_in_a : !row.a ? result.rows_only_in_b : result.aligned_rows);
    comparison.add(row);
    if (on_row) on_row(row);
  }
  result.a = side_of(a);
  result.b = side_of(b);
  result.signals = comparison.results();
  return result;
}

}  // namespace morepro::host
