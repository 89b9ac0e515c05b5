#include "sim_host/diagnose/search/effect_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "sim_host/diagnose/search/onset.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

constexpr double kNoEvidence = -1.0e300;

/// Is there anything between the shapes that were tried? Periods are whole numbers, pitches are standard.
bool has_shape(const gap::EffectForm& form) {
  return form.shape > 0.0F && form.effect != Effect::kSpindleCogging &&
         form.effect != Effect::kFeedScrewPeriodic;
}

/// Of an effect that the machine file states there may be less, too.
bool is_known(const GapModel& model, Effect effect) {
  return std::any_of(model.known.begin(), model.known.end(),
                     [effect](const gap::AppliedEffect& one) { return one.form.effect == effect; });
}

double evidence_of(double rss, double gain, double rows, double freedom) {
  const double left = std::max(rss - gain, 1.0e-9 * rss);
  const double evidence = rows * std::log(rss / left) - freedom * std::log(std::max(rows, 2.0));
  return std::isfinite(evidence) ? evidence : kNoEvidence;
}

/// Of the forms of each effect.
void keep_best(std::map<Effect, Candidate>& best, const Candidate& candidate) {
  const auto [place, is_new] = best.emplace(candidate.form.effect, candidate);
  if (!is_new && candidate.evidence > place->second.evidence) place->second = candidate;
}

std::vector<gap::EffectForm> around(gap::EffectForm form, double centre, double spread) {
  constexpr int kSteps = 4;
  std::vector<gap::EffectForm> forms;
  for (int i = -kSteps; i <= kSteps; ++i) {
    form.shape = static_cast<float>(centre * std::pow(spread, static_cast<double>(i) / kSteps));
    forms.push_back(form);
  }
  return forms;
}

void take_best(const AxisFit& axis, const GapStatistics& statistics,
               const std::vector<gap::EffectForm>& forms, Candidate& finest) {
  const Eigen::MatrixXd moments = statistics.total();
  const Eigen::Index width = moments.cols();
  const Remainder rest =
      remainder(moments, axis.parameter_columns(), axis.precision(width), axis.target(width));
  auto column = static_cast<Eigen::Index>(parameter_count(axis.axis()));
  for (const gap::EffectForm& form : forms) {
    Eigen::VectorXd coefficient;
    const double gain = gain_of(rest, moments, column, form.parts, coefficient);
    column += form.parts;
    const double evidence = evidence_of(rest.rss, gain, statistics.total_rows(), form.parts + 1.0);
    if (!(evidence > finest.evidence)) continue;
    finest.form = form;
    finest.evidence = evidence;
    finest.coefficient.assign(coefficient.data(), coefficient.data() + coefficient.size());
  }
}

/// What grows with the cutting time grows from its onset on: its late column is no tail of the early one.
bool grows(Effect effect) { return effect == Effect::kToolWearRamp || effect == Effect::kFeedContactDrift; }

/// Tries onsets `step_s` apart, `count` on either side of the best one so far.
void try_starts(const AxisFit& axis, const gap::EffectForm& form, double step_s, int count, LateStart& best) {
  std::vector<double> onset_s;
  for (int i = -count; i <= count; ++i)
    if (const double start_s = best.onset_s + i * step_s; start_s >= 0.0) onset_s.push_back(start_s);
  const std::vector<gap::EffectForm> forms(onset_s.size(), form);
  const Eigen::MatrixXd moments = axis.collect_with_each({forms, onset_s}).total();
  const Eigen::Index width = moments.cols();
  if (width == 0) return;
  const Remainder rest =
      remainder(moments, axis.parameter_columns(), axis.precision(width), axis.target(width));
  auto column = static_cast<Eigen::Index>(parameter_count(axis.axis()));
  for (const double start_s : onset_s) {
    Eigen::VectorXd coefficient;
    const double rss = rest.rss - gain_of(rest, moments, column, form.parts, coefficient);
    column += form.parts;
    if (start_s == 0.0) best.rss_at_start = rss;
    if (best.rss_without > 0.0 && !(rss < best.rss)) continue;
    best.rss_without = rest.rss;
    best.rss = rss;
    best.onset_s = start_s;
    best.coefficient = coefficient;
  }
}

LateStart best_growing_start(const AxisFit& axis, gap::EffectForm form) {
  constexpr int kCoarse = 12;
  constexpr int kFine = 6;
  const double duration_s = axis.signals().duration_s();
  form.parts = 1;  // a bend would do the work of an onset
  LateStart best;
  try_starts(axis, form, duration_s / (kCoarse + 2), kCoarse, best);
  if (best.onset_s > 0.0) try_starts(axis, form, duration_s / (kCoarse + 2) / (kFine + 1), kFine, best);
  return best;
}

/// Blocks tell an onset to their length. An effect that begins so much too late leaves a disturbance
/// that parameters and process noise would be fitted to.
void place_onset(const AxisFit& axis, Candidate& candidate) {
  constexpr double kBeforeS = 1.0;
  constexpr int kSteps = 8;
  AxisFit late = axis;
  late.look_at_the_end(candidate.onset_s - std::max(kBeforeS, axis.block_s()));
  LateStart best;
  best.onset_s = candidate.onset_s;
  for (double step_s = axis.block_s() / kSteps; step_s > 0.5 / axis.signals().rate_hz; step_s /= kSteps)
    try_starts(late, candidate.form, step_s, kSteps, best);
  if (!(best.rss_without > 0.0) || !(best.onset_s > 0.0)) return;
  candidate.onset_s = best.onset_s;
  candidate.coefficient.assign(best.coefficient.begin(), best.coefficient.end());
}

}  // namespace

