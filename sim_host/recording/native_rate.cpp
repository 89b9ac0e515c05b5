#include "sim_host/recording/native_rate.hpp"

#include <algorithm>
#include <cmath>

namespace morepro::host {

void NativeRate::add(std::uint32_t sequence, std::uint32_t time_us) {
  if (steps_us_.size() == kSteps) return;
  const auto frames = static_cast<std::int32_t>(sequence - previous_sequence_);
  const auto step_us = static_cast<std::int32_t>(time_us - previous_time_us_);
  if (has_previous_ && frames > 0 && step_us > 0) steps_us_.push_back(static_cast<double>(step_us) / frames);
  previous_sequence_ = sequence;
  previous_time_us_ = time_us;
  has_previous_ = true;
}

double NativeRate::rate_hz() const {
  if (steps_us_.empty()) return 0.0;
  auto sorted = steps_us_;
  std::sort(sorted.begin(), sorted.end());
  const double median_us = sorted[sorted.size() / 2];
  // Time is in whole microseconds: the mean of the regular steps resolves 333.3 us, the median does not.
  const auto first = std::lower_bound(sorted.begin(), sorted.end(), 0.5 * median_us);
  const auto last = std::upper_bound(sorted.begin(), sorted.end(), 1.5 * median_us);
  double sum_us = 0.0;
  for (auto step = first; step != last; ++step) sum_us += *step;
  return 1.0e6 * static_cast<double>(last - first) / sum_us;
}

}  // namespace morepro::host
