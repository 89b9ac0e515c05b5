#include "sim_host/diagnose/search/axis_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "sim_host/diagnose/fit/nominal_fit.hpp"
#include "sim_host/diagnose/search/candidate_forms.hpp"
#include "sim_host/diagnose/search/effect_duel.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "sim_host/diagnose/search/effect_trial.hpp"
#include "sim_host/diagnose/search/friction_and_drag.hpp"
#include "sim_host/diagnose/search/friction_shape.hpp"
#include "sim_host/diagnose/search/newest_effect.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kMostEffects = 4;
// Standard error over size. What is worth its evidence is known to a seventh; a size that is not known at all
// let the parameters settle elsewhere, and that was its worth.
constexpr double kUnknownSize = 0.5;
// Beside an effect that the machine file states, with the shape that a recording has given it.
constexpr double kLeastShareOfKnown = 0.02;

// Of other plain effects beside the finer one: by chance once in a thousand, and what its shape leaves.
constexpr double kRarely = 12.0;
constexpr double kAlways = -1.0e300;

/// Does it contain a constant force, whatever else it does? Then a force beside it is nothing new, and where
/// a force was chosen instead it does as well, which makes it no rival.
bool contains_force(const gap::EffectForm& form) {
  return form.effect == gap::Effect::kFeedSpring && form.parts > 1;
}

bool by_evidence(const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; }

Whitening without_memory(Whitening whitening) {
  for (SensorWhitening& sensor : whitening) sensor.memory = {};
  return whitening;
}

class DiagnosisSearch {
 public:
  DiagnosisSearch(AxisDiagnosis& diagnosis, std::span<const gap::Effect> excluded, double to_beat,
                  const std::function<void(double)>& on_progress)
      : diagnosis_(diagnosis),
        fit_(diagnosis.fit),
        to_beat_(to_beat),
        excluded_(excluded.begin(), excluded.end()),
        left_out_(excluded_),
        on_progress_(on_progress) {}

  void run() {
    diagnosis_.known_evidence = evidence_of_known();
    diagnosis_.least_evidence =
        std::max(diagnosis_.least_evidence, kLeastShareOfKnown * diagnosis_.known_evidence);
    add_all();
    if (diagnosis_.is_behind(to_beat_)) return;
    bool has_changed = prune();
    if (split_curve()) {
      add_all();
      prune();
      has_changed = true;
    }
    if (has_changed || diagnosis_.found.size() == kMostEffects) collect_rest();
  }

 private:
  void add_all() {
    while (diagnosis_.found.size() < kMostEffects && !diagnosis_.is_behind(to_beat_) && add_one())
      if (diagnosis_.found.size() == 2) diagnosis_.cost_of_two = cost_of(fit_);
  }

  [[nodiscard]] bool may_be_found(gap::Effect effect) const {
    const auto is_it = [effect](const gap::AppliedEffect& one) { return one.form.effect == effect; };
    const auto& model = fit_.model();
    return std::ranges::count(excluded_, effect) == 0 && std::ranges::none_of(model.known, is_it) &&
           std::ranges::none_of(model.effects, is_it);
  }

  /// Friction and drag for one curve, where these do as well. Was there any?
  bool split_curve() {
    constexpr auto kDrag = gap::Effect::kSpindleWindage, kFriction = gap::Effect::kSpindleCoulombFriction;
    auto& found = diagnosis_.found;
    const auto curve = std::ranges::find_if(found, [](const Finding& finding) {
      return finding.effect.form.effect == gap::Effect::kSpindleStribeckFriction;
    });
    if (curve == found.end() || !may_be_found(kFriction)) return false;
    const auto index = static_cast<std::size_t>(curve - found.begin());
    const bool may_drag = may_be_found(kDrag) && found.size() < kMostEffects;
    auto both = friction_and_drag_instead(diagnosis_, index, may_drag);
    if (!both) return false;
    fit_ = std::move(*both);
    before_newest_.reset();
    const Finding replaced = std::move(*curve);
    found.erase(curve);
    while (found.size() < fit_.model().effects.size()) {
      const gap::AppliedEffect& one = fit_.model().effects[found.size()];
      left_out_.push_back(one.form.effect);
      found.push_back({.effect = one,
                       .evidence = replaced.evidence,
                       .rivals = {{.form = one.form, .evidence = replaced.evidence, .coefficient = {}}}});
    }
    inherit_rivals(replaced, found.back());
    diagnosis_.take_sizes();
    return true;
  }

  void collect_rest() {
    diagnosis_.others = candidate_forms(fit_.axis(), fit_.signals(), fit_.model(), left_out_);
    diagnosis_.rest = fit_.collect_with_each(diagnosis_.others);
  }

