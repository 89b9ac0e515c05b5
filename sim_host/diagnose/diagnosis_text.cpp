#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/diagnosis_json.hpp"

namespace morepro::host {
namespace {

std::string where_text(const DiagnosisResult& r) {
  std::string text = "where\n";
  for (const BalanceResult& b : r.where) {
    if (!b.is_evaluated) {
      text += fmt::format("  {:16}  not evaluated: {}\n", gap::name_of(b.balance), b.reason);
      continue;
    }
    text +=
        fmt::format("  {:16}  residual ratio {:.3f}, with the effects {:.3f}{}\n", gap::name_of(b.balance),
                    b.residual_ratio, b.residual_ratio_after, b.is_significant ? "  <- gap" : "");
    if (b.onset_s) text += fmt::format("  {:16}  sets in at {:.2f} s\n", "", *b.onset_s);
  }
  return text;
}

std::string size_text(const EffectResult& e) {
  if (std::isnan(e.magnitude)) return "undetermined";
  return fmt::format("{:.4g} +- {:.2g} {}", e.magnitude, e.standard_error, gap::info_of(e.effect).unit);
}

std::string which_text(const DiagnosisResult& r) {
  if (r.which.empty()) return "";
  std::string text = "which\n";
  for (const EffectResult& e : r.which) {
    text += fmt::format("  {} = {}, confidence {:.0f} %\n", gap::name_of(e.effect), size_text(e),
                        100.0 * e.confidence);
    if (const auto other = gap::info_of(e.effect).also_known; !other.empty())
      text += fmt::format("    outside the catalogue, {} looks the same\n", other);
    if (e.alias_set.size() < 2) continue;
    text += "    cannot be told from";
    for (std::size_t i = 1; i < e.alias_set.size(); ++i)
      text += fmt::format("{} {}", i > 1 ? "," : "", gap::name_of(e.alias_set[i]));
    text += fmt::format("\n    {}\n", gap::info_of(e.effect).separate_by);
  }
  return text;
}

// A model that runs away has no error, and a short recording no interval.
std::string percent(const ModelError& error) {
  if (!std::isfinite(error.value)) return fmt::format("{:>17}", "diverges");
  const auto [low, high] = error.interval90;
  if (!std::isfinite(low)) return fmt::format("{:7.3f} {:9}%", 100.0 * error.value, "");
  return fmt::format("{:7.3f} +- {:5.3f} %", 100.0 * error.value, 50.0 * (high - low));
}

std::string models_text(const char* title, const Comparisons& m) {
  std::string text;
  for (std::size_t b = 0; b < gap::kBalanceCount; ++b) {
    if (!m[b]) continue;
    text += fmt::format("  {:9} {:16}  datasheet {}  refit {}  with effects {}  noise {:.3f} %\n", title,
                        gap::kBalanceNames[b], percent(m[b]->datasheet), percent(m[b]->refit),
                        percent(m[b]->with_effect), 100.0 * m[b]->noise_floor);
  }
  return text;
}

std::string shrinkage_text(const DiagnosisResult& r) {
  std::string text = "how far, each piece judged by models of the others (+-: half of the 90 % interval)\n";
  if (!r.which.empty())
    text += fmt::format("  {:.1f} % of the gap is closed on held-out pieces (90 %: {:.1f} .. {:.1f} %)\n",
                        100.0 * r.shrinkage.share_closed, 100.0 * r.shrinkage.interval90[0],
                        100.0 * r.shrinkage.interval90[1]);
  return text + models_text("one step", r.shrinkage.one_step_nrmse) +
         models_text("free run", r.shrinkage.free_run_nrmse);
}

std::string remark_on(const ParameterResult& p) {
  if (p.reason.empty()) return "";
  return (p.is_identifiable ? ", " : "  not identifiable: ") + p.reason;
}

std::string parameter_text(const DiagnosisResult& r) {
  std::string text = "parameters\n";
  for (const ParameterResult& p : r.parameters) {
    text += fmt::format("  {:26}  datasheet {:11.5g}  refit {:11.5g} +- {:.2g}{}\n", p.name, p.datasheet,
                        p.refit, p.standard_error, remark_on(p));
  }
  return text;
}

}  // namespace

std::string diagnosis_text(const DiagnosisResult& r) {
  const std::string head =
      fmt::format("recording   {} rows at {:g} Hz, {:.3f} s, {} missing\nverdict     {}\n            {}\n",
                  r.rows, r.rate_hz, r.duration_s, r.missing_rows, name_of(r.verdict), r.explanation) +
      where_text(r);
  const bool is_any_evaluated =
      std::any_of(r.where.begin(), r.where.end(), [](const BalanceResult& b) { return b.is_evaluated; });
  if (!is_any_evaluated) return head + which_text(r);
  return head + which_text(r) + shrinkage_text(r) + parameter_text(r) +
         fmt::format("threshold   evidence {:.1f}, temperature {:.2f}, {} bootstrap runs\n",
                     r.threshold_evidence, r.temperature, r.bootstrap_runs);
}

}  // namespace morepro::host
