#include "sim_host/diagnose/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/diagnose/balances/model_comparison.hpp"
#include "sim_host/diagnose/balances/share_closed.hpp"
#include "sim_host/diagnose/balances/where.hpp"
#include "sim_host/diagnose/board/board_settings.hpp"
#include "sim_host/diagnose/board/board_watch.hpp"
#include "sim_host/diagnose/board/fitted_machine.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/fit/shown_by_innovations.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/outcome/causes.hpp"
#include "sim_host/diagnose/outcome/detection_limits.hpp"
#include "sim_host/diagnose/outcome/effect_naming.hpp"
#include "sim_host/diagnose/outcome/shaking_clock.hpp"
#include "sim_host/diagnose/outcome/shape_doubt.hpp"
#include "sim_host/diagnose/outcome/unnamed_where.hpp"
#include "sim_host/diagnose/outcome/verdict.hpp"
#include "sim_host/diagnose/result/unevaluated.hpp"
#include "sim_host/diagnose/search/clock_jitter.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "sim_host/diagnose/search/winding_heat.hpp"
#include "sim_host/diagnose/signals/current_drive.hpp"
#include "sim_host/diagnose/signals/reference_scales.hpp"
#include "sim_host/diagnose/signals/sampling_checks.hpp"
#include "sim_host/diagnose/signals/shown_noise.hpp"
#include "sim_host/diagnose/signals/slow_motion.hpp"
#include "sim_host/diagnose/signals/sound_samples.hpp"
#include "sim_host/machine/setting_key.hpp"
#include "sim_host/simulate/operating_point.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

constexpr double kVisible = 1.03;  // residual ratio of a balance that a faulty sensor disturbs

class Diagnosis {
 public:
  /// `signals`: of what was `recorded`, all or thinned.
  Diagnosis(RecordingSignals signals, const RecordingSignals& recorded, const MachineDescription& machine,
            const DiagnosisOptions& options)
      : signals_(std::move(signals)), machine_(machine), options_(options) {
    result_.rows = recorded.rows - recorded.missing_rows;
    result_.rate_hz = recorded.rate_hz;
    result_.duration_s = recorded.duration_s();
    result_.missing_rows = recorded.missing_rows;
  }

  void run() {
    Sensors sensors = with_known_steps(machine_.configuration.sensors, machine_.effects);
    for (const Channel channel : leave_out_dead_sensors(signals_, sensors))
      result_.notices.push_back(fmt::format("{} never changes although its sensor has noise; it is left out",
                                            kChannels[index_of(channel)].column));
    if (machine_.has_spindle) drive_by_current(signals_);
    for (std::string& lack : untested_effects(signals_, machine_)) result_.notices.push_back(std::move(lack));
    faults_ = make_sound(signals_, sensors, machine_.assumed_noise, result_.notices);
    for (const ShownNoise& shown : instead_of_assumed(signals_, machine_.assumed_noise, sensors))
      take(shown, sentence_of_assumed(shown), sensors);
    datasheet_ = {.machine = machine_.configuration.machine,
                  .point = reference_point_for(machine_, signals_),
                  .noise = usual_noise(sensors)};
    if (signals_.rows >= kFewestRows) heat_winding_by_current(signals_, datasheet_);
    for (const auto& effect : machine_.effects)
      datasheet_.known.push_back(gap::restated(effect, file_scales(), recording_scales()));
    try_axes();
    look_for_jitter();
    heed_shown_noise(sensors);
    std::erase_if(faults_,
                  [this](const auto& f) { return std::ranges::count(options_.excluded, f.effect) > 0; });
    forget_what_clock_leaves(faults_, outcomes_);
    leave_out_known(machine_.effects, faults_);
    result_.bootstrap_runs = options_.bootstrap_runs;
    judge(outcomes_, faults_, signals_.rows, result_);
    rank();
    measure();
    reconsider();
    doubt_shapes(outcomes_, result_);
    result_.not_found = detection_limits(outcomes_, result_, options_.excluded, both_scales());
    result_.explanation = explanation();
    watch_like_a_board();
  }

