#include "sim_host/report/report_page.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "lib/wire/crc32.hpp"
#include "sim_host/support/input_file.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

Json file_of(const std::string& path) {
  Json file{{"path", path}, {"bytes", nullptr}, {"crc32", nullptr}};
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return file;  // what came through a pipe is gone
  const InputFile input(path);
  const std::string_view text = input.text();
  file["bytes"] = text.size();
  file["crc32"] =
      fmt::format("{:08x}", wire::crc32({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
  return file;
}

}  // namespace

ReportPage::ReportPage(std::string_view command, const PageParts& parts) : parts_(parts) {
  if (const std::string why = why_no_page(parts_); !why.empty()) throw UserError(why);
  data_ = {{"schema", "morepro.report/1"},
           {"command", command},
           {"result", nullptr},
           {"span", nullptr},
           {"origin", nullptr},
           {"series", Json::object()},
           {"charts", Json::array()}};
}

void ReportPage::set_span(double start_s, double duration_s, double rate_hz) {
  data_["span"] = {{"start_s", start_s}, {"duration_s", duration_s}, {"rate_hz", rate_hz}};
}

void ReportPage::add(const SeriesTable& table) { data_["series"].update(table.json()); }

void ReportPage::add(const TimeChart& chart) {
  Json limits = Json::array();
  for (const ChartLimit& limit : chart.limits)
    limits.push_back({{"value", limit.value}, {"label", limit.label}});
  Json marks = Json::array();
  for (const ChartMark& mark : chart.marks) marks.push_back({{"x", mark.time_s}, {"label", mark.label}});
  Json segments = Json::array();
  for (const ChartSegment& s : chart.segments)
    segments.push_back({{"from", {{"x", s.from_s}, {"y", s.from}}},
                        {"to", {{"x", s.to_s}, {"y", s.to}}},
                        {"label", s.label}});
  data_["charts"].push_back({{"section", chart.section},
                             {"title", chart.title},
                             {"unit", chart.unit},
                             {"lines", chart.lines},
                             {"band", chart.band.empty() ? Json(nullptr) : Json(chart.band)},
                             {"limits", std::move(limits)},
                             {"marks", std::move(marks)},
                             {"segments", std::move(segments)},
                             {"scale", chart.scale}});
}

std::string ReportPage::html(std::string_view result, std::string_view command_line,
                             const std::vector<std::string>& files) {
  Json list = Json::array();
  for (const std::string& file : files)
    if (const Json entry = file_of(file); !entry["crc32"].is_null()) list.push_back(entry);
  data_["origin"] = {
      {"program", "morepro " MOREPRO_VERSION}, {"command_line", command_line}, {"files", std::move(list)}};
  data_["result"] = Json::parse(result);
  return page_html(parts_, data_.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace morepro::host
