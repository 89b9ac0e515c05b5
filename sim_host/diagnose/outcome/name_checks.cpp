#include "sim_host/diagnose/outcome/name_checks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sim_host/diagnose/balances/balance_rows.hpp"
#include "sim_host/diagnose/balances/model_comparison.hpp"
#include "sim_host/diagnose/balances/share_closed.hpp"
#include "sim_host/diagnose/balances/where.hpp"
#include "sim_host/diagnose/fit/input_news.hpp"
#include "sim_host/diagnose/fit/white_innovations.hpp"
#include "sim_host/diagnose/leftover/wandering.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

// Share of its evidence that a name keeps. Of 95 right ones, on tests/blind and of another simulator, one
// kept less than 0.15 (0.04, beside three wrong ones), of 70 wrong ones 30, most of them of causes that have
// no name. Of 60 right ones of a third simulator two kept 0.09 and 0.12 beside strong random forces, and that
// was 0.09 and 0.025 per row; wrong ones with so small a share had up to 0.011. Less than usual, and no more
// than noise may be worth, kept none of the right ones.
constexpr double kLeastKept = 0.07;
constexpr double kSmallShare = 0.15;
constexpr double kChance = 1.0;
// Evidence over what is predictable of the innovations that are left: names that random forces of a
// millisecond or two had made had 0.8 at most, those of causes that have no name 1.7. Right ones that lasting
// noise could have stood in for, with parameters three times the datasheet's, had 2.2 and more.
constexpr double kBeyondNoise = 2.0;
// Names that are worth less than noise that lasts may be: of 31 that random forces had made, in production
// and with rich excitation, none kept more than 0.2, of 11 right ones of 0.002 to 0.004 per row none less
// than 0.43 nor had a larger error.
constexpr double kSurelyKept = 0.4;
constexpr double kSureError = 0.1;  // of the size
// Of what lags keep beside noise that lasts: right ones 0.1 and more on tests/blind and 0.078 in production,
// those that a controller's sight of the state had made 0.02 and less.
constexpr double kLeastNews = 0.05;
// Evidence per row that a lag may have made of it: it had up to 0.09.
constexpr double kMostOfNews = 0.1;

/// Those for which `is_dropped` is not 0.
void drop(AxisDiagnosis& diagnosis, const std::vector<char>& is_dropped) {
  std::vector<Finding> kept;
  for (std::size_t i = 0; i < is_dropped.size(); ++i)
    if (is_dropped[i] == 0) kept.push_back(std::move(diagnosis.found[i]));
  diagnosis.found = std::move(kept);
  if (diagnosis.found.empty()) {
    diagnosis.fit = diagnosis.nominal;
    return;
  }
  auto& effects = diagnosis.fit.change_model().effects;
  effects.clear();
  for (const Finding& finding : diagnosis.found) effects.push_back(finding.effect);
  diagnosis.fit.settle();
  diagnosis.take_sizes();
}

AxisFit without(const AxisDiagnosis& diagnosis, std::size_t index) {
  if (diagnosis.found.size() == 1) return diagnosis.nominal;
  AxisFit fit = diagnosis.fit;
  auto& effects = fit.change_model().effects;
  effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(index));
  return fit;
}

/// `left`: deviance beside noise that lasts, a share `kept` of what it was without.
bool keeps_too_little(double left, double kept, double rows) {
  const bool is_little = kept < kLeastKept || (kept < kSmallShare && left < kMuch * rows);
  return (is_little || left < kMostOfNoise * rows) && kept < kUsuallyKept;
}

/// Is a name's size known to be any? A model with the name may be worth more than one without it for another
/// noise beside it: names that random forces had made had sizes of up to three standard errors and kept up to
/// 2000, right ones had 17 and more.
bool has_size(const Finding& finding, const AxisFit& fit) {
  constexpr double kLargestError = 0.2;  // of the size
  return fit.relative_error_beside_inertia_of(finding.effect.form.effect) < kLargestError;
}

/// Evidence that lasting noise makes of no name. What wanders can be worth anything to names that are not
/// there.
double beyond_noise_of(const AxisFit& fit) {
  return remembers_for_long(fit) ? 1.0e300 : kBeyondNoise * predictable_deviance(fit.innovations());
}