std::vector<Candidate> rank_candidates(const AxisFit& axis, const GapStatistics& statistics,
                                       const std::vector<gap::EffectForm>& forms) {
  const Eigen::MatrixXd moments = statistics.total();
  const Eigen::Index width = moments.cols();
  if (width == 0) return {};
  const Remainder rest =
      remainder(moments, axis.parameter_columns(), axis.precision(width), axis.target(width));
  const double rows = statistics.total_rows();
  std::map<Effect, int> shapes;
  for (const auto& form : forms) ++shapes[form.effect];
  std::map<Effect, Candidate> best;
  std::map<Effect, Candidate> wrong_way;
  auto column = static_cast<Eigen::Index>(parameter_count(axis.axis()));
  for (const gap::EffectForm& form : forms) {
    Eigen::VectorXd coefficient;
    const double gain = gain_of(rest, moments, column, form.parts, coefficient);
    const double freedom = form.parts + (shapes[form.effect] > 1 ? 1.0 : 0.0);
    Candidate candidate{.form = form,
                        .column = column,
                        .evidence = evidence_of(rest.rss, gain, rows, freedom),
                        .coefficient = {}};
    candidate.coefficient.assign(coefficient.data(), coefficient.data() + coefficient.size());
    column += form.parts;
    const bool is_impossible = gap::acts_one_way(form.effect) && !(candidate.coefficient[0] > 0.0) &&
                               !is_known(axis.model(), form.effect);
    keep_best(is_impossible ? wrong_way : best, candidate);
  }
  std::vector<Candidate> ranked;
  for (auto& [effect, candidate] : best) ranked.push_back(std::move(candidate));
  // What cannot have been there from the start may have set in later.
  for (auto& [effect, candidate] : wrong_way) {
    if (best.contains(effect)) continue;
    candidate.evidence = kNoEvidence;
    ranked.push_back(std::move(candidate));
  }
  std::sort(ranked.begin(), ranked.end(),
            [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
  return ranked;
}

void let_set_in(const AxisFit& axis, const GapStatistics& statistics, std::vector<Candidate>& ranked) {
  const double rows = statistics.total_rows();
  for (Candidate& candidate : ranked) {
    const bool is_growing = grows(candidate.form.effect);
    if (is_growing && !(candidate.evidence > 0.0)) continue;
    const LateStart start = is_growing ? best_growing_start(axis, candidate.form)
                                       : best_start(axis, statistics, candidate.column, candidate.form.parts);
    if (!is_surely_late(start, rows)) continue;
    if (gap::acts_one_way(candidate.form.effect) && !(start.coefficient(0) > 0.0)) continue;
    if (is_growing) candidate.form.parts = 1;
    const double evidence =
        evidence_of(start.rss_without, start.rss_without - start.rss, rows, candidate.form.parts + 2.0);
    if (!(evidence > candidate.evidence)) continue;
    candidate.evidence = evidence;
    candidate.onset_s = start.onset_s;
    candidate.coefficient.assign(start.coefficient.begin(), start.coefficient.end());
  }
  const bool has_parameter = axis.datasheet().machine.feed.viscous_friction_ns_m > 0.0;
  std::erase_if(ranked, [has_parameter](const Candidate& c) {
    const bool is_parameter = c.form.effect == Effect::kFeedViscousFriction && has_parameter;
    return !(c.evidence > kNoEvidence) || (is_parameter && !(c.onset_s > 0.0));
  });
  std::sort(ranked.begin(), ranked.end(),
            [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
}

Candidate refined(const AxisFit& axis, const Candidate& candidate) {
  Candidate finest = candidate;
  if (candidate.onset_s > 0.0 && !grows(candidate.form.effect)) place_onset(axis, finest);
  if (!has_shape(candidate.form)) return finest;
  // Where the slide is in its play, what came before decides: no part of the recording tells its width.
  const bool is_play = candidate.form.effect == gap::Effect::kFeedBacklash;
  AxisFit part = axis;
  if (!is_play) part.narrow_down();
  finest.evidence = kNoEvidence;
  const bool is_pure_shape = gap::size_is_shape(candidate.form.effect) && candidate.form.parts == 1;
  double centre = static_cast<double>(candidate.form.shape);
  // Half of a lag looks like half as long a lag.
  if (is_pure_shape) centre *= std::clamp(candidate.coefficient[0], 0.1, 4.0);
  for (const double spread : is_play ? std::vector{2.0, 1.2, 1.05} : std::vector{2.0, 1.2}) {
    const auto forms = around(candidate.form, centre, spread);
    const std::vector<double> onset_s(forms.size(), finest.onset_s);
    take_best(part, part.collect_with_each({forms, onset_s}), forms, finest);
    centre = static_cast<double>(finest.form.shape);
  }
  return finest;
}

void prefer(Candidate preferred, double most, std::vector<Candidate>& ranked) {
  const auto is_same = [&](const Candidate& c) { return c.form.effect == preferred.form.effect; };
  const bool is_best = std::any_of(ranked.begin(), ranked.end(), [&](const Candidate& c) {
    return is_same(c) && !c.is_lifted && c.evidence >= most;
  });
  preferred.is_lifted = !is_best && (preferred.is_lifted || preferred.evidence < most);
  preferred.evidence = std::max(preferred.evidence, most);
  std::erase_if(ranked, is_same);
  ranked.insert(ranked.begin(), std::move(preferred));
}

}  // namespace morepro::host