  [[nodiscard]] bool is_unexplained() const { return result_.verdict == Verdict::kUnexplained; }
  [[nodiscard]] bool names_effects() const { return result_.verdict == Verdict::kEffect; }
  /// Structure that means over 5 ms need not show.
  [[nodiscard]] bool has_hidden_structure() const {
    return !lost_.empty() || any_runs_away() || std::ranges::any_of(outcomes_, passed_for_noise);
  }
  /// Is it another machine from some time on? What shakes one does not hide that.
  [[nodiscard]] bool has_changed() const { return std::ranges::any_of(outcomes_, host::has_changed); }

  /// With the noise that its sensors show.
  [[nodiscard]] const MachineDescription& machine() const { return machine_; }
  /// What was left of the recording after dead sensors were, and what there is to say about it.
  [[nodiscard]] const RecordingSignals& signals() const { return signals_; }
  [[nodiscard]] const std::vector<std::string>& notices() const { return result_.notices; }

  DiagnosisResult take_result(MachineDescription& with_effects) {
    for (const AxisOutcome& outcome : outcomes_) options_.on_axis(outcome.diagnosis);
    with_effects = machine_with_effects(machine_, signals_, outcomes_, faults_, both_scales());
    with_effects.configuration.gap = result_.for_board;
    for (const SettingKey& key : setting_keys())
      if (key.table == "gap") with_effects.stated.insert(full_name(key));
    return std::move(result_);
  }

 private:
  // Sizes and widths are stated at the machine's reference point, which the file alone knows; where it knows
  // none, the recording's own is better to search with.
  gap::EffectScales<double> file_scales() const {
    const MachineParameters& machine = machine_.configuration.machine;
    return {machine, reference_point_of(machine)};
  }
  gap::EffectScales<double> recording_scales() const {
    return {machine_.configuration.machine, datasheet_.point};
  }
  ScalesOfEffects both_scales() const { return {recording_scales(), file_scales()}; }

  /// Both axes report at once; what is told is how far the slower one is.
  DiagnosisOptions reporting_for(std::size_t axis) {
    DiagnosisOptions options = options_;
    options.on_progress = [this, axis](double share) {
      const std::lock_guard lock(one_at_a_time_);
      share_done_[axis] = share;
      options_.on_progress(std::min(share_done_[0], share_done_[1]));
    };
    return options;
  }

  void try_axes() {
    if (signals_.rows < kFewestRows) return;
    outcomes_.clear();
    constexpr std::array kAxes{Axis::kSpindle, Axis::kFeed};
    std::array<std::optional<AxisOutcome>, kAxes.size()> outcomes;
    for (std::size_t i = 0; i < kAxes.size(); ++i)
      share_done_[i] = is_evaluable(kAxes[i], signals_, machine_) ? 0.0 : 1.0;
    in_parallel(kAxes.size(), [&](std::size_t i) {
      if (!is_evaluable(kAxes[i], signals_, machine_)) return;
      const DiagnosisOptions options = reporting_for(i);
      outcomes[i] = outcome_of(kAxes[i], signals_, datasheet_, options);
      options.on_progress(1.0);
    });
    for (auto& outcome : outcomes)
      if (outcome) outcomes_.push_back(std::move(*outcome));
    conclude(outcomes_);
  }

  void take(const ShownNoise& shown, std::string sentence, Sensors& sensors) {
    sensors[shown.channel].noise = machine_.configuration.sensors[shown.channel].noise = shown.noise;
    result_.notices.push_back(std::move(sentence));
  }

  /// Once more with the noise that the sensors show, where they show more than is stated, unless that is a
  /// clock's.
  void heed_shown_noise(Sensors& sensors) {
    const auto shakes = [](const SamplingFault& fault) { return fault.effect == Effect::kClockJitter; };
    const bool may_shake = std::ranges::count(options_.excluded, Effect::kClockJitter) == 0;
    const std::vector<ShownNoise> noisier = noisier_sensors(signals_, sensors, fits());
    if (noisier.empty() || (may_shake && std::ranges::any_of(faults_, shakes))) return;
    std::erase_if(faults_, shakes);
    for (const ShownNoise& shown : noisier) take(shown, sentence_of(shown), sensors);
    datasheet_.noise = usual_noise(sensors);
    try_axes();
    look_for_jitter();
  }

