#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace morepro::host {

/// |b - a| may be as large as the greater of `absolute` and `relative` times |a|: A is the baseline.
struct Tolerance {
  double absolute = 0.0;  ///< in the signal's unit
  double relative = 0.0;
};

enum class SignalVerdict : std::uint8_t {
  kWithin,   ///< every sample is within tolerance
  kOut,      ///< at least one is not
  kMissing,  ///< those that both have are, but one side lacks samples in rows that both have, or there is no
             ///< such row
  kOnlyInA,
  kOnlyInB,
};

/// The largest difference of one signal.
struct LargestDifference {
  double difference = 0.0;  ///< b - a
  double a = 0.0;
  double b = 0.0;
  std::optional<double> time_s;  ///< none in results
};

/// One signal of two recordings, or one value of two results.
struct SignalDiff {
  std::string name{};
  SignalVerdict verdict = SignalVerdict::kWithin;
  Tolerance tolerance{};
  std::uint64_t compared = 0;  ///< samples that both have
  std::uint64_t out = 0;       ///< of those, not within tolerance
  std::uint64_t missing_in_a = 0;
  std::uint64_t missing_in_b = 0;
  std::optional<double> first_out_s{};  ///< the first sample that is not within tolerance, or missing
  std::optional<LargestDifference> largest{};
  double rms_difference = 0.0;
  std::string text_a{}, text_b{};  ///< of a value that is no number on both sides
};

struct DiffSide {
  std::string file{};
  std::uint64_t rows = 0;
  double rate_hz = 0.0;
};

struct DiffResult {
  bool is_of_recordings = true;
  DiffSide a{}, b{};
  Tolerance tolerance{};  ///< of signals without one of their own
  double time_tolerance_s = 0.0;
  std::uint64_t aligned_rows = 0;  ///< the samples of these are compared
  std::uint64_t rows_only_in_a = 0;
  std::uint64_t rows_only_in_b = 0;
  std::vector<SignalDiff> signals{};
  std::vector<std::string> ignored{};  ///< values of results that were not compared

  [[nodiscard]] bool is_within() const {
    for (const SignalDiff& signal : signals)
      if (signal.verdict != SignalVerdict::kWithin) return false;
    return rows_only_in_a == 0 && rows_only_in_b == 0;
  }
};

}  // namespace morepro::host
