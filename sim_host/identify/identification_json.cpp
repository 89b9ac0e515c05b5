#include "sim_host/diagnose/result/json_parts.hpp"
#include "sim_host/identify/identification.hpp"

namespace morepro::host {
namespace {

Json axes_of(const IdentificationResult& r) {
  Json axes = Json::array();
  for (const AxisFitFigures& a : r.axes)
    axes.push_back(
        {{"axis", a.axis},
         {"innovation_ratio", json_number(a.innovation_ratio)},
         {"innovation_correlation", json_number(a.correlation)},
         {"process_noise_share", {json_number(a.process_share[0]), json_number(a.process_share[1])}},
         {"passes", a.passes}});
  return axes;
}

Json derivatives_of(const IdentificationResult& r) {
  Json derivatives = Json::object();
  for (const DerivativeOrigin& d : r.derivatives)
    derivatives[d.quantity] = d.is_measured ? "measured" : "difference";
  return derivatives;
}

}  // namespace

std::string identification_json(const IdentificationResult& r) {
  Json json{{"schema", "morepro.identification/1"},
            {"recording", json_recording(r)},
            {"machine", r.machine},
            {"filter", r.filter == IdentificationFilter::kStates ? "states" : "derivatives"},
            {"parameters", json_parameters(r.parameters)},
            {"fit", axes_of(r)},
            {"excitation", {{"sufficient", r.is_sufficient}, {"advice", r.advice}}}};
  if (!r.derivatives.empty()) json["derivatives"] = derivatives_of(r);
  return json_text(json);
}

}  // namespace morepro::host
