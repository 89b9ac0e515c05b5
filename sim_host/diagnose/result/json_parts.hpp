#pragma once
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim_host/diagnose/result/diagnosis_result.hpp"

/// What the results of `diagnose` and `identify` have in common as JSON.
namespace morepro::host {

using Json = nlohmann::ordered_json;

/// null where there is no value.
inline Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json json_parameters(const std::vector<ParameterResult>& results) {
  Json parameters = Json::array();
  for (const ParameterResult& p : results)
    parameters.push_back({{"name", p.name},
                          {"datasheet", json_number(p.datasheet)},
                          {"refit", json_number(p.refit)},
                          {"standard_error", json_number(p.standard_error)},
                          {"identifiable", p.is_identifiable},
                          {"reason", p.reason}});
  return parameters;
}

/// `Result`: has file, rows, rate_hz, duration_s and missing_rows of its recording.
template <class Result>
Json json_recording(const Result& r) {
  return {{"file", r.file},
          {"rows", r.rows},
          {"rate_hz", r.rate_hz},
          {"duration_s", r.duration_s},
          {"missing_rows", r.missing_rows}};
}

/// Bytes that are no UTF-8, of a file's name or its metadata, are replaced.
inline std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace morepro::host
