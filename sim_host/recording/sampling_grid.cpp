#include "sim_host/recording/sampling_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

// A hundred rows of memory: jitter averages out, a drift of 0.1 % lags by a tenth of a step.
constexpr double kFollow = 0.01;
constexpr std::size_t kRowsForPhase = 200;

double five_digits(double value) {
  const double last_digit = std::pow(10.0, std::floor(std::log10(value)) - 4.0);
  return std::round(value / last_digit) * last_digit;
}

}  // namespace

double refined_rate_hz(std::span<const double> times_s, double period_s) {
  std::vector<double> periods_s;
  // Over a longer lag, jitter and rounded times weigh less; the period is known well enough to count the
  // steps. Over a lag of one, jitter would only lengthen: no step is shorter than one.
  for (std::size_t lag = 2; lag < times_s.size(); lag *= 4) {
    periods_s.clear();
    for (std::size_t i = 0; i + lag < times_s.size(); ++i) {
      const double span_s = times_s[i + lag] - times_s[i];
      periods_s.push_back(span_s / std::max(1.0, std::round(span_s / period_s)));
    }
    period_s = median_of(periods_s);
  }
  return five_digits(1.0 / period_s);
}

// The mean direction on a circle of one step: gaps do not matter to it.
SamplingGrid::SamplingGrid(std::span<const double> times_s, double rate_hz) : rate_hz_(rate_hz) {
  double sine = 0.0;
  double cosine = 0.0;
  for (const double time_s : times_s.first(std::min(times_s.size(), kRowsForPhase))) {
    const double angle = 2.0 * std::numbers::pi * std::remainder((time_s - times_s[0]) * rate_hz, 1.0);
    sine += std::sin(angle);
    cosine += std::cos(angle);
  }
  instant_s_ = times_s[0] + std::atan2(sine, cosine) / (2.0 * std::numbers::pi * rate_hz);
}

std::int64_t SamplingGrid::steps_to(double time_s) {
  const auto steps = std::max<std::int64_t>(1, std::llround((time_s - instant_s_) * rate_hz_));
  instant_s_ += static_cast<double>(steps) / rate_hz_;
  instant_s_ += kFollow * (time_s - instant_s_);
  return steps;
}

}  // namespace morepro::host
