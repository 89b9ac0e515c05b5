#include "sim_host/report/axis_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "sim_host/report/model_trace.hpp"

namespace morepro::host {
namespace {

constexpr double kHorizonS = 1.0;
constexpr double kObserverSettlingS = 0.25;  // of an observer before it runs free

/// What was measured with an innovation of run_observer.
class Measured {
 public:
  Measured(Axis axis, const RecordingSignals& signals) {
    for (std::size_t s = 0; s < kSensorsPerAxis; ++s)
      column_[s] = &signals.value[index_of(sensor_names(axis, s).channel)];
  }
  double operator()(const Innovation& v) const { return static_cast<double>((*column_[v.sensor])[v.row]); }

 private:
  std::array<const std::vector<float>*, kSensorsPerAxis> column_{};
};

void trace(Axis axis, const RecordingSignals& signals, const GapModel& model, ModelTrace& trace) {
  const Measured measured(axis, signals);
  run_observer(axis, signals, model, 0, signals.rows,
               [&](const Innovation& v) { trace.take(v, measured(v)); });
  trace.finish(signals.rows);
}

/// The sensor that a free run is looked at through.
std::size_t watched_sensor(Axis axis, const RecordingSignals& signals) {
  return axis == Axis::kFeed && signals.has(Channel::kFeedSpeed) ? 1 : 0;
}

void run_free(Axis axis, const RecordingSignals& signals, GapModel model, std::size_t sensor,
              std::size_t column, SeriesTable& table) {
  const Measured measured(axis, signals);
  const auto length = static_cast<std::size_t>(kHorizonS * signals.rate_hz);
  const auto settling = static_cast<std::size_t>(kObserverSettlingS * signals.rate_hz);
  for (std::size_t first = settling; first < signals.rows; first += length) {
    model.noise.free_from_s = signals.time_s(first);
    const std::size_t last = std::min(first + length, signals.rows);
    run_observer(axis, signals, model, first - settling, last, [&](const Innovation& v) {
      if (v.row < first || v.sensor != sensor) return;
      table.begin_row(v.row);
      // The last sample of a horizon stays open: a new one starts elsewhere.
      if (v.row + 1 < last) table.set(column, measured(v) - v.value);
    });
  }
  table.finish(signals.rows);
}

void add_free_runs(Axis axis, const RecordingSignals& signals, std::span<const NamedModel> models,
                   std::size_t most_buckets, ReportPage& page) {
  const std::size_t sensor = watched_sensor(axis, signals);
  const SensorNames& names = sensor_names(axis, sensor);
  const std::string unit(names.unit);
  TimeChart chart{.section = "free_run",
                  .title = fmt::format("{}: the model alone for {:g} s at a time", names.name, kHorizonS),
                  .unit = unit,
                  .lines = {fmt::format("{}.{}.measured", models.back().id, info_of(names.channel).column)}};
  for (const NamedModel& one : models) {
    SeriesTable table(1.0 / signals.rate_hz, most_buckets);
    chart.lines.push_back(fmt::format("{}.{}.free_run", one.id, info_of(names.channel).column));
    const std::size_t column = table.add(chart.lines.back(), one.label, unit);
    run_free(axis, signals, one.model, sensor, column, table);
    page.add(table);
  }
  page.add(chart);
}

}  // namespace

void add_axis(Axis axis, const RecordingSignals& signals, std::span<const NamedModel> models,
              std::size_t most_buckets, ReportPage& page) {
  std::deque<ModelTrace> traces;
  for (const NamedModel* one : {&models.front(), &models.back()}) {
    if (!traces.empty() && one == &models.front()) break;
    traces.emplace_back(axis, one->id, one->label, 1.0 / signals.rate_hz, most_buckets);
    trace(axis, signals, one->model, traces.back());
  }
  std::vector<const ModelTrace*> shown;
  for (const ModelTrace& one : traces) shown.push_back(&one);
  add_model_charts(axis, shown, page);
  if (shown.back()->has(watched_sensor(axis, signals)))
    add_free_runs(axis, signals, models, most_buckets, page);
}

}  // namespace morepro::host
