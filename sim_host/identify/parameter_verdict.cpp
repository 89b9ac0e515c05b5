#include "sim_host/identify/parameter_verdict.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "lib/identification/derivative_rows.hpp"
#include "sim_host/identify/axis_traits.hpp"
#include "sim_host/replay/names.hpp"

namespace morepro::host {
namespace {

constexpr double kSharp = 0.05;       // a relative standard error above says nothing to an engineer
constexpr double kLearnt = 1.0 / 3.0;  // of the datasheet's own standard error
constexpr double kShown = 0.25;       // known too badly to be used, well enough to be shown
constexpr double kCorrelated = 0.9;

constexpr const char* kWithOffset =
    "only together with contact_offset_n, which is taken for the datasheet's; to tell them apart, record different "
    "engagements";

bool is_spindle(Parameter parameter) {
  return parameter != Parameter::kMass && parameter != Parameter::kContactForce;
}

std::vector<Channel> needed(Parameter parameter, IdentificationFilter filter) {
  const bool by_derivatives = filter == IdentificationFilter::kDerivatives;
  std::vector<Channel> channels{Channel::kArmatureVoltage, Channel::kSpindleSpeed, Channel::kArmatureCurrent};
  if (by_derivatives) channels = {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kSpindleAcceleration};
  if (!is_spindle(parameter)) channels = {Channel::kFeedForce};
  if (!is_spindle(parameter) && by_derivatives) channels.push_back(Channel::kFeedAcceleration);
  if (parameter == Parameter::kContactForce) channels.push_back(Channel::kContact);
  return channels;
}

bool has_feed_motion(const RecordingSignals& signals) {
  return signals.has(Channel::kFeedSpeed) || signals.has(Channel::kFeedPosition);
}

double deviation_of(const AxisEstimate& e, std::size_t i) {
  const auto k = static_cast<Eigen::Index>(i);
  return std::sqrt(e.covariance(k, k)) * e.inflation;
}

/// The parameter that number `index` is most correlated with; itself where that is not much.
std::size_t partner_of(const AxisEstimate& e, std::size_t index) {
  const auto i = static_cast<Eigen::Index>(index);
  std::size_t partner = index;
  double most = kCorrelated;
  for (std::size_t k = 0; k < e.parameters.size(); ++k) {
    const auto j = static_cast<Eigen::Index>(k);
    const double correlation =
        std::abs(e.covariance(i, j)) / std::sqrt(e.covariance(i, i) * e.covariance(j, j));
    if (k == index || !(correlation > most)) continue;
    most = correlation;
    partner = k;
  }
  return partner;
}

std::string reason_for(const AxisEstimate& e, std::size_t index) {
  if (!e.fits) return "the model does not fit the recording; 'morepro diagnose' tells what it lacks";
  const char* advice = excitation_for(e.parameters[index]);
  const std::size_t partner = partner_of(e, index);
  const double deviation = deviation_of(e, index);
  if (partner != index)
    return fmt::format("only a combination with {} is told; it needs {}", name_of(e.parameters[partner]), advice);
  if (deviation > kSharp && deviation < kShown) return fmt::format("known to {:.0f} % only; it needs {}", 100.0 * deviation, advice);
  return fmt::format("the recording does not excite it; it needs {}", advice);
}

}  // namespace

const char* excitation_for(Parameter parameter) {
  switch (parameter) {
    case Parameter::kTorqueConstant:
      return "currents under a known load, such as contact on and off";
    case Parameter::kInertia:
      return "speeds that change, such as steps of the voltage";
    case Parameter::kMass:
      return "steps of the feed force";
    case Parameter::kContactForce:
      return "contact on and off";
    case Parameter::kInductance:
      return "steps of the voltage, sampled several times within L/R";
    case Parameter::kResistance:
      return "currents that vary apart from the speed, such as contact on and off";
    case Parameter::kBackEmfConstant:
      return "speeds that vary apart from the current, such as contact on and off";
  }
  return "";
}

std::string obstacle_to(Parameter parameter, IdentificationFilter filter, const RecordingSignals& signals,
                        const MachineDescription& machine) {
  const bool is_described = is_spindle(parameter) ? machine.has_spindle : machine.has_feed;
  if (!is_described) return fmt::format("the machine file describes no {}", is_spindle(parameter) ? "[spindle]" : "[feed]");
  if (!(datasheet_value(machine.configuration.machine, parameter) > 0.0))
    return fmt::format("{} is 0 in the machine file; give it a value to start from", name_of(parameter));
  if (filter == IdentificationFilter::kDerivatives && balance_of(parameter) == DerivativeBalance::kVoltage)
    return "a recording holds no derivative of the current; use --filter states";
  std::string absent;
  for (const Channel channel : needed(parameter, filter))
    if (!signals.has(channel))
      absent += fmt::format("{}{}", absent.empty() ? "" : ", ", info_of(channel).column);
  if (!is_spindle(parameter) && !has_feed_motion(signals))
    absent += fmt::format("{}feed_speed_m_s or feed_position_m", absent.empty() ? "" : ", ");
  return absent.empty() ? "" : fmt::format("not recorded: {}", absent);
}

ParameterResult unanswered(Parameter parameter, const MachineDescription& machine, std::string reason) {
  const bool is_described = is_spindle(parameter) ? machine.has_spindle : machine.has_feed;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {std::string(name_of(parameter)),
          is_described ? datasheet_value(machine.configuration.machine, parameter) : kNone,
          kNone,
          kNone,
          false,
          std::move(reason)};
}

ParameterResult answered(const AxisEstimate& e, std::size_t index, const MachineDescription& machine) {
  const Parameter parameter = e.parameters[index];
  const double deviation = deviation_of(e, index);
  ParameterResult result = unanswered(parameter, machine, "");
  result.is_identifiable =
      e.fits && e.has_settled && deviation <= kSharp && deviation <= kLearnt * kDatasheetFraction;
  result.reason = !result.is_identifiable                 ? reason_for(e, index)
                  : parameter == Parameter::kContactForce ? kWithOffset
                                                          : "";
  if (result.is_identifiable || (e.fits && deviation < kShown)) {
    result.refit = e.value[index];
    result.standard_error = e.value[index] * deviation;
  }
  return result;
}

}  // namespace morepro::host
