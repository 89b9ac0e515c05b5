#include "sim_host/diagnose/result/diagnosis_json.hpp"

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/result/json_parts.hpp"
#include "sim_host/replay/gap_report.hpp"

namespace morepro::host {
namespace {

Json where_of(const DiagnosisResult& r) {
  Json where = Json::array();
  for (const BalanceResult& b : r.where) {
    Json cells = Json::array();
    for (const GapCell& c : b.cells)
      cells.push_back({{"by", c.by},
                       {"from", json_number(c.from)},
                       {"to", json_number(c.to)},
                       {"residual_ratio", json_number(c.residual_ratio)},
                       {"p_value", json_number(c.p_value)}});
    Json balance{
        {"balance", gap::name_of(b.balance)},
        {"evaluated", b.is_evaluated},
        {"residual_ratio", b.is_evaluated ? json_number(b.residual_ratio) : Json(nullptr)},
        {"residual_ratio_after", b.is_evaluated ? json_number(b.residual_ratio_after) : Json(nullptr)},
        {"significant", b.is_significant},
        {"cells", std::move(cells)},
        {"onset_s", b.onset_s ? json_number(*b.onset_s) : Json(nullptr)}};
    if (!b.is_evaluated) balance["reason"] = b.reason;
    where.push_back(std::move(balance));
  }
  return where;
}

Json which_of(const DiagnosisResult& r) {
  Json which = Json::array();
  for (const EffectResult& e : r.which) {
    Json aliases = Json::array();
    for (const gap::Effect alias : e.alias_set) aliases.push_back(gap::name_of(alias));
    which.push_back({{"effect", gap::name_of(e.effect)},
                     {"confidence", json_number(e.confidence)},
                     {"magnitude", json_number(e.magnitude)},
                     {"unit", gap::info_of(e.effect).unit},
                     {"standard_error", json_number(e.standard_error)},
                     {"evidence", json_number(e.evidence)},
                     {"alias_set", std::move(aliases)},
                     {"other_causes", gap::info_of(e.effect).also_known},
                     {"separate_by", gap::info_of(e.effect).separate_by}});
  }
  return which;
}

Json unexplained_of(const DiagnosisResult& r) {
  Json follows = Json::array();
  for (const FollowedSignal& one : r.unexplained_follows)
    follows.push_back({{"balance", gap::name_of(one.balance)}, {"signal", one.signal}});
  return {{"evidence", json_number(r.unexplained_evidence)},
          {"share", json_number(r.unexplained_share)},
          {"follows", std::move(follows)}};
}

Json comparison_of(const Comparisons& models) {
  Json comparison = Json::object();
  for (std::size_t b = 0; b < gap::kBalanceCount; ++b) {
    if (!models[b]) continue;
    comparison[std::string(gap::kBalanceNames[b])] = {
        {"datasheet", json_number(models[b]->datasheet.value)},
        {"refit", json_number(models[b]->refit.value)},
        {"with_effect", json_number(models[b]->with_effect.value)},
        {"noise_floor", json_number(models[b]->noise_floor)}};
  }
  return comparison;
}

Json interval_of(const ModelError& error) {
  return {json_number(error.interval90[0]), json_number(error.interval90[1])};
}

Json intervals_of(const Comparisons& models) {
  Json intervals = Json::object();
  for (std::size_t b = 0; b < gap::kBalanceCount; ++b) {
    if (!models[b]) continue;
    intervals[std::string(gap::kBalanceNames[b])] = {{"datasheet", interval_of(models[b]->datasheet)},
                                                     {"refit", interval_of(models[b]->refit)},
                                                     {"with_effect", interval_of(models[b]->with_effect)}};
  }
  return intervals;
}

Json shrinkage_of(const Shrinkage& s) {
  Json free_run{{"horizon_s", s.horizon_s}};
  free_run.update(comparison_of(s.free_run_nrmse));
  return {{"held_out", true},
          {"share_closed", json_number(s.share_closed)},
          {"ci90", {json_number(s.interval90[0]), json_number(s.interval90[1])}},
          {"one_step_nrmse", comparison_of(s.one_step_nrmse)},
          {"free_run_nrmse", std::move(free_run)},
          {"one_step_nrmse_ci90", intervals_of(s.one_step_nrmse)},
          {"free_run_nrmse_ci90", intervals_of(s.free_run_nrmse)}};
}

Json not_found(const DiagnosisResult& r) {
  Json limits = Json::array();
  for (const DetectionLimit& limit : r.not_found) {
    const gap::EffectInfo& info = gap::info_of(limit.effect);
    limits.push_back({{"effect", info.name},
                      {"detection_limit", json_number(limit.size)},
                      {"unit", info.unit},
                      {"needs", info.excitation}});
  }
  return limits;
}

Json board_of(const DiagnosisResult& r) {
  Json board = gap_json(r.board);
  board["agrees"] = r.board_agrees;
  return board;
}

}  // namespace

std::string diagnosis_json(const DiagnosisResult& r) {
  const Json json{{"schema", "morepro.diagnosis/1"},
                  {"recording", json_recording(r)},
                  {"verdict", name_of(r.verdict)},
                  {"explanation", r.explanation},
                  {"where", where_of(r)},
                  {"which", which_of(r)},
                  {"unexplained", unexplained_of(r)},
                  {"not_found", not_found(r)},
                  {"shrinkage", shrinkage_of(r.shrinkage)},
                  {"parameters", json_parameters(r.parameters)},
                  {"board", board_of(r)},
                  {"threshold",
                   {{"evidence", json_number(r.threshold_evidence)},
                    {"temperature", json_number(r.temperature)},
                    {"bootstrap_runs", r.bootstrap_runs}}}};
  return json_text(json);
}

}  // namespace morepro::host
