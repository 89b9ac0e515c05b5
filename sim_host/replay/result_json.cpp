#include "sim_host/replay/result_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/monitor/reason.hpp"
#include "sim_host/replay/gap_report.hpp"
#include "sim_host/replay/names.hpp"

namespace morepro::host {
namespace {

using Json = nlohmann::ordered_json;

// The digits that a float32 has, not the ones that its double has.
double readable(float value) { return std::isfinite(value) ? std::stod(fmt::format("{}", value)) : 0.0; }

Json recording_of(const ReplayResult& r) {
  return {{"file", r.info.file},
          {"rows", r.tally.rows},
          {"rate_hz", r.info.rate_hz},
          {"duration_s", std::round(r.tally.duration_s * 1.0e6) / 1.0e6},
          {"missing_rows", r.tally.missing_rows},
          {"complete", r.damage.empty()},
          {"damage", r.damage}};
}

Json frames_of(const ReplayResult& r) {
  return {{"accepted", r.last.frames_accepted},
          {"rejected", r.last.frames_rejected},
          {"missing", r.last.frames_missing},
          {"reasons", r.reasons.empty() ? Json::object() : Json(r.reasons)}};
}

Json chip_load_of(const ReplayResult& r) {
  Json chip_load{
      {"estimate", nullptr}, {"standard_error", nullptr}, {"state", name_of(r.judged.chip_load_state)}};
  if (!r.has_chip_load()) return chip_load;
  chip_load["estimate"] = readable(r.judged.chip_load_mm);
  chip_load["standard_error"] = readable(r.judged.chip_load_standard_error_mm);
  chip_load["time_s"] = r.judged_time_s;
  return chip_load;
}

Json bank_of(const ReplayResult& r) {
  Json probability = Json::array();
  for (std::size_t i = 0; r.has_probability() && i < r.hypotheses_mm.size(); ++i)
    probability.push_back(readable(r.probability[i]));
  Json bank{{"hypotheses_mm", r.has_contact ? Json(r.hypotheses_mm) : Json::array()},
            {"probability", probability},
            {"selected", nullptr},
            {"rule", name_of(r.configuration.rule)}};
  if (r.has_chip_load()) bank["selected"] = r.judged.selected_hypothesis;
  return bank;
}

Json parameters_of(const ReplayResult& r) {
  Json parameters = Json::array();
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const auto parameter = static_cast<Parameter>(i);
    const ParameterEstimate& estimate = r.last.parameters[i];
    const bool is_identifiable = estimate.status == ParameterStatus::kIdentifiable;
    Json entry{{"name", name_of(parameter)},
               {"datasheet", nullptr},
               {"refit", nullptr},
               {"standard_error", nullptr},
               {"identifiable", is_identifiable},
               {"reason", reason_of(r, parameter)}};
    if (is_described(r, parameter)) entry["datasheet"] = datasheet_value(r.configuration.machine, parameter);
    if (is_identifiable) {
      entry["refit"] = readable(estimate.value);
      entry["standard_error"] = readable(estimate.standard_error);
    }
    parameters.push_back(entry);
  }
  return parameters;
}

Json health_of(const ReplayResult& r) {
  const Health health = verdict_of(r);
  const ReasonText reason = verdict_reason(r);
  return {{"state", name_of(health.state)},
          {"reason", fmt::format("{}: {}", reason.name, reason.sentence)},
          {"code", static_cast<std::uint16_t>(reason.code)},
          {"likely_cause", reason.cause},
          {"next_step", reason.next_step}};
}

Json parts_of(const ReplayResult& r) {
  Json parts = Json::array();
  for (const EvaluatedPart& part : r.parts) {
    parts.push_back({{"part", part.name}, {"evaluated", part.is_evaluated}, {"reason", part.reason}});
  }
  return parts;
}

}  // namespace

std::string result_json(const ReplayResult& result) {
  const Json json{{"schema", "morepro.replay/1"},
                  {"recording", recording_of(result)},
                  {"machine", result.machine_name},
                  {"frames", frames_of(result)},
                  {"chip_load_mm", chip_load_of(result)},
                  {"bank", bank_of(result)},
                  {"parameters", parameters_of(result)},
                  {"evaluation", parts_of(result)},
                  {"gap", gap_json(result.last.gap)},
                  {"health", health_of(result)},
                  {"timing", {{"frames_per_s", std::round(result.frames_per_s())}}}};
  // Bytes that are no UTF-8 can come from a file's name or metadata.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace morepro::host
