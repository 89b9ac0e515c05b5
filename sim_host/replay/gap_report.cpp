#include "sim_host/replay/gap_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/gap/effect_catalogue.hpp"

namespace morepro::host {
namespace {

using Json = nlohmann::ordered_json;
using gap::GapVerdict;

// The digits that a float32 has, not the ones that its double has.
Json readable_or_null(float value) {
  return std::isfinite(value) ? Json(std::stod(fmt::format("{}", value))) : Json(nullptr);
}

bool has_evidence(GapVerdict verdict) {
  return verdict != GapVerdict::kNotEnoughData && verdict != GapVerdict::kInsufficientExcitation;
}

std::string effect_text(const gap::GapFinding& finding) {
  std::string text(gap::name_of(finding.effect));
  for (std::size_t i = 0; i < finding.alias_count; ++i)
    text += fmt::format("{}{}", i == 0 ? " or " : ", ", gap::name_of(finding.alias[i]));
  return fmt::format("{} ({}), confidence {:.2f}, evidence {:.0f}", text, gap::name_of(finding.where),
                     finding.confidence, finding.evidence);
}

}  // namespace

std::vector<gap::Effect> alias_set(const gap::GapFinding& finding) {
  if (finding.verdict != GapVerdict::kEffect) return {};
  std::vector<gap::Effect> effects{finding.effect};
  effects.insert(effects.end(), finding.alias.begin(), finding.alias.begin() + finding.alias_count);
  return effects;
}

nlohmann::ordered_json gap_json(const gap::GapFinding& finding) {
  const bool is_named = finding.verdict == GapVerdict::kEffect;
  Json aliases = Json::array();
  for (const gap::Effect effect : alias_set(finding)) aliases.push_back(gap::name_of(effect));
  return {{"verdict", gap::name_of(finding.verdict)},
          {"where", is_named ? Json(gap::name_of(finding.where)) : Json(nullptr)},
          {"effect", is_named ? Json(gap::name_of(finding.effect)) : Json(nullptr)},
          {"alias_set", std::move(aliases)},
          {"confidence", is_named ? readable_or_null(finding.confidence) : Json(nullptr)},
          {"evidence", has_evidence(finding.verdict) ? readable_or_null(finding.evidence) : Json(nullptr)}};
}

std::string gap_text(const gap::GapFinding& finding) {
  switch (finding.verdict) {
    case GapVerdict::kNotEnoughData:
      return "not enough data to compare the machine with its model";
    case GapVerdict::kNoGap:
      return "none: the machine does what its model says";
    case GapVerdict::kInsufficientExcitation:
      return "not judged: the machine has not moved enough to tell causes apart";
    case GapVerdict::kParameterError:
      return "parameter_error: other values of the datasheet's parameters explain it";
    case GapVerdict::kUnexplained:
      return "unexplained: by the parameters or by an effect that the board knows";
    case GapVerdict::kEffect:
      return effect_text(finding);
  }
  return "unknown";
}

}  // namespace morepro::host
