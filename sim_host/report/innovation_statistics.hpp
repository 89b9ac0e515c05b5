#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace morepro::host {

/// Standard deviations of a normal value within which 95 % lie.
inline constexpr double kTwoSided95 = 1.96;

/// Whiteness of a sequence of normalised innovations of any length, in fixed memory: spectrum and
/// autocorrelation, averaged over segments.
class InnovationStatistics {
 public:
  static constexpr std::size_t kSegment = 2048;
  static constexpr std::size_t kLags = 60;

  /// The next sample; NaN where there is none: the segment begins anew.
  void take(double normalised);

  [[nodiscard]] std::size_t segments() const { return segments_; }
  /// One-sided power density over the frequency bins 0 .. kSegment/2, times the sampling rate: 1 everywhere
  /// for white innovations of unit variance. Empty where no segment is whole.
  [[nodiscard]] std::vector<double> spectrum() const;
  /// At lags 0 .. kLags, 1 at lag 0. Empty where no segment is whole.
  [[nodiscard]] std::vector<double> autocorrelation() const;
  /// 95 % of a white sequence's autocorrelations lie within +- this.
  [[nodiscard]] double bound() const;

 private:
  void finish_segment();

  std::vector<double> segment_;
  std::vector<double> power_;
  std::array<double, kLags + 1> product_{};
  std::size_t segments_ = 0;
};

/// Mean squares of so many normalised innovations in a row, the mean of the NIS per degree of freedom.
class NisWindow {
 public:
  static constexpr std::size_t kInnovations = 1024;
  /// 1 -+ this for 95 % of the windows where the model is right: chi-square of kInnovations degrees.
  [[nodiscard]] static double bound();

  void take(double normalised);
  /// Of the last whole window; NaN before the first.
  [[nodiscard]] double value() const { return value_; }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
  double value_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace morepro::host