  // Beside a stated effect another one has to be worth as much as beside one that was found.
  double evidence_of_known() const {
    if (fit_.model().known.empty()) return 0.0;
    AxisFit without = fit_;
    without.change_model().known.clear();
    without.settle(kDuelRounds);
    const double evidence = without.unlikeliness() - fit_.unlikeliness();
    return std::isfinite(evidence) ? evidence : 0.0;
  }

  bool add_one() {
    on_progress_(static_cast<double>(diagnosis_.found.size()) / static_cast<double>(kMostEffects));
    collect_rest();
    auto ranked = rank_candidates(fit_, diagnosis_.rest, diagnosis_.others);
    let_set_in(fit_, diagnosis_.rest, ranked);
    is_astray_ = is_bent(fit_);
    if (is_astray_) prefer_by_datasheet(ranked);
    prefer_what_friction_holds(ranked);
    prefer_what_memory_hides(ranked);
    if (add_best_of(ranked)) return true;
    // A model without effects may have taken for noise what is missing.
    if (is_astray_ || !diagnosis_.found.empty()) return false;
    if (!leaves_noise(fit_))
      prefer_by_datasheet(ranked);
    else if (!needs_random_forces(fit_) || !prefer_shaft_that_noise_hides(ranked))
      return false;
    is_astray_ = true;
    return add_best_of(std::move(ranked));
  }

  bool add_best_of(std::vector<Candidate> ranked) {
    if (ranked.empty() || !(ranked.front().evidence >= diagnosis_.least_evidence)) return false;
    AxisFit winner = duel(fit_, {diagnosis_.least_evidence, is_astray_}, ranked);
    const bool has_grown = winner.model().effects.size() > fit_.model().effects.size();
    if (!has_grown || !(ranked.front().evidence >= diagnosis_.least_evidence)) return false;
    const gap::EffectForm& chosen = winner.model().effects.back().form;
    if (chosen.effect == gap::Effect::kFeedForceOffset)
      std::erase_if(ranked, [](const Candidate& c) { return contains_force(c.form); });
    left_out_.push_back(chosen.effect);
    if (contains_force(chosen)) left_out_.push_back(gap::Effect::kFeedForceOffset);
    before_newest_ = std::exchange(fit_, std::move(winner));
    if (fit_.model().effects.size() > 1) begin_from_the_start();
    if (needs_noise(fit_)) sharpen_earlier_frictions(fit_);
    diagnosis_.found.push_back({.effect = fit_.model().effects.back(),
                                .evidence = ranked.front().evidence,
                                .rivals = std::move(ranked)});
    diagnosis_.take_sizes();
    return true;
  }

  /// Alone, one of two causes explains most where the other one was least, and seems to set in then. Not the
  /// newest one, which has just been judged beside all others.
  void begin_from_the_start() {
    for (std::size_t i = 0; i + 1 < fit_.model().effects.size(); ++i) {
      const gap::AppliedEffect late = fit_.model().effects[i];
      if (!(late.onset_s > 0.0)) continue;
      AxisFit other = fit_;
      gap::AppliedEffect& early = other.change_model().effects[i];
      early.onset_s = 0.0;
      const double price = freedom_cost(fit_, late) - freedom_cost(other, early);
      other.settle(kDuelRounds);
      if (other.unlikeliness() < fit_.unlikeliness() + price) fit_ = std::move(other);
    }
  }

  /// What every candidate promises beside another model, and from when on.
  std::vector<Candidate> ranked_beside(const AxisFit& fit) const {
    const GapStatistics statistics = fit.collect_with_each(diagnosis_.others);
    auto ranked = rank_candidates(fit, statistics, diagnosis_.others);
    let_set_in(fit, statistics, ranked);
    return ranked;
  }

  /// What explains most beside the datasheet's parameters comes first; bent ones hide it.
  void prefer_by_datasheet(std::vector<Candidate>& ranked) const {
    AxisFit fit = at_datasheet(fit_);
    if (is_bent(fit_)) fit.match_noise();  // which may take what is hidden from the other model, too
    auto others = ranked_beside(fit);
    others.resize(std::min(others.size(), kMostRivals - 1));
    const double most = ranked.empty() ? 0.0 : ranked.front().evidence;
    for (auto preferred = others.rbegin(); preferred != others.rend(); ++preferred)
      prefer(std::move(*preferred), most, ranked);
  }

