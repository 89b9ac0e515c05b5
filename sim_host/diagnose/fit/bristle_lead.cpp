#include "sim_host/diagnose/fit/bristle_lead.hpp"

#include <algorithm>
#include <span>

namespace morepro::host {
namespace {

constexpr double kForgotten = 5.0;         // yields of sliding, after which a hundredth of the past is left
constexpr std::size_t kLongestShare = 16;  // of a recording: what a long rest may cost

/// The longest way over which a bristle of the axis yields, in m or rad; 0 without one.
double longest_yield(Axis axis, const GapModel& model) {
  const gap::Effect effect =
      axis == Axis::kFeed ? gap::Effect::kFeedPresliding : gap::Effect::kSpindleCoulombFriction;
  double longest = 0.0;
  for (const auto* effects : {&model.known, &model.effects})
    for (const gap::AppliedEffect& one : *effects)
      if (one.form.effect == effect && gap::is_bristle(one.form))
        longest = std::max(longest, static_cast<double>(one.form.shape));
  return longest;
}

}  // namespace

std::size_t lead_of_bristles(Axis axis, const RecordingSignals& signals, const GapModel& model,
                             std::size_t first) {
  const double yield = longest_yield(axis, model);
  if (!(yield > 0.0)) return first;
  const Channel speed = axis == Axis::kFeed ? Channel::kFeedSpeed : Channel::kSpindleSpeed;
  const std::span<const float> rate = signals.value[index_of(speed)];
  const std::span<const float> place = signals.value[index_of(Channel::kFeedPosition)];
  if (rate.empty() && (axis == Axis::kSpindle || place.empty())) return first;
  const auto way_into = [&](std::size_t row) {
    const double way = rate.empty() ? static_cast<double>(place[row]) - static_cast<double>(place[row - 1])
                                    : static_cast<double>(rate[row]) / signals.rate_hz;
    return way == way ? way : 0.0;
  };
  const std::size_t earliest = first - std::min(first, signals.rows / kLongestShare);
  double way = 0.0;
  double least = 0.0;
  double most = 0.0;
  std::size_t row = first;
  while (row > earliest && !(most - least > kForgotten * yield)) {
    way -= way_into(row < signals.rows ? row : signals.rows - 1);
    least = std::min(least, way);
    most = std::max(most, way);
    --row;
  }
  return row;
}

}  // namespace morepro::host
