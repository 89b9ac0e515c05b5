#include "sim_host/identify/parameter_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim_host/identify/axis_traits.hpp"

namespace morepro::host {
namespace {

constexpr double kSharp = 0.05;        // a relative standard error above says nothing to an engineer
constexpr double kLearnt = 1.0 / 3.0;  // of the datasheet's own standard error
constexpr double kShown = 0.25;        // known too badly to be used, well enough to be shown
constexpr double kCorrelated = 0.9;
constexpr double kColoured = 0.5;  // correlation of innovations of a model that does not fit

constexpr double kGovernsIt = 0.5;  // of the variance of a value: that much comes from another one

constexpr const char* kWithFriction =
    "as right as {} of the machine file, which this recording does not tell and which is taken for known to "
    "{:.0f} %";

bool is_of_voltage(MachineValue value) {
  return value == MachineValue::kInductance || value == MachineValue::kResistance ||
         value == MachineValue::kBackEmfConstant;
}

std::vector<Channel> needed(MachineValue value, IdentificationFilter filter) {
  std::vector<Channel> channels{Channel::kArmatureVoltage, Channel::kSpindleSpeed, Channel::kArmatureCurrent};
  if (filter == IdentificationFilter::kDerivatives && !is_of_voltage(value)) channels.erase(channels.begin());
  if (is_of_feed(value)) channels = {Channel::kFeedForce};
  if (value == MachineValue::kContactForce) channels.push_back(Channel::kContact);
  return channels;
}

/// What the motion of the feed axis may be read from; empty: it is recorded.
std::string absent_feed_motion(IdentificationFilter filter, const RecordingSignals& signals,
                               const MachineParameters& machine) {
  if (signals.has(Channel::kFeedSpeed)) return "";
  if (filter == IdentificationFilter::kStates)
    return signals.has(Channel::kFeedPosition) ? "" : "feed_speed_m_s or feed_position_m";
  if (machine.feed.viscous_friction_ns_m > 0.0) return "feed_speed_m_s";
  return signals.has(Channel::kFeedAcceleration) ? "" : "feed_acceleration_m_s2 or feed_speed_m_s";
}

/// A mean of the current over a period is right as long as that is not longer than L/R, which a datasheet may
/// have wrong by a factor of two.
bool is_too_slow(const RecordingSignals& signals, const MachineParameters::Spindle& s) {
  return s.resistance_ohm > 2.0 * s.inductance_h * signals.rate_hz;
}

double deviation_of(const AxisEstimate& e, std::size_t i) {
  const auto k = static_cast<Eigen::Index>(i);
  // Innovations that follow each other count less, sensors that are noisier than described weigh less.
  const double coloured = std::clamp(e.correlation, 0.0, 0.99);
  return std::sqrt(e.covariance(k, k) * std::max(e.ratio, 1.0) * (1.0 + coloured) / (1.0 - coloured));
}

double correlation_of(const AxisEstimate& e, std::size_t first, std::size_t second) {
  const auto i = static_cast<Eigen::Index>(first), j = static_cast<Eigen::Index>(second);
  return std::abs(e.covariance(i, j)) / std::sqrt(e.covariance(i, i) * e.covariance(j, j));
}

/// The parameter that number `index` is most correlated with; itself where that is not much.
std::size_t partner_of(const AxisEstimate& e, std::size_t index) {
  std::size_t partner = index;
  double most = kCorrelated;
  for (std::size_t k = 0; k < e.names.size(); ++k) {
    const double correlation = correlation_of(e, index, k);
    if (k == index || !(correlation > most)) continue;
    most = correlation;
    partner = k;
  }
  return partner;
}

/// What a value rests on that the recording does not tell.
std::string assumption_of(const AxisEstimate& e, std::size_t index) {
  std::string text = e.names[index] == MachineValue::kContactForce ? kWithContactOffset : "";
  const std::size_t last = e.names.size() - 1;
  const MachineValue friction = e.names[last];
  if (!is_friction(friction) || index == last || is_told(e, last)) return text;
  const double correlation = correlation_of(e, index, last);
  if (correlation * correlation < kGovernsIt) return text;
  return fmt::format(
      "{}{}{}", text, text.empty() ? "" : "; ",
      fmt::format(fmt::runtime(kWithFriction), name_of(friction), 100.0 * datasheet_fraction(friction)));
}

bool fits(const AxisEstimate& e) { return e.correlation < kColoured; }

std::string reason_for(const AxisEstimate& e, std::size_t index) {
  if (!fits(e)) return "the model does not fit the recording; 'morepro diagnose' tells what it lacks";
  const char* advice = excitation_for(e.names[index]);
  if (!e.has_settled)
    return fmt::format(
        "the estimate does not settle; 'morepro diagnose' tells what the model lacks; where it "
        "lacks nothing, sample faster or excite more: {}",
        advice);
  const std::size_t partner = partner_of(e, index);
  const double deviation = deviation_of(e, index);
  if (partner != index)
    return fmt::format("only a combination with {} is told; it needs {}", name_of(e.names[partner]), advice);
  if (deviation > kSharp && deviation < kShown)
    return fmt::format("known to {:.0f} % only; it needs {}", 100.0 * deviation, advice);
  return fmt::format("the recording does not excite it; it needs {}", advice);
}

}  // namespace

std::string obstacle_to(MachineValue value, IdentificationFilter filter, const RecordingSignals& signals,
                        const MachineDescription& machine) {
  const bool is_described = !is_of_feed(value) ? machine.has_spindle : machine.has_feed;
  if (!is_described)
    return fmt::format("the machine file describes no {}", !is_of_feed(value) ? "[spindle]" : "[feed]");
  if (!(value_in(machine.configuration.machine, value) > 0.0))
    return fmt::format("{} is 0 in the machine file; give it a value to start from", name_of(value));
  std::string absent;
  for (const Channel channel : needed(value, filter))
    if (!signals.has(channel))
      absent += fmt::format("{}{}", absent.empty() ? "" : ", ", info_of(channel).column);
  const MachineParameters& m = machine.configuration.machine;
  const std::string motion = is_of_feed(value) ? absent_feed_motion(filter, signals, m) : "";
  if (!motion.empty()) absent += fmt::format("{}{}", absent.empty() ? "" : ", ", motion);
  if (!absent.empty()) return fmt::format("not recorded: {}", absent);
  if (filter == IdentificationFilter::kDerivatives && is_of_voltage(value) && is_too_slow(signals, m.spindle))
    return "a sampling period is longer than 2 L/R, so differences are no derivatives of the current; use "
           "--filter states";
  return "";
}

ParameterResult unanswered(MachineValue value, const MachineDescription& machine, std::string reason) {
  const bool is_described = !is_of_feed(value) ? machine.has_spindle : machine.has_feed;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {std::string(name_of(value)),
          is_described ? value_in(machine.configuration.machine, value) : kNone,
          kNone,
          kNone,
          false,
          std::move(reason)};
}

bool is_told(const AxisEstimate& e, std::size_t index) {
  const double deviation = deviation_of(e, index);
  return fits(e) && e.has_settled && deviation <= kSharp &&
         deviation <= kLearnt * datasheet_fraction(e.names[index]);
}

ParameterResult answered(const AxisEstimate& e, std::size_t index, const MachineDescription& machine) {
  const MachineValue value = e.names[index];
  const double deviation = deviation_of(e, index);
  ParameterResult result = unanswered(value, machine, "");
  result.is_identifiable = is_told(e, index);
  result.reason = result.is_identifiable ? assumption_of(e, index) : reason_for(e, index);
  if (result.is_identifiable || (fits(e) && e.has_settled && deviation < kShown)) {
    result.refit = e.value[index];
    result.standard_error = e.value[index] * deviation;
  }
  return result;
}

}  // namespace morepro::host
