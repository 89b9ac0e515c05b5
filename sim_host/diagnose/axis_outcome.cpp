#include "sim_host/diagnose/axis_outcome.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "sim_host/diagnose/nominal_fit.hpp"

namespace morepro::host {
namespace {

constexpr double kSearchShare = 0.9;  // of an axis's time, about

ChanceEvidence bootstrapped(const AxisDiagnosis& diagnosis, const DiagnosisOptions& options) {
  int done = 0;
  return chance_evidence(diagnosis.fit, diagnosis.rest, diagnosis.others, options.bootstrap_runs,
                         options.seed, [&] {
                           const double share = ++done / static_cast<double>(options.bootstrap_runs);
                           options.on_progress(kSearchShare + (1.0 - kSearchShare) * share);
                         });
}

void drop_what_chance_explains(AxisDiagnosis& diagnosis, double threshold) {
  auto& found = diagnosis.found;
  const auto is_chance = [&](const Finding& f) { return !(f.evidence >= diagnosis.needed(f, threshold)); };
  if (std::none_of(found.begin(), found.end(), is_chance)) return;
  std::vector<Finding> kept;
  std::copy_if(found.begin(), found.end(), std::back_inserter(kept),
               [&](const Finding& f) { return !is_chance(f); });
  found = std::move(kept);
  if (found.empty()) {
    diagnosis.fit = diagnosis.nominal;
    return;
  }
  auto& effects = diagnosis.fit.model().effects;
  effects.clear();
  for (const Finding& finding : found) effects.push_back(finding.effect);
  diagnosis.fit.settle();
  for (std::size_t i = 0; i < found.size(); ++i) found[i].effect = effects[i];
}

double datasheet_evidence(const AxisFit& nominal) {
  AxisFit datasheet = nominal;
  datasheet.model().machine = nominal.datasheet().machine;
  const GapStatistics wrong = datasheet.innovations();
  const GapStatistics right = nominal.innovations();
  if (!(right.total_rows() > 0.0)) return 0.0;
  const double rows = right.total_rows();
  const double freedom = static_cast<double>(parameter_count(nominal.axis()));
  return rows * std::log(wrong.total()(0, 0) / right.total()(0, 0)) - freedom * std::log(rows);
}

AxisOutcome outcome_from(const AxisFit& start, const AxisFit& nominal, const DiagnosisOptions& options) {
  const auto on_progress = [&](double share) { options.on_progress(kSearchShare * share); };
  AxisOutcome outcome{search_effects(start, nominal, options.excluded, kFixedThreshold, on_progress)};
  outcome.chance = bootstrapped(outcome.diagnosis, options);
  drop_what_chance_explains(outcome.diagnosis, outcome.threshold());
  outcome.leftover = leftover_of(outcome.diagnosis.fit, outcome.threshold());
  return outcome;
}

/// A good deal is left, or it took many effects: perhaps the parameters that the search began with were not
/// the right ones.
bool is_doubtful(const AxisOutcome& outcome) {
  constexpr std::size_t kManyEffects = 3;
  constexpr double kGoodDeal = 0.1;  // of everything, in deviance
  const double left = outcome.leftover.gain;
  const bool is_left = left >= kLeastUnnamed && left > kGoodDeal * (left + outcome.named_deviance());
  return is_left || outcome.diagnosis.found.size() >= kManyEffects;
}

}  // namespace

double AxisOutcome::threshold() const { return std::max(diagnosis.least_evidence, chance.quantile99); }

double AxisOutcome::named_deviance() const {
  if (diagnosis.found.empty()) return 0.0;
  return std::max(diagnosis.nominal.unlikeliness() - diagnosis.fit.unlikeliness(), 0.0);
}

std::optional<AxisOutcome> outcome_of(Axis axis, const RecordingSignals& signals, const GapModel& datasheet,
                                      const DiagnosisOptions& options) {
  const std::vector<AxisFit> starts = nominal_fits(AxisFit(axis, signals, datasheet));
  if (starts.front().unlikeliness() == 0.0) return std::nullopt;
  AxisOutcome outcome = outcome_from(starts.front(), starts.front(), options);
  if (starts.size() > 1 && is_doubtful(outcome)) {
    AxisOutcome other = outcome_from(starts.back(), starts.front(), options);
    if (other.diagnosis.cost() < outcome.diagnosis.cost()) outcome = std::move(other);
  }
  outcome.diagnosis.fit.attribute_load();
  outcome.diagnosis.nominal.attribute_load();
  outcome.parameter_evidence = datasheet_evidence(outcome.diagnosis.nominal);
  return outcome;
}

}  // namespace morepro::host