  /// A shaft that explains most beside the usual process noise gets its trial; random forces that its
  /// swinging passed for hide it. Was there any? What else does so, a clock that shakes among it, is left to
  /// noise.
  bool prefer_shaft_that_noise_hides(std::vector<Candidate>& ranked) const {
    if (fit_.axis() != Axis::kSpindle) return false;
    AxisFit quiet = fit_;
    quiet.expect_noise(kUsualNoiseShare);
    quiet.set_whitening({});
    auto hidden = ranked_beside(quiet);
    if (hidden.empty() || hidden.front().form.effect != gap::Effect::kShaftCompliance) return false;
    hidden.front().evidence = diagnosis_.least_evidence;  // beside noise that is too little it is another one
    hidden.front().is_lifted = true;
    prefer(std::move(hidden.front()), ranked.empty() ? 0.0 : ranked.front().evidence, ranked);
    return true;
  }

  /// A constant force on an axis that sticks is in no linearisation: the friction holds it, and gets bent by
  /// it. So where a friction leaves more than noise the force gets its trial, whatever it promises.
  void prefer_what_friction_holds(std::vector<Candidate>& ranked) const {
    if (diagnosis_.found.empty() || leaves_noise(fit_)) return;
    const bool is_held = std::any_of(diagnosis_.found.begin(), diagnosis_.found.end(), [](const Finding& f) {
      return family_of(f.effect.form.effect) == Family::kDryFriction;
    });
    const auto force = std::find_if(ranked.begin(), ranked.end(), [](const Candidate& c) {
      return c.form.effect == gap::Effect::kFeedForceOffset;
    });
    if (!is_held || force == ranked.end()) return;
    prefer(*force, std::max(ranked.front().evidence, diagnosis_.least_evidence), ranked);
  }

  /// What comes back with every turn is known before it comes: a memory of what was left takes nearly all of
  /// it, and hardly anything is promised for its cause. What explains most without a memory gets its trial.
  void prefer_what_memory_hides(std::vector<Candidate>& ranked) const {
    if (ranked.empty() || leaves_noise(fit_)) return;
    AxisFit plain = fit_;
    plain.set_whitening(without_memory(fit_.whitening()));
    auto seen = ranked_beside(plain);
    if (seen.empty() || !is_periodic(seen.front().form.effect)) return;
    seen.front().evidence = diagnosis_.least_evidence;  // that of whitened rows is another one
    prefer(std::move(seen.front()), ranked.front().evidence, ranked);
  }

