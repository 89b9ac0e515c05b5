#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "lib/gap/board_forms.hpp"
#include "lib/gap/explained_columns.hpp"
#include "lib/gap/gap_watch_finding.hpp"
#include "lib/gap/square_root_statistics.hpp"

namespace morepro::gap {

/// From the statistics of one axis to a finding, in steps of bounded time: prior of the parameters, every
/// form, every alias.
template <class Real, std::size_t kParameters, std::size_t kForms, std::size_t kColumns>
class GapWatchEvaluation {
 public:
  using Statistics = SquareRootStatistics<Real, kColumns>;

  /// `value`: of each parameter in the unit of its column, without its sign; 0: not a parameter of this
  /// machine.
  GapWatchEvaluation(const std::array<Real, kParameters>& value, const GapLimits& limits)
      : threshold_(static_cast<Real>(limits.evidence)),
        temperature_(static_cast<Real>(limits.temperature)),
        least_excitation_(static_cast<Real>(limits.excitation)),
        noise_ratio_(static_cast<Real>(limits.noise_ratio)),
        second_order_(static_cast<Real>(second_order_of(limits.parameter_spread))) {
    for (std::size_t j = 0; j < kParameters; ++j)
      expect(j, value[j], static_cast<Real>(limits.parameter_spread) * value[j]);
  }

  /// The next form in the order of the columns; at most kForms. From the first one on that `is_told`, all
  /// are: a host has seen this machine, or another one like it, to have them.
  void add(const EffectForm& form, bool is_told) {
    if (is_told) told_from_ = std::min(told_from_, form_count_);
    forms_[form_count_++] = form;
  }

  void begin() {
    prior_ = {};
    draft_ = {};
    explained_.clear();
    explaining_ = explained_step_ = 0;
    nameless_ = told_gain_ = 0;
    found_ = 0;
    copied_ = 0;
    next_ = 0;
    begin_ranking();
  }

  /// One step; true where the finding is complete. The statistics must not change between begin() and then.
  bool advance(const Statistics& statistics) {
    if (copied_ < Statistics::kWidth) return copy(statistics);
    if (!prior_.is_done()) return turn_prior();
    if (next_ == 0) excitation_ = least_excitation();
    if (next_ < kParameters) {
      expect_parameter(next_++);
      return false;
    }
    if (explaining_ > 0) return explain();
    if (ranked_ < form_count_) return rank(ranked_++);
    if (found_ == 0 && compared_ < form_count_) return judge_alias(compared_++);
    if (explains_more()) return false;
    conclude();
    return true;
  }

  [[nodiscard]] const GapFinding& finding() const { return finding_; }
  /// How many times better than from the datasheet the least known parameter is known.
  [[nodiscard]] Real excitation() const { return excitation_; }
  /// Residual power of the model with what was found, over that of the expected noise.
  [[nodiscard]] Real residual_ratio() const { return rest_ / std::max(rows(), Real(1)); }
  /// How far the finding is beyond what chance makes.
  [[nodiscard]] Real surplus() const { return static_cast<Real>(finding_.evidence) - threshold_; }

 private:
  static constexpr std::size_t kFewestRows = 300;
  static constexpr Real kAliasCorrelation = Real(0.98);
  // Parameters that are off by p leave a share of p^2 that their columns, which are linear, do not explain:
  // of this much, or of three standard deviations where they are known better.
  static constexpr double kSecondOrder = 0.005;
  static constexpr double kMostDeviations = 3.0;
  // Residual per row; from 300 rows of the noise that is expected it is 1 +- 0.08.
  static constexpr Real kMostResidual = Real(1.3);
  static constexpr Real kAllExplained = Real(1.15);
  // Of what is beyond noise: shapes that are not quite the machine's leave something.
  static constexpr Real kMostLeft = Real(0.5);
  // A large effect is far from linear; that it is there, the host knows better. Of what is beyond noise, its
  // column took 0.26 and more; its bend passes for others, which gained up to a fifth of what it did.
  static constexpr Real kLeastByTold = Real(0.25);
  static constexpr Real kMostBesideTold = Real(0.5);  // of what is told
  // Several together explain much of anything: random loads of some duration, for example.
  static constexpr Real kMostLeftBySeveral = Real(0.2);
  static constexpr Real kMostNameless = Real(0.2);
  static constexpr std::size_t kMostFound = 4;
  static constexpr Real kLogOf20 = Real(2.9957323);

  [[nodiscard]] Real rows() const { return static_cast<Real>(statistics_.rows()); }

