#include "sim_host/report/signals_report.hpp"

#include <bit>

#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/signals/reference_scales.hpp"
#include "sim_host/report/axis_report.hpp"
#include "sim_host/report/recording_trace.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kAxes = 2;

bool has_axis(Axis axis, const RecordingSignals& signals, const MachineDescription& machine) {
  if (axis == Axis::kSpindle)
    return machine.has_spindle && signals.has(Channel::kArmatureVoltage) &&
           signals.has(Channel::kSpindleSpeed);
  return machine.has_feed && signals.has(Channel::kFeedForce) &&
         (signals.has(Channel::kFeedSpeed) || signals.has(Channel::kFeedPosition));
}

}  // namespace

void SignalsReport::take_recording(const RecordingSignals& signals, const MachineDescription& machine) {
  const auto recorded = static_cast<std::size_t>(std::popcount(signals.recorded));
  most_buckets_ = buckets_for(kAxes * kSeriesPerAxis + recorded);
  RecordingTrace trace(1.0 / signals.rate_hz, machine.configuration.sensors, most_buckets_);
  trace.take_all(signals);
  trace.add_to(signals.rows, teeth_of(machine), page_);
  page_.set_span(signals.start_s, signals.duration_s(), signals.rate_hz);
}

void SignalsReport::take(const AxisDiagnosis& diagnosis) {
  const AxisFit& fit = diagnosis.fit;
  std::vector<NamedModel> models{{"datasheet", "datasheet", fit.datasheet()},
                                 {"refit", "refit", diagnosis.nominal.model()}};
  if (!fit.model().effects.empty()) models.push_back({"effects", "with effects", fit.model()});
  for (NamedModel& one : models) one.model.noise = fit.model().noise;
  add_axis(fit.axis(), fit.signals(), models, most_buckets_, page_);
}

void SignalsReport::take(const RecordingSignals& signals, const MachineDescription& datasheet,
                         const MachineDescription& identified) {
  for (const Axis axis : {Axis::kSpindle, Axis::kFeed}) {
    if (!has_axis(axis, signals, datasheet)) continue;
    GapModel model{.machine = identified.configuration.machine,
                   .point = reference_point_for(datasheet, signals),
                   .noise = usual_noise(datasheet.configuration.sensors)};
    fit_noise(axis, signals, all_of(signals).front(), usual_noise(datasheet.configuration.sensors),
              NoiseBounds{}, false, model);
    GapModel before = model;
    before.machine = datasheet.configuration.machine;
    const std::array models{NamedModel{"datasheet", "datasheet", before},
                            NamedModel{"identified", "identified", model}};
    add_axis(axis, signals, models, most_buckets_, page_);
  }
}

}  // namespace morepro::host