  /// The model without each of its effects. Beside that one the others' laws may have needed no bend.
  std::vector<AxisFit> leave_one_out() const {
    std::vector<AxisFit> all_without(diagnosis_.found.size(), fit_);
    if (all_without.empty()) return {};
    if (all_without.size() == 1) return {without_any()};
    in_parallel(all_without.size(), [&](std::size_t i) {
      auto& effects = all_without[i].change_model().effects;
      effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(i));
      all_without[i].settle(kDuelRounds);
      for (std::size_t k = 0; k < effects.size(); ++k)
        if (effects[k].form.parts == 1) weigh_bend(all_without[i], k);
    });
    if (before_newest_ && before_newest_->unlikeliness() < all_without.back().unlikeliness())
      all_without.back() = *before_newest_;
    return all_without;
  }

  /// The nominal model, which may settle better from here than from the datasheet.
  AxisFit without_any() const {
    const AxisFit::Rival nominal = diagnosis_.nominal.as_rival();
    AxisFit without = fit_;
    without.change_model().effects.clear();
    without.settle_roughly(kDuelRounds, nominal);
    without.finish(nominal);
    return without.unlikeliness() < diagnosis_.nominal.unlikeliness() ? without : diagnosis_.nominal;
  }

  /// How much each effect is worth beside the others.
  void weigh(const std::vector<AxisFit>& all_without) {
    for (std::size_t i = 0; i < all_without.size(); ++i) {
      const AxisFit& without = all_without[i];
      if (without.model().effects.empty()) diagnosis_.nominal = without;
      const double evidence = without.unlikeliness() - fit_.unlikeliness();
      const bool is_known = fit_.relative_error_of(diagnosis_.found[i].effect.form.effect) < kUnknownSize;
      diagnosis_.found[i].evidence = std::isfinite(evidence) && is_known ? evidence : 0.0;
    }
  }

  /// Evidence that a finding needs beside the others.
  double enough_for(const Finding& finding) const {
    double enough = diagnosis_.least_evidence;
    const gap::Effect effect = finding.effect.form.effect;
    for (const Finding& other : diagnosis_.found) {
      const gap::Effect beside = other.effect.form.effect;
      enough = std::max(enough, least_share(effect, beside, kLeastShare) * other.evidence);
    }
    for (const gap::AppliedEffect& known : fit_.model().known) {
      const double share = least_share(effect, known.form.effect, kLeastShareOfKnown);
      enough = std::max(enough, share * diagnosis_.known_evidence);
    }
    return diagnosis_.needed(finding, enough);
  }

  /// What an heir was promised among its rivals, or was worth beside the one that it has replaced, is not
  /// what it is worth now.
  void rank_heirs() {
    for (Finding& finding : diagnosis_.found) {
      if (!finding.has_inherited) continue;
      double& own = finding.rivals.front().evidence;
      own = std::max(own, finding.evidence - freedom_cost(fit_, finding.effect));
    }
  }

  /// Takes out what is not worth enough; was there any?
  bool prune() {
    bool has_changed = false;
    for (;; has_changed = true) {
      std::vector<AxisFit> all_without = leave_one_out();
      weigh(all_without);
      if (diagnosis_.found.empty()) return has_changed;
      const auto lack = [this](const Finding& f) { return enough_for(f) - f.evidence; };
      const auto weakest =
          std::max_element(diagnosis_.found.begin(), diagnosis_.found.end(),
                           [&](const Finding& a, const Finding& b) { return lack(a) < lack(b); });
      if (!(lack(*weakest) > 0.0)) break;
      fit_ = std::move(all_without[static_cast<std::size_t>(weakest - diagnosis_.found.begin())]);
      before_newest_.reset();
      const Finding dropped = std::move(*weakest);
      diagnosis_.found.erase(weakest);
      for (Finding& left : diagnosis_.found) inherit_rivals(dropped, left);
      if (diagnosis_.found.empty())
        fit_ = diagnosis_.nominal;
      else
        fit_.settle();
      diagnosis_.take_sizes();
    }
    rank_heirs();
    std::stable_sort(diagnosis_.found.begin(), diagnosis_.found.end(),
                     [](const Finding& a, const Finding& b) { return a.evidence > b.evidence; });
    auto& effects = fit_.change_model().effects;
    for (std::size_t i = 0; i < effects.size(); ++i) effects[i] = diagnosis_.found[i].effect;
    fit_.refit_with_this_noise();
    diagnosis_.take_sizes();
    return has_changed;
  }

  AxisDiagnosis& diagnosis_;
  AxisFit& fit_;
  const double to_beat_;
  const std::vector<gap::Effect> excluded_;
  std::vector<gap::Effect> left_out_;
  std::optional<AxisFit> before_newest_;  ///< without the effect that was found last
  bool is_astray_ = false;                ///< the model as it is, as a beginning for others
  const std::function<void(double)>& on_progress_;
};

}  // namespace

void inherit_rivals(const Finding& dropped, Finding& left) {
  const gap::Effect effect = left.effect.form.effect;
  const Family family = family_of(effect);
  if (family == Family::kNone || family != family_of(dropped.effect.form.effect)) return;
  std::vector<Candidate> rivals = dropped.rivals;
  std::sort(rivals.begin(), rivals.end(), by_evidence);
  const auto own = std::find_if(rivals.begin(), rivals.end(),
                                [effect](const Candidate& c) { return c.form.effect == effect; });
  if (own == rivals.end()) return;
  std::rotate(rivals.begin(), own, own + 1);
  left.rivals = std::move(rivals);
  left.has_inherited = true;
}

double AxisDiagnosis::needed(const Finding& finding, double usual) const {
  const bool is_contained =
      std::any_of(found.begin(), found.end(), [](const Finding& f) { return contains_force(f.effect.form); });
  for (const Plainer& pair : kPlainer) {
    if (pair.plain != finding.effect.form.effect) continue;
    for (const Finding& other : found)
      if (other.effect.form.effect == pair.fine)
        return pair.stays && !is_contained ? kAlways
                                           : std::min(usual, std::max(kRarely, kLeastShare * other.evidence));
  }
  return usual;
}

double AxisDiagnosis::named_deviance() const {
  if (found.empty()) return 0.0;
  return std::max(nominal.unlikeliness() - fit.unlikeliness(), 0.0);
}

void AxisDiagnosis::take_sizes() {
  for (std::size_t i = 0; i < found.size(); ++i) found[i].effect = fit.model().effects[i];
}

AxisDiagnosis search_effects(const AxisFit& start, const AxisFit& nominal,
                             std::span<const gap::Effect> excluded, double least_evidence, double to_beat,
                             const std::function<void(double)>& on_progress) {
  AxisDiagnosis diagnosis{.fit = start, .nominal = nominal, .least_evidence = least_evidence};
  DiagnosisSearch(diagnosis, excluded, to_beat, on_progress).run();
  return diagnosis;
}

}  // namespace morepro::host
