#include "sim_host/report/model_trace.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/monitor/innovation_gate.hpp"

namespace morepro::host {
namespace {

constexpr double kBandDeviations = 2.0;

// The order of Innovation::sensor.
constexpr std::array<std::array<SensorNames, kSensorsPerAxis>, 2> kSensors{
    {{{{"Spindle speed", "rad/s", Channel::kSpindleSpeed},
       {"Armature current", "A", Channel::kArmatureCurrent}}},
     {{{"Feed position", "m", Channel::kFeedPosition}, {"Feed speed", "m/s", Channel::kFeedSpeed}}}}};

std::string key(const std::string& id, Channel channel, std::string_view what) {
  return fmt::format("{}.{}.{}", id, info_of(channel).column, what);
}

std::string nis_key(const std::string& id) { return id + ".nis"; }

Json rounded(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(std::stod(fmt::format("{:.4g}", value)));
  return list;
}

void add_sensor_charts(Axis axis, std::size_t sensor, std::span<const ModelTrace* const> models,
                       ReportPage& page) {
  const SensorNames& names = sensor_names(axis, sensor);
  const std::string& best = models.back()->id();
  page.add(TimeChart{.section = "model",
                     .title = std::string(names.name),
                     .unit = std::string(names.unit),
                     .lines = {key(best, names.channel, "measured"), key(best, names.channel, "predicted")},
                     .band = key(best, names.channel, "band")});
  const auto gate = static_cast<double>(InnovationGate::kSigmas);
  TimeChart left{.section = "residuals",
                 .title = fmt::format("{}: innovation over its standard deviation", names.name),
                 .unit = "1",
                 .lines = {},
                 .limits = {{gate, "gate"}, {-gate, ""}},
                 .scale = "asinh"};
  Json spectra = Json::array();
  Json correlations = Json::array();
  for (const ModelTrace* model : models) {
    left.lines.push_back(key(model->id(), names.channel, "innovation"));
    spectra.push_back(model->spectrum(sensor));
    correlations.push_back(model->autocorrelation(sensor));
  }
  page.add(left);
  page.part("whiteness")
      .push_back({{"title", names.name}, {"spectra", spectra}, {"autocorrelations", correlations}});
}

}  // namespace

const SensorNames& sensor_names(Axis axis, std::size_t sensor) {
  return kSensors[axis == Axis::kSpindle ? 0 : 1][sensor];
}

ModelTrace::ModelTrace(Axis axis, std::string id, std::string label, double row_s, std::size_t most_buckets)
    : axis_(axis), id_(std::move(id)), label_(std::move(label)), table_(row_s, most_buckets) {
  for (std::size_t s = 0; s < kSensorsPerAxis; ++s) {
    const auto& [name, unit, channel] = sensor_names(axis, s);
    const auto add = [&](std::string_view what, const std::string& label_of, std::string_view of) {
      return table_.add(key(id_, channel, what), label_of, std::string(of));
    };
    columns_[s] = {add("measured", "measured", unit), add("predicted", label_, unit),
                   add("band", "2 standard deviations", unit), add("innovation", label_, "1")};
  }
  nis_column_ = table_.add(nis_key(id_), label_, "1");
}

void ModelTrace::take(const Innovation& innovation, double measured) {
  const std::size_t s = innovation.sensor;
  const double deviation = std::sqrt(innovation.variance);
  const double predicted = measured - innovation.value;
  const double normalised = innovation.value / deviation;
  table_.begin_row(innovation.row);
  table_.set(columns_[s].measured, measured);
  table_.set(columns_[s].predicted, predicted);
  table_.set(columns_[s].band, predicted - kBandDeviations * deviation,
             predicted + kBandDeviations * deviation);
  table_.set(columns_[s].innovation, normalised);
  if (innovation.row != next_row_[s]) statistics_[s].take(std::nan(""));
  next_row_[s] = innovation.row + 1;
  statistics_[s].take(normalised);
  nis_.take(normalised);
  table_.set(nis_column_, nis_.value());
  ++count_[s];
}

void ModelTrace::finish(std::uint64_t rows) { table_.finish(rows); }

Json ModelTrace::spectrum(std::size_t sensor) const {
  return {{"label", label_}, {"power", rounded(statistics_[sensor].spectrum())}};
}

Json ModelTrace::autocorrelation(std::size_t sensor) const {
  return {{"label", label_},
          {"value", rounded(statistics_[sensor].autocorrelation())},
          {"bound", statistics_[sensor].bound()}};
}

void add_model_charts(Axis axis, std::span<const ModelTrace* const> models, ReportPage& page) {
  for (std::size_t s = 0; s < kSensorsPerAxis; ++s)
    if (models.back()->has(s)) add_sensor_charts(axis, s, models, page);
  if (!models.back()->has(0) && !models.back()->has(1)) return;
  TimeChart nis{
      .section = "residuals",
      .title = fmt::format("{}: NIS per degree of freedom over {} innovations",
                           axis == Axis::kSpindle ? "Spindle" : "Feed axis", NisWindow::kInnovations),
      .unit = "1",
      .lines = {},
      .limits = {{1.0 - NisWindow::bound(), ""}, {1.0 + NisWindow::bound(), "95 %"}},
      .scale = "log"};
  for (const ModelTrace* model : models) {
    nis.lines.push_back(nis_key(model->id()));
    page.add(model->table());
  }
  page.add(nis);
}

}  // namespace morepro::host