  std::vector<const AxisFit*> fits() const {
    std::vector<const AxisFit*> fits;
    for (const AxisOutcome& outcome : outcomes_) fits.push_back(&outcome.diagnosis.fit);
    return fits;
  }

  void look_for_jitter() {
    const auto [jitter, of_law, fit, sensor] = find_shaking(fits());
    if (jitter && is_worth_its_name(*jitter, outcomes_)) faults_.push_back(*jitter);
    if (of_law > 0.0) outcomes_[fit].keep_without_name(of_law, sensor == 0 ? 1.0 : 0.0);
  }

  [[nodiscard]] bool any_runs_away() const {
    return std::ranges::any_of(outcomes_, [](const AxisOutcome& o) { return o.diagnosis.runs_away(); });
  }

  std::string explanation() const {
    if (any_runs_away()) return std::string(kMeaningOfRunaway);
    if (!lost_.empty()) return meaning_of_lost(lost_);
    if (result_.verdict == Verdict::kEffect) return meaning_of_effects(result_);
    if (const auto meaning = meaning_of(result_.verdict); !meaning.empty())
      return std::string(meaning) + (is_unexplained() && !result_.has_place()
                                         ? "; no balance that is evaluated shows it alone"
                                         : "");
    return why_undetermined(signals_, !outcomes_.empty());
  }

  [[nodiscard]] bool has_found() const {
    return std::ranges::any_of(outcomes_, [](const AxisOutcome& o) { return !o.diagnosis.found.empty(); });
  }

  // By a fault of another sensor, or in another kind of its law.
  [[nodiscard]] bool is_named(Effect effect) const {
    return std::ranges::count(result_.which, effect, &EffectResult::effect) > 0;
  }

  /// Rows, and pieces that were not fitted to, have the last word on whether names explain the gap.
  void reconsider() {
    const bool has_play = std::ranges::any_of(result_.which, keeps_its_side, &EffectResult::effect);
    const bool has_say = result_.verdict != Verdict::kInsufficientExcitation && faults_.empty() && !has_play;
    const bool is_open = !is_unexplained() || std::ranges::any_of(outcomes_, wanders);
    if (has_say && result_.which.empty() && is_open) mark_lost();
    if (!lost_.empty() || any_runs_away()) return;
    const bool is_kept = has_say && keeps_a_gap(result_.shrinkage, result_.where);
    const bool is_closed = is_unexplained() && !is_kept && is_nearly_closed(result_.shrinkage);
    const bool is_left = has_say && !is_unexplained() &&
                         (is_kept || (names_effects() && is_hardly_closed(result_.shrinkage, result_.where)));
    // A clock that shakes, or coarse steps, are in every balance, so that these do not say how much is left.
    const bool is_vain =
        names_effects() && has_found() && !faults_.empty() && !has_play && closes_nothing(result_.shrinkage);
    is_judged_by_share_ = is_closed || is_left || is_vain;
    if (!is_judged_by_share_) return;
    result_.verdict = is_closed ? Verdict::kEffect : Verdict::kUnexplained;
    if (!is_closed) result_.unexplained_share = 1.0 - result_.shrinkage.share_closed;
    rank();
  }

  /// What a model that runs free is lost in is a gap, although an observer takes it for random forces.
  void mark_lost() {
    for (BalanceResult& balance : result_.where) {
      const auto place = static_cast<std::size_t>(balance.balance);
      if (!balance.is_evaluated || !is_lost(result_.shrinkage.free_run_nrmse[place])) continue;
      balance.is_significant = true;
      lost_.push_back(gap::name_of(balance.balance));
    }
    if (lost_.empty()) return;
    result_.verdict = Verdict::kUnexplained;
    result_.unexplained_share = 1.0;
  }