/// Worth little, but hardly less beside noise that lasts.
bool is_sure(const Finding& finding, const AxisFit& fit) {
  return finding.kept > kSurelyKept &&
         fit.relative_error_beside_inertia_of(finding.effect.form.effect) < kSureError;
}

/// Does a model with the name run free nine tenths nearer to what is measured, in pieces that it was not
/// fitted to, and is it far beyond the sensors' noise without? Noise that lasts helps an observer, who sees
/// what it does, and not a model that runs free.
bool runs_free_with(const AxisDiagnosis& diagnosis, std::size_t index) {
  constexpr double kNearer = 0.9;
  constexpr double kVisible = 1.5;
  AxisDiagnosis one = diagnosis;
  one.nominal = without(diagnosis, index);
  if (diagnosis.found.size() > 1) one.nominal.settle();
  Shrinkage errors;
  compare_models(one, 0, errors);
  const auto is_nearer = [](const std::optional<ModelComparison>& models) {
    return models && models->refit.value > kVisible * models->sensor_floor &&
           share_predicted(models) > kNearer;
  };
  return std::any_of(errors.free_run_nrmse.begin(), errors.free_run_nrmse.end(), is_nearer);
}

/// Of the names that keep too little of their evidence beside noise that lasts, the one that keeps least.
std::optional<std::size_t> most_doubtful_beside_lasting_noise(AxisDiagnosis& diagnosis,
                                                              double noise_evidence) {
  const std::size_t count = diagnosis.found.size();
  if (count == 0) return std::nullopt;
  const double beyond_noise = beyond_noise_of(diagnosis.fit);
  const double of_all = diagnosis.named_deviance();  // others may make up for one of them
  std::vector<AxisFit> fits;
  for (std::size_t i = 0; i < count; ++i) fits.push_back(without(diagnosis, i));
  fits.push_back(diagnosis.fit);
  std::vector<double> deviance(count + 1);
  in_parallel(count + 1,
              [&](std::size_t i) { deviance[i] = fits[i].refit_beside_lasting_noise(Memory::kShort); });
  const auto rows = static_cast<double>(diagnosis.fit.signals().rows);
  std::optional<std::size_t> doubtful;
  for (std::size_t i = 0; i < count; ++i) {
    Finding& finding = diagnosis.found[i];
    if (diagnosis.needed(finding, kChance) < kChance) continue;  // another one states it along
    const bool is_sized = has_size(finding, fits[count]);
    const double left = is_sized ? deviance[i] - deviance[count] : 0.0;
    finding.kept = left / std::max(finding.evidence, kChance);
    const bool is_least = !doubtful || finding.kept < diagnosis.found[*doubtful].kept;
    const bool is_beyond_noise = is_sized && std::min(finding.evidence, of_all) > beyond_noise;
    const bool is_weak = finding.evidence < diagnosis.needed(finding, noise_evidence);
    const bool is_doubted = is_weak ? !is_sure(finding, fits[count])
                                    : !is_beyond_noise && keeps_too_little(left, finding.kept, rows) &&
                                          !runs_free_with(diagnosis, i);
    if (is_doubted && is_least) doubtful = i;
  }
  return doubtful;
}

/// A lag or a delay.
bool is_late(const Finding& finding) { return is_lag(family_of(finding.effect.form.effect)); }

bool outlasts_a_step(const Finding& finding, double rate_hz) {
  return is_late(finding) && static_cast<double>(finding.effect.form.shape) * rate_hz > 1.0;
}

/// Without the names it is another machine, which hides from every balance what they explain: a mass four
/// times the datasheet's moves beside random forces as one does that 8 N of friction hold.
bool bring_values_back(const AxisDiagnosis& diagnosis) {
  return diagnosis.nominal.has_gone_astray() && !diagnosis.fit.has_gone_astray();
}

}  // namespace

void drop(AxisDiagnosis& diagnosis, std::size_t index) {
  std::vector<char> is_dropped(diagnosis.found.size(), 0);
  is_dropped[index] = 1;
  drop(diagnosis, is_dropped);
}

bool drop_what_chance_explains(AxisDiagnosis& diagnosis, double threshold) {
  std::vector<char> is_chance;
  for (const Finding& finding : diagnosis.found)
    is_chance.push_back(finding.evidence >= diagnosis.needed(finding, threshold) ? 0 : 1);
  if (std::count(is_chance.begin(), is_chance.end(), 1) == 0) return false;
  drop(diagnosis, is_chance);
  return true;
}

