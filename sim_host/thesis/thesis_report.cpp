#include "sim_host/thesis/thesis_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim_host/kinematics/trajectory_page.hpp"
#include "sim_host/page/page.hpp"
#include "sim_host/thesis/demonstration_path.hpp"

namespace morepro::host::thesis {
namespace {

using nlohmann::json;

std::string text_of(const std::optional<Range>& range) {
  if (!range) return "-";
  if (range->low == range->high) return fmt::format("{:.4g}", range->low);
  return fmt::format("{:.4g} .. {:.4g}", range->low, range->high);
}

json json_of(const std::optional<Range>& range) {
  return range ? json{range->low, range->high} : json(nullptr);
}

json json_of(const Chart& chart) {
  json curves = json::array();
  for (const Curve& curve : chart.curves)
    curves.push_back({{"label", curve.label}, {"y", curve.y}, {"dashed", curve.is_dashed}});
  return {{"title", chart.title},
          {"unit", chart.unit},
          {"x_name", chart.x_name},
          {"x", chart.x},
          {"curves", curves}};
}

json json_of(const Figure& figure, bool with_curves) {
  json comparisons = json::array();
  for (const Comparison& one : figure.comparisons) {
    comparisons.push_back({{"quantity", one.quantity},
                           {"unit", one.unit},
                           {"printed", json_of(one.printed)},
                           {"ours", json_of(one.ours)},
                           {"difference", difference_of(one)}});
  }
  json result{{"figure", figure.number},
              {"section", figure.section},
              {"title", figure.title},
              {"comparisons", comparisons},
              {"remark", figure.remark}};
  if (!with_curves) return result;
  result["charts"] = json::array();
  for (const Chart& chart : figure.charts) result["charts"].push_back(json_of(chart));
  return result;
}

json json_of(const BankTrialRow& row) {
  const auto time = [](double ms) { return std::isfinite(ms) ? json(ms) : json(nullptr); };
  return {{"machine", row.machine},
          {"noise", row.noise},
          {"mismatch", row.mismatch},
          {"rule", row.rule},
          {"contact_ms", time(row.contact_ms)},
          {"switch_ms", time(row.switch_ms)},
          {"right_share", row.right_share},
          {"mean_error_mm", row.mean_error_mm}};
}

json document_of(const std::vector<Figure>& figures, const std::vector<BankTrialRow>& bank,
                 bool with_curves) {
  json result{{"schema", "morepro.thesis/1"}, {"figures", json::array()}, {"bank", json::array()}};
  for (const Figure& figure : figures) result["figures"].push_back(json_of(figure, with_curves));
  for (const BankTrialRow& row : bank) result["bank"].push_back(json_of(row));
  return result;
}

std::string time_text(double ms) { return std::isfinite(ms) ? fmt::format("{:.1f} ms", ms) : "never"; }

}  // namespace

std::string figures_text(const std::vector<Figure>& figures) {
  std::string text = fmt::format("{:<44} {:>17} {:>17}  {}\n", "quantity", "printed", "ours", "difference");
  for (const Figure& figure : figures) {
    text += fmt::format("figure {} ({}): {}\n", figure.number, figure.section, figure.title);
    for (const Comparison& one : figure.comparisons) {
      const std::string quantity = one.unit == "1" ? one.quantity : one.quantity + ", " + one.unit;
      text += fmt::format("  {:<42} {:>17} {:>17}  {}\n", quantity, text_of(one.printed), text_of(one.ours),
                          difference_of(one));
    }
    text += fmt::format("  {}\n", figure.remark);
  }
  return text;
}

std::string bank_text(const std::vector<BankTrialRow>& rows, int runs) {
  std::string text = fmt::format(
      "Decision on the chip load, {} runs each: time until 95 % of the runs are right, after contact and "
      "after a "
      "change; share of right answers and mean error in the last 50 ms.\n",
      runs);
  text += fmt::format("{:<9} {:>5}  {:<23}  {:<16} {:>9} {:>9} {:>6} {:>10}\n", "machine", "noise",
                      "not as stated", "rule", "contact", "change", "right", "error, mm");
  for (const BankTrialRow& row : rows) {
    text +=
        fmt::format("{:<9} {:>3g} x  {:<23}  {:<16} {:>9} {:>9} {:>4.0f} % {:>+10.4f}\n", row.machine,
                    row.noise, row.mismatch.empty() ? "-" : row.mismatch, row.rule, time_text(row.contact_ms),
                    time_text(row.switch_ms), 100.0 * row.right_share, row.mean_error_mm);
  }
  return text;
}

std::string thesis_json(const std::vector<Figure>& figures, const std::vector<BankTrialRow>& bank) {
  return document_of(figures, bank, false).dump(2) + "\n";
}

std::string thesis_page(const std::vector<Figure>& figures, const std::vector<BankTrialRow>& bank) {
  json data = document_of(figures, bank, true);
  const KinematicsJob job = demonstration_path();
  TrajectoryPage animation(job);
  compute_trajectory(job, [&](const TrajectoryRow& row) { animation.add(row); });
  data["animation"] = json::parse(animation.json(""));
  return page_html(k_thesis_page, data.dump());
}

}  // namespace morepro::host::thesis