  void rank() {
    result_.which.clear();
    if (result_.verdict == Verdict::kInsufficientExcitation) return;
    for (const SamplingFault& fault : faults_)
      if (!is_named(fault.effect)) result_.which.push_back(named_fault(fault));
    for (const AxisOutcome& outcome : outcomes_) rank(outcome);
    std::ranges::stable_sort(result_.which, std::greater{}, &EffectResult::evidence);
  }

  /// Each cause with what gives it its shape.
  void rank(const AxisOutcome& outcome) {
    const std::vector<Finding>& found = outcome.diagnosis.found;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (is_named(found[i].effect.form.effect) || shaped_by(found, i)) continue;
      EffectResult effect = effect_of(found[i], outcome);
      for (std::size_t k = 0; k < found.size(); ++k)
        if (shaped_by(found, k) == i) take_shape(effect_of(found[k], outcome), effect);
      result_.which.push_back(std::move(effect));
    }
  }

  EffectResult effect_of(const Finding& finding, const AxisOutcome& outcome) const {
    const AxisFit& fit = outcome.diagnosis.fit;
    const double all = excess_of(outcome.unnamed_deviance() + outcome.named_deviance(), signals_.rows);
    const double unnamed = is_judged_by_share_ ? std::max(1.0 - result_.shrinkage.share_closed,
                                                          share_kept_by(finding.effect.form.effect))
                           : all > 0.0         ? excess_of(outcome.unnamed_deviance(), signals_.rows) / all
                                               : 0.0;
    const double temperature = outcome.chance.temperature;
    EffectResult effect = named_effect(finding, fit, outcome.context_of(finding, unnamed));
    const gap::EffectScales<double> scales(fit.model().machine, datasheet_.point);
    effect.magnitude = gap::size_of(gap::restated(finding.effect, recording_scales(), file_scales()), scales);
    effect.standard_error = std::fabs(effect.magnitude) * relative_size_error(finding, fit, temperature);
    if (has_no_size(effect.effect, signals_) || is_of_swinging_slide(finding.effect))
      effect.magnitude = effect.standard_error = std::nan("");
    return effect;
  }

  void measure() {
    std::array<std::vector<BalanceRows>, 2> rows;
    std::array<std::vector<BalanceResult>, 2> balances;
    result_.shrinkage.horizon_s = horizon_s(signals_);
    in_parallel(outcomes_.size(), [&](std::size_t i) {
      rows[i] = balance_rows(outcomes_[i].diagnosis);
      balances[i] = balances_of(outcomes_[i].diagnosis, rows[i]);
      show_unnamed(outcomes_[i], balances[i]);
      compare_models(outcomes_[i].diagnosis, options_.seed, result_.shrinkage);
    });
    std::vector<BalanceRows> gaps;
    std::vector<UnnamedPower> unnamed;
    for (std::size_t i = 0; i < outcomes_.size(); ++i) {
      const AxisOutcome& outcome = outcomes_[i];
      for (BalanceResult& balance : balances[i]) {
        const bool has_gap = balance.residual_ratio > kLeastGap * balance.residual_ratio_after;
        unnamed.push_back({outcome.unnamed_deviance_in(balance.balance),
                           has_gap ? kUnseen * outcome.chance.temperature : 0.0});
        mark(balance, outcome);
        result_.where.push_back(std::move(balance));
      }
      for (FollowedSignal& signal : followed_by_unnamed(outcome))
        result_.unexplained_follows.push_back(std::move(signal));
      gaps.insert(gaps.end(), rows[i].begin(), rows[i].end());
    }
    add_unevaluated(signals_, machine_, result_.where);
    if (!result_.which.empty()) share_closed(gaps, unnamed, options_.seed, result_.shrinkage);
  }

  /// The most that a balance keeps of its gap in which the effect acts; of a sensor's, any.
  [[nodiscard]] double share_kept_by(Effect effect) const {
    double most = 0.0;
    for (const BalanceResult& balance : result_.where)
      if (acts_in(signals_, balance, effect) || gap::is_in_sensor(effect))
        most = std::max(most, share_kept(balance));
    return most;
  }

  void mark(BalanceResult& balance, const AxisOutcome& outcome) const {
    if (!balance.is_evaluated) return;
    for (const SamplingFault& fault : faults_) {
      if (balance.balance != balance_shown_by(fault.channel)) continue;
      balance.is_significant = true;
      if (fault.onset_s > 0.0) balance.onset_s = fault.onset_s;
    }
    bool is_strongest = true;
    for (const Finding& finding : outcome.diagnosis.found) {
      const bool is_sensor = gap::is_in_sensor(finding.effect.form.effect);
      const bool is_here = acts_in(signals_, balance, finding.effect.form.effect);
      if (!is_here && !is_sensor) continue;
      balance.is_significant |= is_here || balance.residual_ratio > kVisible * balance.residual_ratio_after;
      const bool is_late_fault = is_sensor && finding.effect.onset_s > 0.0 && balance.is_significant;
      if ((is_here && is_strongest) || is_late_fault)
        balance.onset_s = onset_of(outcome.diagnosis, finding.effect);
      is_strongest &= !is_here;
    }
    balance.is_significant |=
        is_unexplained() && (shows_unnamed(outcome, balance) || share_kept(balance) > 0.0);
  }

  void watch_like_a_board() {
    gap::GapSettings settings =
        board_settings(outcomes_, datasheet_.noise, result_.verdict == Verdict::kUnexplained,
                       options_.excluded, signals_.rate_hz);
    settings.samples = samples_for_board(machine_, signals_, faults_, options_.excluded);
    result_.board =
        watch_on_board(signals_, machine_, fitted_values(machine_.configuration.machine, outcomes_),
                       sight_of(outcomes_, result_, datasheet_.noise), settings);
    result_.board_agrees = agree(result_.board, result_);
    result_.for_board =
        tuning_for_board(settings, machine_.configuration.gap, signals_.rate_hz / result_.rate_hz);
    for (gap::GapLimits* limits : {&result_.for_board.spindle, &result_.for_board.feed})
      limits->forms = stated_forms(limits->forms, recording_scales(), file_scales());
  }

  std::mutex one_at_a_time_;
  std::array<double, 2> share_done_{};  ///< of each axis's search
  RecordingSignals signals_;
  MachineDescription machine_;
  DiagnosisOptions options_;
  GapModel datasheet_;
  std::vector<SamplingFault> faults_;
  std::vector<AxisOutcome> outcomes_;
  std::vector<std::string_view> lost_;  ///< balances in which a model that runs free is
  bool is_judged_by_share_ = false;     ///< the gap, by names that leave some of the evidence
  DiagnosisResult result_;
};

}  // namespace

DiagnosisResult diagnose(const RecordingSignals& signals, const MachineDescription& machine,
                         const DiagnosisOptions& options, MachineDescription& with_effects) {
  Diagnosis diagnosis(signals, signals, machine, options);
  diagnosis.run();
  if (!diagnosis.is_unexplained() || diagnosis.has_changed()) return diagnosis.take_result(with_effects);
  // What shakes a real axis has no name and hides its friction, which is seen over longer times.
  auto slow = slow_motion_of(diagnosis.signals(), diagnosis.machine().configuration);
  if (!slow || slow->rows < kFewestRows) return diagnosis.take_result(with_effects);
  DiagnosisOptions quietly = options;
  quietly.on_progress = [](double) {};
  Diagnosis of_slow_motion(std::move(*slow), signals, diagnosis.machine(), quietly);
  of_slow_motion.run();
  // What rings, or passed for random forces, is not gone because it cannot be seen there.
  if (of_slow_motion.is_unexplained() ||
      (diagnosis.has_hidden_structure() && !of_slow_motion.names_effects()))
    return diagnosis.take_result(with_effects);
  DiagnosisResult result = of_slow_motion.take_result(with_effects);
  result.notices = diagnosis.notices();
  return result;
}

}  // namespace morepro::host
