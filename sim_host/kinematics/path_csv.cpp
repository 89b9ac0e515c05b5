#include "sim_host/kinematics/path_csv.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "sim_host/kinematics/degree.hpp"
#include "sim_host/support/input_file.hpp"
#include "sim_host/support/suggestion.hpp"
#include "sim_host/support/trimmed.hpp"

namespace morepro::host {
namespace {

constexpr std::array<std::string_view, 10> kPathColumns{"x_m",       "y_m",       "z_m",     "duration_s",
                                                        "roll_rad",  "pitch_rad", "yaw_rad", "roll_deg",
                                                        "pitch_deg", "yaw_deg"};
constexpr std::size_t kDuration = 3;
constexpr std::size_t kFirstAngle = 4;

struct Field {
  std::string_view text;
  std::size_t column;  ///< first character, from 1
};

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    fields.push_back({trimmed(line.substr(start, end - start)), start + 1});
    start = end + 1;
  }
  return fields;
}

class PathCsv {
 public:
  PathCsv(const std::string& path, KinematicsJob& job) : path_(path), job_(job) {}

  void read() {
    const InputFile file(path_);
    std::string_view text = file.text();
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      take_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (columns_.empty())
      throw UserError(TextPlace{path_, 0, 0},
                      "the path is empty; expected a header row 'x_m,y_m,z_m,duration_s'");
  }

 private:
  [[nodiscard]] TextPlace place(std::size_t column) const { return {path_, line_, column}; }

  void take_line(std::string_view line) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') return;
    if (columns_.empty()) {
      take_header(line);
    } else {
      take_point(line);
    }
  }

  void take_header(std::string_view line) {
    for (const Field& field : fields_of(line)) {
      const auto known = std::find(kPathColumns.begin(), kPathColumns.end(), field.text);
      if (known == kPathColumns.end()) {
        throw UserError(place(field.column), fmt::format("column '{}' is not known{}; correct or remove it",
                                                         field.text, did_you_mean(field.text, kPathColumns)));
      }
      const auto column = static_cast<std::size_t>(known - kPathColumns.begin());
      if (has(column)) refuse_twice(field);
      if (column >= kFirstAngle && has(column < 7 ? column + 3 : column - 3)) refuse_twice(field);
      columns_.push_back(column);
    }
    for (std::size_t column = 0; column <= kDuration; ++column) {
      if (!has(column))
        throw UserError(place(0), fmt::format("the header has no column '{}'; add it", kPathColumns[column]));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (has(kFirstAngle + i) || has(kFirstAngle + 3 + i))
        job_.rows = static_cast<kinematics::TaskRows>(job_.rows | (0b1000 << i));
    }
  }

  [[nodiscard]] bool has(std::size_t column) const {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
  }

  [[noreturn]] void refuse_twice(const Field& field) const {
    throw UserError(place(field.column), fmt::format("column '{}' is there twice; remove one", field.text));
  }

  void take_point(std::string_view line) {
    const std::vector<Field> fields = fields_of(line);
    if (fields.size() != columns_.size()) {
      throw UserError(place(0), fmt::format("the row has {} fields, the header has {}; give one per column",
                                            fields.size(), columns_.size()));
    }
    PathPoint point{.waypoint = {}, .place = place(0)};
    for (std::size_t i = 0; i < fields.size(); ++i) take_field(columns_[i], fields[i], point);
    job_.points.push_back(point);
  }

  void take_field(std::size_t column, const Field& field, PathPoint& point) const {
    const bool is_first = job_.points.empty();
    if (column == kDuration && is_first && field.text.empty()) return;
    const double value = number(column, field);
    if (column < kDuration) {
      point.waypoint.position_m(static_cast<int>(column)) = value;
    } else if (column == kDuration) {
      if (is_first && value != 0.0)
        throw UserError(place(field.column),
                        "the first point has no way before it; leave its duration_s empty");
      point.duration_s = value;
    } else {
      const std::size_t angle = column - kFirstAngle;
      point.waypoint.angles_rad(static_cast<int>(angle % 3)) = angle < 3 ? value : value * kDegree;
    }
  }

  double number(std::size_t column, const Field& field) const {
    std::string_view text = field.text;
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto result = fast_float::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || result.ec != std::errc{} || result.ptr != text.data() + text.size() ||
        !std::isfinite(value)) {
      throw UserError(place(field.column),
                      fmt::format("'{}' in column '{}' is not a finite number; write one such as -1.5e-3",
                                  field.text.substr(0, 40), kPathColumns[column]));
    }
    return value;
  }

  std::string path_;
  KinematicsJob& job_;
  std::vector<std::size_t> columns_;
  std::size_t line_ = 0;
};

}  // namespace

void read_path_csv(const std::string& path, KinematicsJob& job) {
  job.file = path;
  PathCsv(path, job).read();
}

}  // namespace morepro::host
