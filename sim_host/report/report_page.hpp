#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sim_host/page/page.hpp"
#include "sim_host/report/series_table.hpp"

namespace morepro::host {

using Json = nlohmann::ordered_json;

/// A dashed line across a chart: the gate, a bound.
struct ChartLimit {
  double value = 0.0;
  std::string label;
};

/// An upright line in a chart, `time_s` after the page's first row.
struct ChartMark {
  double time_s = 0.0;
  std::string label;
};

/// A straight line from one point of a chart to another.
struct ChartSegment {
  double from_s = 0.0;
  double from = 0.0;
  double to_s = 0.0;
  double to = 0.0;
  std::string label;
};

/// A chart over time: names of series that are on the page, all on one grid.
struct TimeChart {
  std::string section;  ///< of the page that shows it
  std::string title;
  std::string unit;
  std::vector<std::string> lines;
  std::string band{};  ///< a series whose smallest and largest values are drawn as an area; empty: none
  std::vector<ChartLimit> limits{};
  std::vector<ChartMark> marks{};
  std::vector<ChartSegment> segments{};
  std::string scale = "linear";  ///< or "log", or "asinh": linear up to 3, logarithmic beyond
};

/// What all reports have in common: the result that --json writes, signals in pyramids, charts, how to make
/// it again. The page shows the sections that it finds data for.
class ReportPage {
 public:
  /// `command`: "diagnose", "replay" or "identify"; "diff" on its own page. Throws UserError where this
  /// program was built without pages.
  explicit ReportPage(std::string_view command, const PageParts& parts = k_report_page);

  void set_span(double start_s, double duration_s, double rate_hz);
  void add(const SeriesTable& table);
  void add(const TimeChart& chart);
  /// Any other part, under a name that the page knows.
  Json& part(std::string_view name) { return data_[std::string(name)]; }

  /// The page. `result`: the text that --json writes. `files`: those that the answer depends on; what is a
  /// file is named with its length and CRC-32.
  [[nodiscard]] std::string html(std::string_view result, std::string_view command_line,
                                 const std::vector<std::string>& files);

 private:
  const PageParts& parts_;
  Json data_;
};

}  // namespace morepro::host
