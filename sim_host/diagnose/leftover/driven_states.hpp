#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace morepro::host {

/// Lags and resonances that the changes of one channel set in motion, from one mean over rows to the next.
class DrivenStates {
 public:
  static constexpr Eigen::Index kLags = 2;  ///< of 0.5 and 1 ms

  /// `values`: of the channel, NaN where there is none; `rate_hz`: theirs. The frequencies are far below
  /// `rate_hz` over `rows_per_mean`.
  DrivenStates(const std::vector<float>& values, double rate_hz, std::size_t rows_per_mean,
               std::span<const double> frequencies_hz);

  /// Up to the last row before a mean, each of which is asked for in turn.
  void move_to(std::size_t mean);

  [[nodiscard]] auto lags() const { return state_.head(kLags).real(); }
  [[nodiscard]] auto resonances() const { return state_.tail(state_.size() - kLags); }

 private:
  const std::vector<float>* values_;
  std::size_t rows_per_mean_;
  Eigen::ArrayXcd state_;   ///< the lags, then the resonances
  Eigen::ArrayXcd factor_;  ///< from one mean to the next
  std::size_t row_ = 0;
  double value_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace morepro::host
