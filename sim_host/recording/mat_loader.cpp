#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_host/recording/columns_reader.hpp"
#include "sim_host/recording/mat_file.hpp"
#include "sim_host/support/suggestion.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

class ColumnCollector {
 public:
  ColumnCollector(const MatFile& file, const ColumnMapping& mapping, RecordingInfo& info)
      : file_(file), mapping_(mapping), info_(info) {}

  RecordingColumns collect() {
    sources_ = mapping_.sources;
    for (const auto& variable : file_.variables()) add_by_name(variable.name);
    for (const ColumnSource& source : sources_) take(source);
    if (info_.recorded == 0) refuse("no variable is a signal of the machine", "--map feed_force_n=VARIABLE");
    take_time();
    note_unused();
    return std::move(columns_);
  }

 private:
  void add_by_name(const std::string& name) {
    if (!is_column(name)) return;
    const ColumnSource source = column_source(name + "=" + name);
    const bool is_mapped = std::any_of(sources_.begin(), sources_.end(), [&](const ColumnSource& other) {
      return other.channel == source.channel;
    });
    if (!is_mapped) sources_.push_back(source);
  }

  void take(const ColumnSource& source) {
    const double factor = factor_of(source);
    std::vector<double> values = vector(source, source.variable);
    for (double& value : values) value *= factor;
    check_length(source, values.size());
    if (!source.channel) {
      columns_.time_s = std::move(values);
      return;
    }
    columns_.value[index_of(*source.channel)].assign(values.begin(), values.end());
    info_.recorded = static_cast<std::uint16_t>(info_.recorded | bit_of(*source.channel));
  }

  double factor_of(const ColumnSource& source) {
    if (source.factor.empty()) return 1.0;
    double factor = 0.0;
    const char* end = source.factor.data() + source.factor.size();
    const auto result = fast_float::from_chars(source.factor.data(), end, factor);
    if (result.ec == std::errc{} && result.ptr == end && std::isfinite(factor)) return factor;
    const auto values = vector(source, source.factor);
    if (values.size() == 1) return values[0];
    throw UserError(fmt::format("{}: '{}' is neither a number nor a scalar variable; correct --map {}",
                                info_.file, source.factor, column_name(source.channel)));
  }

  std::vector<double> vector(const ColumnSource& source, const std::string& name) {
    if (file_.has(name)) return file_.vector(name);
    std::vector<std::string_view> known;
    for (const auto& variable : file_.variables()) known.push_back(variable.name);
    throw UserError(fmt::format("{}: there is no variable '{}' for {}{}; the file holds {}", info_.file, name,
                                column_name(source.channel), did_you_mean(name, known), file_.names()));
  }

  void check_length(const ColumnSource& source, std::size_t length) {
    if (first_variable_.empty()) {
      first_variable_ = source.variable;
      rows_ = length;
    }
    if (length != rows_)
      throw UserError(fmt::format("{}: variable '{}' has {} values, '{}' has {}; give all columns one length",
                                  info_.file, source.variable, length, first_variable_, rows_));
  }

  void take_time() {
    if (mapping_.rate_hz > 0.0) {
      if (!columns_.time_s.empty())
        throw UsageError(fmt::format("{} has a time; --rate is for files without one", info_.file));
      for (std::size_t row = 0; row < rows_; ++row)
        columns_.time_s.push_back(static_cast<double>(row) / mapping_.rate_hz);
    }
    if (columns_.time_s.empty())
      refuse("there is no variable 'time_s'", "--map time_s=VARIABLE, or --rate HZ");
  }

  void note_unused() {
    for (const auto& variable : file_.variables()) {
      const bool is_used = std::any_of(sources_.begin(), sources_.end(), [&](const ColumnSource& source) {
        return source.variable == variable.name;
      });
      if (variable.length == rows_ && !is_used)
        info_.warnings.push_back(fmt::format("{}: variable '{}' is not used; --map COLUMN={} takes it",
                                             info_.file, variable.name, variable.name));
    }
  }

  [[noreturn]] void refuse(const char* what, const char* option) const {
    throw UserError(
        fmt::format("{}: {}; the file holds {}: say which is which with morepro convert {} OUT {}",
                    info_.file, what, file_.names(), info_.file, option));
  }

  const MatFile& file_;
  const ColumnMapping& mapping_;
  RecordingInfo& info_;
  std::vector<ColumnSource> sources_;
  RecordingColumns columns_;
  std::string first_variable_;
  std::size_t rows_ = 0;
};

}  // namespace

LoadedRecording load_mat(const std::string& path, const ColumnMapping& mapping) {
  const MatFile file(path);
  LoadedRecording recording;
  recording.info.file = path;
  recording.info.metadata = file.metadata();
  recording.columns = ColumnCollector(file, mapping, recording.info).collect();
  return recording;
}

}  // namespace morepro::host
