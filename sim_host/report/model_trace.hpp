#pragma once
#include <array>
#include <string>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "sim_host/report/innovation_statistics.hpp"
#include "sim_host/report/report_page.hpp"

namespace morepro::host {

/// A model of one axis beside a recording: what it predicts of every sample before it sees it, and what is
/// left.
class ModelTrace {
 public:
  /// `id`: begins the names of its series; `label`: what the page calls the model.
  ModelTrace(Axis axis, std::string id, std::string label, double row_s, std::size_t most_buckets);

  /// In the order of rows. `measured`: the sample that the innovation belongs to.
  void take(const Innovation& innovation, double measured);
  void finish(std::uint64_t rows);

  [[nodiscard]] bool has(std::size_t sensor) const { return count_[sensor] > 0; }
  [[nodiscard]] const std::string& id() const { return id_; }
  [[nodiscard]] const SeriesTable& table() const { return table_; }
  /// Spectrum and autocorrelation of one sensor's innovations, under the model's label.
  [[nodiscard]] Json spectrum(std::size_t sensor) const;
  [[nodiscard]] Json autocorrelation(std::size_t sensor) const;

 private:
  struct Columns {
    std::size_t measured, predicted, band, innovation;
  };
  Axis axis_;
  std::string id_;
  std::string label_;
  SeriesTable table_;
  std::array<Columns, kSensorsPerAxis> columns_{};
  std::size_t nis_column_ = 0;
  NisWindow nis_;
  std::array<InnovationStatistics, kSensorsPerAxis> statistics_;
  std::array<std::uint64_t, kSensorsPerAxis> count_{};
  std::array<std::uint64_t, kSensorsPerAxis> next_row_{};
};

/// Series that a trace has.
inline constexpr std::size_t kSeriesPerTrace = 4 * kSensorsPerAxis + 1;

/// "Spindle speed" and "rad/s" of the sensors of an axis.
struct SensorNames {
  std::string_view name;
  std::string_view unit;
  Channel channel;
};
const SensorNames& sensor_names(Axis axis, std::size_t sensor);

/// Puts the charts of one axis on the page: measured against the last of the models, innovations and NIS of
/// all of them.
void add_model_charts(Axis axis, std::span<const ModelTrace* const> models, ReportPage& page);

}  // namespace morepro::host
