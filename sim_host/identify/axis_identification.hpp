#pragma once
#include <functional>

#include "sim_host/identify/axis_pass.hpp"

namespace morepro::host {

/// Called before every pass over the recording.
using OnPass = std::function<void()>;

/// What all passes together found of one axis.
template <std::size_t kCount>
struct AxisIdentification {
  PassResult<kCount> last;
  std::array<double, 2> process_share{};  ///< process noise per step, of each sensor's variance, as the recording has it
  int passes = 0;
  bool has_settled = false;  ///< the last step was small against what it claims
};

/// Finds the parameters of one axis: a pass of the board's filter from the datasheet, then Gauss-Newton passes
/// that are linearised at the values found so far, with the process noise under which the innovations are most likely.
template <class Traits>
AxisIdentification<Traits::kCount> identify_axis(const RecordingSignals& signals,
                                                 const MonitorConfiguration& configuration, const OnPass& on_pass);

extern template AxisIdentification<SpindleTraits::kCount> identify_axis<SpindleTraits>(const RecordingSignals&,
                                                                                       const MonitorConfiguration&,
                                                                                       const OnPass&);
extern template AxisIdentification<FeedTraits::kCount> identify_axis<FeedTraits>(const RecordingSignals&,
                                                                                 const MonitorConfiguration&,
                                                                                 const OnPass&);

}  // namespace morepro::host
