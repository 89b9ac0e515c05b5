#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/identify/axis_traits.hpp"
#include "sim_host/identify/machine_value.hpp"

namespace morepro::host {

/// Called before every pass over the recording.
using OnPass = std::function<void()>;

/// What a filter found of the values of one axis or balance.
struct AxisEstimate {
  std::vector<MachineValue> names;
  std::vector<double> value;
  Eigen::MatrixXd covariance;  ///< of the logarithms of the values
  bool has_settled = true;     ///< the last step was small against what it claims
  double ratio = 1.0;          ///< mean squared innovation in the sensors' noise, 1: as the sensors say
  double correlation = 0.0;    ///< of neighbouring innovations, the larger of the two signals'; 0: white
  std::array<double, 2> process_share{};  ///< process noise per sample, of each sensor's variance
  int passes = 0;
};

/// Finds the values of one axis: passes of the board's filter as Gauss-Newton steps from the datasheet, each
/// linearised at the values found so far, with the process noise under which the innovations are most likely.
/// The axis's viscous friction is one of them, the last, where the datasheet has one.
template <class Traits>
AxisEstimate identify_axis(const RecordingSignals& signals, const MonitorConfiguration& configuration,
                           const OnPass& on_pass);

extern template AxisEstimate identify_axis<SpindleTraits>(const RecordingSignals&,
                                                          const MonitorConfiguration&, const OnPass&);
extern template AxisEstimate identify_axis<FeedTraits>(const RecordingSignals&, const MonitorConfiguration&,
                                                       const OnPass&);

}  // namespace morepro::host