  /// Residual sum of squares of a machine without a gap.
  [[nodiscard]] Real noise() const { return noise_ratio_ * rows(); }

  [[nodiscard]] Real evidence(Real before, Real after, Real freedom) const {
    return rows() * math::log(before / std::max(after, Real(1.0e-6) * before)) - freedom * math::log(rows());
  }

  static double second_order_of(double spread) {
    const double most = kMostDeviations * spread;
    return std::min(kSecondOrder, most * most);
  }

  [[gnu::noinline, gnu::cold]] void expect(std::size_t j, Real value, Real spread) {
    constexpr auto kLeast = Real(1.0e-12);  // its inverse has a square in a float
    datasheet_spread_[j] = static_cast<Real>(kDatasheetSpread) * value;
    precision_[j] = spread > Real(0) ? Real(1) / std::max(spread, kLeast) : Real(0);
  }

  // A column that has never moved cannot be mistaken for anything.
  [[nodiscard]] Real least_excitation() const {
    Real least = Real(1.0e30);
    for (std::size_t j = 0; j < kParameters; ++j)
      if (statistics_.left(j, j, 0) > Real(0))
        least = std::min(least, datasheet_spread_[j] * statistics_.factor(j, j));
    return least;
  }

  void expect_parameter(std::size_t j) {
    if (precision_[j] > Real(0)) prior_ = Statistics::expectation(j, precision_[j]);
  }

  /// One row of them: a board without a fast memcpy takes long for all.
  bool copy(const Statistics& statistics) {
    statistics_.copy_row(copied_++, statistics);
    return false;
  }

  /// One column of it: a whole row takes longer than any other step.
  bool turn_prior() {
    statistics_.advance(prior_);
    return false;
  }

  void begin_ranking() {
    ranked_ = 0;
    compared_ = 0;
    column_ = kParameters;
    best_ = kForms;
  }

  bool rank(std::size_t i) {
    if (i == 0) rest_ = explained_.left(statistics_, Statistics::kY, Statistics::kY);
    if (i == 0 && found_ == 0) {
      whole_ = statistics_.residual(0);
      refitted_ = rest_;
    }
    const EffectForm& form = forms_[i];
    const GroupGain<Real> group = explained_.gain_of(statistics_, column_, form.parts);
    const bool is_possible = !acts_one_way(form.effect) || group.coefficient > Real(0);
    first_[i] = column_;
    column_ += form.parts;
    gain_[i] = group.gain;
    evidence_[i] = is_possible ? evidence(rest_, rest_ - group.gain, Real(form.parts)) : Real(-1.0e30);
    if (best_ == kForms || evidence_[i] > evidence_[best_]) best_ = i;
    return false;
  }

  /// The best form counts as known where it is an effect; true where others have to be ranked anew then.
  bool explains_more() {
    if (found_ == 0) take_first();
    if (!is_effect()) return false;
    const EffectForm& form = forms_[best_];
    rest_ -= gain_[best_];
    if (!has_name(form.effect)) nameless_ += gain_[best_];
    if (best_ >= told_from_) told_gain_ += gain_[best_];
    ++found_;
    if (found_ == kMostFound || is_explained() || !explained_.has_room(form.parts)) return false;
    explaining_ = form.parts;
    return true;
  }

  bool explain() {
    if (!explained_.explain(statistics_, first_[best_] + explaining_ - 1, explained_step_++)) return false;
    explained_step_ = 0;
    if (--explaining_ == 0) begin_ranking();
    return false;
  }

  void take_first() {
    is_told_ = best_ >= told_from_;
    draft_.effect = forms_[best_].effect;
    draft_.where = group_of(draft_.effect);
    draft_.evidence = static_cast<float>(evidence_[best_]);
    draft_.confidence = static_cast<float>(confidence(evidence_[best_]));
  }

  bool judge_alias(std::size_t i) {
    const Effect effect = forms_[i].effect;
    if (draft_.alias_count == kMostAliases || is_listed(effect) || !has_name(effect)) return false;
    const Real lead = evidence_[best_] - evidence_[i];
    const Real close = Real(2) * temperature_ * kLogOf20;
    if (lead <= close || resembles_best(i)) draft_.alias[draft_.alias_count++] = effect;
    return false;
  }

  [[nodiscard]] bool is_listed(Effect effect) const {
    const auto end = draft_.alias.begin() + draft_.alias_count;
    return effect == forms_[best_].effect || std::find(draft_.alias.begin(), end, effect) != end;
  }

