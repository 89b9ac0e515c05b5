#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim_host/identify/identification.hpp"

namespace morepro::host {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json parameters_of(const IdentificationResult& r) {
  Json parameters = Json::array();
  for (const ParameterResult& p : r.parameters)
    parameters.push_back({{"name", p.name},
                          {"datasheet", number(p.datasheet)},
                          {"refit", number(p.refit)},
                          {"standard_error", number(p.standard_error)},
                          {"identifiable", p.is_identifiable},
                          {"reason", p.reason}});
  return parameters;
}

Json axes_of(const IdentificationResult& r) {
  Json axes = Json::array();
  for (const AxisFitFigures& a : r.axes)
    axes.push_back({{"axis", a.axis},
                    {"innovation_ratio", number(a.innovation_ratio)},
                    {"innovation_correlation", number(a.correlation)},
                    {"process_noise_share", {number(a.process_share[0]), number(a.process_share[1])}},
                    {"passes", a.passes}});
  return axes;
}

}  // namespace

std::string identification_json(const IdentificationResult& r) {
  const Json json{{"schema", "morepro.identification/1"},
                  {"recording",
                   {{"file", r.file},
                    {"rows", r.rows},
                    {"rate_hz", r.rate_hz},
                    {"duration_s", r.duration_s},
                    {"missing_rows", r.missing_rows}}},
                  {"machine", r.machine},
                  {"filter", r.filter == IdentificationFilter::kStates ? "states" : "derivatives"},
                  {"parameters", parameters_of(r)},
                  {"fit", axes_of(r)},
                  {"excitation", {{"sufficient", r.is_sufficient}, {"advice", r.advice}}}};
  // Bytes that are no UTF-8 can come from a file's name or metadata.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace morepro::host
