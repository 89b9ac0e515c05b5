#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/result/diagnosis_json.hpp"
#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

std::string name_of_cell(const GapCell& cell, gap::Balance balance) {
  constexpr double kLine = 0.05;  // of a frequency or an order: nothing between that could be read
  if (cell.by == "contact") return cell.from > 0.0 ? "in contact" : "without contact";
  if (cell.by == "direction") return cell.from > 0.0 ? "forwards" : "backwards";
  const bool is_line = cell.to - cell.from < kLine * cell.to;
  if (cell.by == "order") return fmt::format("at order {:.4g}", 0.5 * (cell.from + cell.to));
  if (cell.by == "frequency" && is_line) return fmt::format("at {:.4g} Hz", 0.5 * (cell.from + cell.to));
  const std::string_view unit = cell.by == "temperature"              ? "degC"
                                : cell.by == "frequency"              ? "Hz"
                                : cell.by == "time"                   ? "s"
                                : balance == gap::Balance::kFeedForce ? "m/s"
                                                                      : "rad/s";
  return fmt::format("at {:.4g} .. {:.4g} {}", cell.from, cell.to, unit);
}

/// What leaves more at all orders alike does not go with the turn.
double usual_order(const BalanceResult& balance) {
  std::vector<double> ratios;
  for (const GapCell& cell : balance.cells)
    if (cell.by == "order" && cell.from == cell.to) ratios.push_back(cell.residual_ratio);
  if (ratios.empty()) return 1.0;
  return median_of(ratios);
}

/// The kinds of cells that stand out of their balance, the best one of each.
std::string cells_text(const BalanceResult& balance) {
  constexpr std::size_t kMostKinds = 4;
  constexpr double kStandsOut = 1.2;  // times the excess of the whole balance
  constexpr double kPeak = 4.0;       // times the usual order
  const double order = usual_order(balance);
  std::vector<const GapCell*> best;
  for (const GapCell& cell : balance.cells) {
    const bool stands_out = cell.residual_ratio - 1.0 > kStandsOut * (balance.residual_ratio - 1.0);
    if (!stands_out || !(cell.p_value < 0.01)) continue;
    if (cell.by == "order" && cell.residual_ratio < kPeak * order) continue;
    const auto same =
        std::find_if(best.begin(), best.end(), [&](const GapCell* c) { return c->by == cell.by; });
    if (same == best.end())
      best.push_back(&cell);
    else if (cell.residual_ratio > (*same)->residual_ratio)
      *same = &cell;
  }
  std::sort(best.begin(), best.end(),
            [](const GapCell* a, const GapCell* b) { return a->residual_ratio > b->residual_ratio; });
  best.resize(std::min(best.size(), kMostKinds));
  std::string text;
  for (const GapCell* cell : best)
    text +=
        fmt::format("  {:16}  {:.1f} {}\n", "", cell->residual_ratio, name_of_cell(*cell, balance.balance));
  return text;
}

/// What structure without a name follows: the best signals of each balance.
std::string follows_text(const DiagnosisResult& r) {
  constexpr std::size_t kMostSignals = 4;
  std::string text;
  if (r.verdict != Verdict::kUnexplained) return text;
  for (std::size_t b = 0; b < gap::kBalanceCount; ++b) {
    std::vector<std::string_view> signals;
    for (const FollowedSignal& one : r.unexplained_follows)
      if (static_cast<std::size_t>(one.balance) == b && signals.size() < kMostSignals)
        signals.push_back(one.signal);
    if (!signals.empty())
      text += fmt::format("  {:16}  what has no name follows {}\n", gap::kBalanceNames[b],
                          fmt::join(signals, "; "));
  }
  return text;
}

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
    if (b.is_significant) text += cells_text(b);
    if (b.onset_s) text += fmt::format("  {:16}  sets in at {:.2f} s\n", "", *b.onset_s);
  }
  return text + follows_text(r);
}

std::string with_unit(const std::string& size, gap::Effect effect) {
  const std::string_view unit = gap::info_of(effect).unit;
  return unit == "1" ? size : fmt::format("{} {}", size, unit);
}

std::string size_text(const EffectResult& e) {
  if (std::isnan(e.magnitude)) return "undetermined";
  return with_unit(fmt::format("{:.4g} +- {:.2g}", e.magnitude, e.standard_error), e.effect);
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
    const double noise = m[b]->noise_floor;
    text += fmt::format("  {:9} {:16}  datasheet {}  refit {}  with effects {}  noise {}\n", title,
                        gap::kBalanceNames[b], percent(m[b]->datasheet), percent(m[b]->refit),
                        percent(m[b]->with_effect),
                        std::isfinite(noise) ? fmt::format("{:.3f} %", 100.0 * noise) : "unknown");
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

std::string limit_text(const DetectionLimit& limit) {
  const gap::EffectInfo& info = gap::info_of(limit.effect);
  if (!std::isfinite(limit.size)) return fmt::format("{} ({})", info.name, info.excitation);
  return fmt::format("{} {}", info.name, with_unit(fmt::format("{:.2g}", limit.size), limit.effect));
}

std::string not_found_text(const DiagnosisResult& r) {
  if (r.not_found.empty()) return "";
  std::string text = "not found; each alone would have been from about this size on\n";
  std::vector<std::string> not_shown;
  for (std::size_t g = 0; g < gap::kEffectGroupNames.size(); ++g) {
    std::vector<std::string> seen;
    for (const DetectionLimit& limit : r.not_found) {
      const bool is_here = static_cast<std::size_t>(gap::info_of(limit.effect).group) == g;
      if (is_here) (std::isfinite(limit.size) ? seen : not_shown).push_back(limit_text(limit));
    }
    if (!seen.empty()) text += fmt::format("  {:16}  {}\n", gap::kEffectGroupNames[g], fmt::join(seen, ", "));
  }
  if (!not_shown.empty()) text += fmt::format("  {:16}  {}\n", "not shown", fmt::join(not_shown, ", "));
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
  return head + which_text(r) + not_found_text(r) + shrinkage_text(r) + parameter_text(r) +
         fmt::format("threshold   evidence {:.1f}, temperature {:.2f}, {} bootstrap runs\n",
                     r.threshold_evidence, r.temperature, r.bootstrap_runs);
}

}  // namespace morepro::host
