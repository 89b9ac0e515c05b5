#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace morepro::host {

/// A straight line through a value over time; its error knows that neighbours are alike.
struct TrendLine {
  double from_s = 0.0;  ///< the first sample that it rests on, and the last
  double to_s = 0.0;
  double at_from = 0.0;  ///< its value there
  double slope_per_s = 0.0;
  double standard_error_per_s = 0.0;

  [[nodiscard]] double at(double time_s) const { return at_from + slope_per_s * (time_s - from_s); }
};

/// How the wear of one tool goes on, in bounded memory: samples of any number become 32 .. 64 means of
/// equally many, through which a line is laid by least squares. What is left of them is taken as a
/// first-order autoregressive process, so that n values with correlation r count as n (1 - r) / (1 + r):
/// estimates that follow each other slowly, or a curve that is no line, tell less than their number says.
class WearTrend {
 public:
  /// In the order of time.
  void take(double time_s, double wear);
  /// Another tool.
  void restart() { *this = WearTrend(); }
  /// Empty below 16 samples.
  [[nodiscard]] std::optional<TrendLine> line() const;

 private:
  struct Block {
    double time_s = 0.0;
    double wear = 0.0;
  };
  static constexpr std::size_t kMostBlocks = 64;
  void close();

  std::vector<Block> blocks_;  ///< means
  Block sum_{};
  std::size_t count_ = 0;
  std::size_t block_samples_ = 1;
};

}  // namespace morepro::host