// Of random forces, means over 40 ms know up to 210 of those before them, of a force that changes every half
// a second 500, of a sensor that wanders within seconds 1300.
bool remembers_for_long(const AxisFit& fit) {
  constexpr double kMuchOfMeans = 300.0;
  constexpr std::size_t kLast = 1;
  return slowly_predictable_deviance(fit.innovations(), rows_of_mean(kLongS, fit), kLast) > kMuchOfMeans;
}

// One after the other: a right name keeps little beside a wrong one.
bool drop_what_lasting_noise_explains(AxisDiagnosis& diagnosis, double noise_evidence) {
  // Of a thinned recording what remembers itself is structure.
  if (diagnosis.fit.signals().is_thinned) return false;
  bool has_changed = false;
  while (const auto doubtful = most_doubtful_beside_lasting_noise(diagnosis, noise_evidence)) {
    drop(diagnosis, *doubtful);
    has_changed = true;
  }
  return has_changed;
}

// On tests/blind functions kept half of it and more where the cause has no name; random forces of 2 ms, of
// another simulator, left them a hundredth of 0.005 to 0.011 per row.
bool is_lasting_noise(const AxisFit& fit, const Leftover& leftover) {
  const auto rows = static_cast<double>(fit.signals().rows);
  const double taken = leftover.by_functions;
  if (leftover.functions.empty() || !leftover.lines.empty() || taken >= kMuch * rows) return false;
  if (fit.signals().is_thinned) return false;
  std::array<AxisFit, 2> fits{fit, fit};
  for (const gap::EffectForm& form : leftover.functions)
    fits[1].change_model().effects.push_back({.form = form});
  std::array<double, 2> deviance{};
  in_parallel(fits.size(),
              [&](std::size_t i) { deviance[i] = fits[i].refit_beside_lasting_noise(Memory::kShort); });
  const double left = deviance[0] - deviance[1];
  return keeps_too_little(left, left / taken, rows);
}

bool drop_what_input_news_explain(AxisDiagnosis& diagnosis) {
  const AxisFit& fit = diagnosis.fit;
  const double most = kMostOfNews * static_cast<double>(fit.signals().rows);
  const auto is_doubted = [most](const Finding& f) { return is_late(f) && f.evidence < most; };
  if (std::none_of(diagnosis.found.begin(), diagnosis.found.end(), is_doubted)) return false;
  const InputNews news = input_news(fit.axis(), fit.signals(), fit.model());
  AxisFit all = fit;
  const double deviance = all.refit_beside_lasting_noise(Memory::kShort, &news);
  std::vector<char> is_explained;
  for (std::size_t i = 0; i < diagnosis.found.size(); ++i) {
    const Finding& finding = diagnosis.found[i];
    is_explained.push_back(0);
    if (!is_doubted(finding)) continue;
    AxisFit other = without(diagnosis, i);
    const double left = other.refit_beside_lasting_noise(Memory::kShort, &news) - deviance;
    if (left < kLeastNews * finding.kept * finding.evidence) is_explained.back() = 1;
  }
  if (std::count(is_explained.begin(), is_explained.end(), 1) == 0) return false;
  drop(diagnosis, is_explained);
  return true;
}

bool drop_what_no_balance_shows(AxisDiagnosis& diagnosis) {
  constexpr double kSeen = 1.005;  // residual ratio
  const double much = kMuch * static_cast<double>(diagnosis.fit.signals().rows);
  const double rate_hz = diagnosis.fit.signals().rate_hz;
  const auto is_seen = [=](const Finding& finding) {
    return finding.evidence > much || outlasts_a_step(finding, rate_hz);
  };
  if (diagnosis.found.empty() || std::any_of(diagnosis.found.begin(), diagnosis.found.end(), is_seen) ||
      bring_values_back(diagnosis))
    return false;
  for (const BalanceResult& balance : balances_of(diagnosis, balance_rows(diagnosis)))
    if (balance.is_evaluated && balance.residual_ratio > kSeen * balance.residual_ratio_after) return false;
  drop(diagnosis, std::vector<char>(diagnosis.found.size(), 1));
  return true;
}

}  // namespace morepro::host