  [[nodiscard]] bool resembles_best(std::size_t i) const {
    if (forms_[i].parts > 1 || forms_[best_].parts > 1 || !(evidence_[i] > Real(0))) return false;
    return math::abs(statistics_.correlation(first_[i], first_[best_], kParameters)) > kAliasCorrelation;
  }

  void conclude() {
    draft_.verdict = verdict();
    if (draft_.verdict == GapVerdict::kParameterError)
      draft_.evidence = static_cast<float>(parameter_evidence());
    if (draft_.verdict != GapVerdict::kEffect) draft_.alias_count = 0;
    finding_ = draft_;
  }

  [[nodiscard]] GapVerdict verdict() const {
    if (statistics_.rows() < kFewestRows) return GapVerdict::kNotEnoughData;
    if (!(excitation_ > least_excitation_)) return GapVerdict::kInsufficientExcitation;
    if (found_ > 0) {
      const bool is_believed = is_explained() || is_as_told();
      return is_believed && has_name(draft_.effect) ? GapVerdict::kEffect : GapVerdict::kUnexplained;
    }
    if (parameter_evidence() > threshold_) return GapVerdict::kParameterError;
    return rest_ > kMostResidual * noise() ? GapVerdict::kUnexplained : GapVerdict::kNoGap;
  }

  [[nodiscard]] Real parameter_evidence() const { return evidence(whole_, refitted_, Real(kParameters)); }

  static constexpr bool has_name(Effect effect) { return effect < Effect::kUnnamedTorque; }

  [[nodiscard]] Real excess() const { return std::max(refitted_ - noise(), Real(0)); }

  [[nodiscard]] bool is_named() const { return nameless_ == Real(0) || nameless_ < kMostNameless * excess(); }

  [[nodiscard]] bool is_explained() const {
    const Real most_left = found_ > 1 ? kMostLeftBySeveral : kMostLeft;
    return is_named() && (rest_ < kAllExplained * noise() || rest_ - noise() < most_left * excess());
  }

  /// Is what was found first an effect that a host has told of, and all that is untold less than half as
  /// large?
  [[nodiscard]] bool is_as_told() const {
    const Real others = refitted_ - rest_ - told_gain_;
    return is_told_ && is_named() && told_gain_ > kLeastByTold * excess() &&
           others < kMostBesideTold * told_gain_;
  }

  [[nodiscard]] bool is_effect() const {
    return evidence_[best_] > threshold_ && gain_[best_] > second_order_ * (whole_ - refitted_);
  }

  [[nodiscard]] Real confidence(Real best) const {
    const Real lead = (best - threshold_) / (Real(2) * temperature_);
    return Real(1) / (Real(1) + math::exp(std::clamp(-lead, Real(-40), Real(40))));
  }

  std::array<EffectForm, kForms> forms_{};
  std::size_t form_count_ = 0;
  std::size_t told_from_ = kForms;                    ///< number of the first form that a host has told
  bool is_told_ = false;                              ///< the effect that was found first
  std::array<Real, kParameters> datasheet_spread_{};  ///< of the parameters, in the unit of their columns
  std::array<Real, kParameters> precision_{};  ///< inverse of how far they may be off; 0: not a parameter
  Real threshold_;
  Real temperature_;
  Real least_excitation_;
  Real noise_ratio_;
  Real second_order_;  ///< share of what parameters explain that an effect has to gain
  Statistics statistics_{};
  typename Statistics::Insertion prior_{};
  GapFinding finding_{};
  GapFinding draft_{};
  std::size_t copied_ = 0;  ///< rows of the statistics
  std::array<Real, kForms> evidence_{};
  std::array<Real, kForms> gain_{};
  std::array<std::size_t, kForms> first_{};
  Real excitation_ = 0;
  Real whole_ = 0;
  Real refitted_ = 0;  ///< residual sum of squares with the parameters
  Real rest_ = 0;      ///< and with the effects that were found
  ExplainedColumns<Real, kColumns> explained_{kParameters};
  Real nameless_ = 0;               ///< what functions without a name explain of it
  Real told_gain_ = 0;              ///< what effects that a host has told of explain of it
  std::size_t found_ = 0;           ///< effects
  std::size_t explaining_ = 0;      ///< parts of the best form that are still to be explained
  std::size_t explained_step_ = 0;  ///< of that part
  std::size_t next_ = 0;
  std::size_t ranked_ = 0;    ///< forms
  std::size_t compared_ = 0;  ///< forms
  std::size_t column_ = 0;
  std::size_t best_ = kForms;
};

}  // namespace morepro::gap
