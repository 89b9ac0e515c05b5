#include "sim_host/diagnose/search/effect_duel.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/gap/effect_form.hpp"
#include "sim_host/diagnose/search/angle_evidence.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "sim_host/diagnose/search/effect_trial.hpp"
#include "sim_host/diagnose/search/friction_shape.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

// Rivals with this share of the best evidence are put into the model, one after the other, before one is
// chosen.
constexpr double kNearlyAsGood = 0.6;
constexpr std::size_t kMostTrials = 6;  // in all, where those before them turn out to be worth nothing

/// A load that follows the speed with a higher power than any cut: what a droop by a hundredth makes of
/// something else. Right ones of tests/blind and another simulator were 0.05 to 0.98 of the load, absurd ones
/// 12 to 50.
bool is_absurd(const gap::AppliedEffect& effect, const AxisFit& fit) {
  constexpr double kHighestPower = 5.0;
  if (effect.form.effect != gap::Effect::kFeedCuttingSpeedDependence) return false;
  const double load_n = std::max(std::fabs(fit.model().machine.feed.contact_force_n),
                                 std::fabs(fit.datasheet().machine.feed.contact_force_n));
  return load_n > 0.0 && std::fabs(effect.coefficient[0]) > kHighestPower * load_n;
}

class Duel {
 public:
  Duel(const AxisFit& fit, const DuelTerms& terms) : fit_(fit), terms_(terms), without_(fit.as_rival()) {}

  AxisFit run(std::vector<Candidate>& ranked) {
    for (Candidate& rival : ranked) rival.promised = rival.evidence;
    try_sure_ones(ranked);
    const std::size_t sure = trials_.size();
    for (std::size_t i = 0; i < ranked.size(); ++i) {
      if (i >= sure && !gets_its_turn(ranked[i])) {
        ranked[i].evidence = std::min(kept_ * ranked[i].evidence, best_);
        continue;
      }
      if (i >= sure) trials_.push_back(tried(ranked[i]));
      weigh(i < sure ? trials_[i] : trials_.back(), ranked[i]);
      if (!ranked[i].is_lifted && ranked[i].evidence >= terms_.least_evidence) ++kept_trials_;
    }
    for (Candidate& rival : ranked) sharpen_near(rival);
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
    put_plain_first(ranked);
    const AxisFit* winner = fit_of(ranked.front());
    return winner != nullptr ? *winner : fit_;
  }

 private:
  [[nodiscard]] EffectTrial tried(const Candidate& rival) const {
    return try_effect(fit_, rival, without_, terms_.is_astray);
  }

  /// Those that get a trial whatever the others turn out to be worth, side by side.
  void try_sure_ones(const std::vector<Candidate>& ranked) {
    const double enough = std::max(kNearlyAsGood * ranked.front().evidence, terms_.least_evidence);
    std::size_t count = 0;
    while (count < std::min(kMostRivals, ranked.size()) && ranked[count].evidence >= enough) ++count;
    std::vector<std::optional<EffectTrial>> trials(count);
    in_parallel(count, [&](std::size_t i) { trials[i] = tried(ranked[i]); });
    for (auto& trial : trials) trials_.push_back(std::move(*trial));
  }

  /// The rival as its trial has left it.
  void weigh(const EffectTrial& trial, Candidate& rival) {
    rival = trial.candidate;
    const double own = without_.everywhere - trial.fit.unlikeliness() -
                       freedom_cost(trial.fit, trial.fit.model().effects.back());
    rival.evidence = own + angle_evidence(trial.fit, own);
    const GapModel& model = trial.fit.model();
    const gap::AppliedEffect& newest = model.effects.back();
    const bool is_possible = !acts_the_wrong_way(newest, trial.fit) && !is_absurd(newest, trial.fit);
    if (is_possible && !rival.is_lifted) promised_most_ = std::max(promised_most_, rival.promised);
    if (!is_possible || !std::isfinite(rival.evidence)) rival.evidence = -1.0e300;
    if (!(rival.evidence > best_)) return;
    best_ = rival.evidence;
    kept_ = own / rival.promised;
    if (rival.is_lifted) kept_ = std::min(kept_, 1.0);
    family_ = family_of(rival.form.effect);
  }

  /// The range of a curve that is gone beyond one is searched for where it may decide, not for every loser.
  void sharpen_near(Candidate& rival) {
    if (!gap::is_stribeck(rival.form.effect) || !(rival.evidence >= kNearlyAsGood * best_)) return;
    for (EffectTrial& trial : trials_) {
      if (trial.candidate.form.effect != rival.form.effect) continue;
      sharpen_range_of_newest(trial.fit);
      trial.candidate.form = trial.fit.model().effects.back().form;
      weigh(trial, rival);
    }
  }

  [[nodiscard]] bool gets_its_turn(const Candidate& rival) const {
    return trials_.size() < kMostTrials &&
           (is_worth_a_trial(rival) || is_other_lag(rival) || is_other_friction(rival));
  }

  /// In the order of what a linearisation promises, which it may not keep: then those behind get their turn.
  [[nodiscard]] bool is_worth_a_trial(const Candidate& rival) const {
    if (rival.evidence < terms_.least_evidence) return false;
    const double best = std::min(best_, promised_most_);
    return best < terms_.least_evidence ||
           (kept_trials_ < kMostRivals && rival.evidence >= kNearlyAsGood * best);
  }

  /// A lag, a delay and a bandwidth do nearly the same of one size, and bent parameters hide which: where one
  /// is the best, the others get their turn, too.
  [[nodiscard]] bool is_other_lag(const Candidate& rival) const {
    constexpr double kNoticeably = 0.1;
    return is_lag(family_) && family_of(rival.form.effect) == family_ && rival.evidence > kNoticeably * best_;
  }

  /// What a curve at rest takes in a linearisation, beside process noise that hides it, tells little.
  [[nodiscard]] bool is_other_friction(const Candidate& rival) const {
    constexpr double kNoticeably = 0.1;
    return family_ == Family::kDryFriction && gap::is_stribeck(rival.form.effect) &&
           rival.evidence > kNoticeably * promised_most_;
  }

  [[nodiscard]] const AxisFit* fit_of(const Candidate& candidate) const {
    for (const EffectTrial& trial : trials_)
      if (trial.candidate.form.effect == candidate.form.effect) return &trial.fit;
    return nullptr;
  }

  void put_plain_first(std::vector<Candidate>& ranked) const {
    for (const Plainer& pair : kPlainer) {
      if (ranked.front().form.effect != pair.fine) continue;
      const double enough_evidence = pair.undecided * ranked.front().evidence;
      const auto plain = std::find_if(ranked.begin(), ranked.end(), [&](const Candidate& rival) {
        return rival.form.effect == pair.plain && rival.evidence >= enough_evidence;
      });
      if (plain == ranked.end() || fit_of(*plain) == nullptr) continue;
      std::rotate(ranked.begin(), plain, plain + 1);
      return;
    }
  }

  const AxisFit& fit_;
  const DuelTerms& terms_;
  AxisFit::Rival without_;
  std::vector<EffectTrial> trials_;
  std::size_t kept_trials_ = 0;  ///< those that came to something, without what was lifted
  double promised_most_ = 0.0;   ///< to one that is possible, by itself
  double best_ = 0.0;
  double kept_ = 1.0;  ///< of what the linearisation promised to the best; of a lifted one at most all
  Family family_ = Family::kNone;
};

}  // namespace

AxisFit duel(const AxisFit& fit, const DuelTerms& terms, std::vector<Candidate>& ranked) {
  return Duel(fit, terms).run(ranked);
}

}  // namespace morepro::host
