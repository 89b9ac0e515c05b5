#include "sim_host/diagnose/board/board_settings.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/gap/board_forms.hpp"
#include "lib/gap/effect_size.hpp"
#include "lib/monitor/configuration_check.hpp"
#include "lib/monitor/sample_limits.hpp"
#include "sim_host/diagnose/outcome/causes.hpp"
#include "sim_host/machine/monitor_effects.hpp"

namespace morepro::host {
namespace {

using gap::Effect;
using gap::EffectForm;
using gap::MachineForms;

constexpr std::size_t kMostNameless = 2;
// A board uses a row of either sensor in turn, which is half of what a host sees, and what lasts in them is
// harder to use for a name.
constexpr double kShareOfNoise = 0.25;

bool has_name(const EffectForm& form) { return gap::index_of(form.effect) < gap::kEffectCount; }

/// Without its bend where only that has no room.
void add(EffectForm form, MachineForms& forms) {
  if (!forms.has_room(form) && gap::may_be_refined(form.effect)) form.parts = 1;
  if (forms.has_room(form)) forms.form[forms.count++] = form;
}

/// Residual power of the model with its effects, as the board counts outliers, over that of expected noise:
/// what has a short memory, or grows with the speed, is noise too.
double noise_ratio(const AxisFit& fit) {
  constexpr double kHuber = 5.0;
  double sum = 0.0;
  double count = 0.0;
  for (const std::vector<float>& normalised : fit.innovations().normalised) {
    for (const float value : normalised) {
      const auto size = static_cast<double>(std::fabs(value));
      sum += size < kHuber ? size * size : kHuber * size;
    }
    count += static_cast<double>(normalised.size());
  }
  return count > 0.0 ? std::max(1.0, sum / count) : 1.0;
}

void take(const AxisOutcome& outcome, bool is_unexplained, double rate_hz, gap::GapLimits& limits) {
  limits.evidence =
      std::max({limits.evidence, outcome.chance.quantile99, kShareOfNoise * outcome.noise_evidence});
  limits.temperature = std::max(1.0, outcome.chance.temperature);
  const auto& functions = outcome.leftover.functions;
  for (std::size_t i = 0; is_unexplained && i < std::min(kMostNameless, functions.size()); ++i)
    add(functions[i], limits.forms);
  if (!is_unexplained) limits.noise_ratio = noise_ratio(outcome.diagnosis.fit);
  for (const Finding& finding : outcome.diagnosis.found)
    if (check_effect({.form = finding.effect.form}, rate_hz).ok()) add(finding.effect.form, limits.forms);
}

/// Is nothing of the axis wrong but values?
bool is_quiet(Axis axis, std::span<const AxisOutcome> outcomes, Verdict verdict) {
  const auto has_effect = [axis](const AxisOutcome& outcome) {
    return outcome.diagnosis.fit.axis() == axis && !outcome.diagnosis.found.empty();
  };
  return verdict != Verdict::kUnexplained && std::none_of(outcomes.begin(), outcomes.end(), has_effect);
}

/// When the first cause sets in; 0: it is there from the start, as what has no name.
double first_onset_s(std::span<const AxisOutcome> outcomes, const DiagnosisResult& result) {
  if (result.verdict != Verdict::kEffect) return 0.0;
  double first = result.duration_s;
  for (const AxisOutcome& outcome : outcomes) {
    const std::vector<Finding>& found = outcome.diagnosis.found;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!shaped_by(found, i)) first = std::min(first, found[i].effect.onset_s);
  }
  return first < result.duration_s ? first : 0.0;
}

std::vector<gap::Effect> causes_in(const DiagnosisResult& result) {
  std::vector<gap::Effect> causes;
  for (const EffectResult& found : result.which)
    causes.insert(causes.end(), found.alias_set.begin(), found.alias_set.end());
  return causes;
}

}  // namespace

BoardSight sight_of(std::span<const AxisOutcome> outcomes, const DiagnosisResult& result,
                    const gap::GapNoise<double>& expected) {
  return {.verdict = result.verdict,
          .causes = causes_in(result),
          .expected_noise = expected,
          .since_s = first_onset_s(outcomes, result),
          .is_excited = result.verdict != Verdict::kInsufficientExcitation,
          .is_spindle_quiet = is_quiet(Axis::kSpindle, outcomes, result.verdict),
          .is_feed_quiet = is_quiet(Axis::kFeed, outcomes, result.verdict)};
}

gap::GapSettings board_settings(std::span<const AxisOutcome> outcomes, const gap::GapNoise<double>& sensors,
                                bool is_unexplained, std::span<const gap::Effect> excluded, double rate_hz) {
  gap::GapSettings settings{.noise = sensors, .spindle = {}, .feed = {}};
  for (const gap::Effect effect : excluded)
    add({.effect = effect, .kind = 0, .parts = 0, .shape = 0.0F},
        gap::is_of_feed(effect) ? settings.feed.forms : settings.spindle.forms);
  for (const AxisOutcome& outcome : outcomes) {
    const gap::GapNoise<double>& noise = outcome.diagnosis.fit.model().noise;
    if (outcome.diagnosis.fit.axis() == Axis::kSpindle) {
      take(outcome, is_unexplained, rate_hz, settings.spindle);
      settings.noise.speed_step = noise.speed_step;
      settings.noise.current_step = noise.current_step;
    } else {
      take(outcome, is_unexplained, rate_hz, settings.feed);
      settings.noise.feed_step = noise.feed_step;
    }
  }
  return settings;
}

gap::SampleLimits samples_for_board(MachineDescription machine, const RecordingSignals& signals,
                                    std::span<const SamplingFault> faults, std::span<const Effect> excluded) {
  const auto is_excluded = [excluded](Effect effect) {
    return std::find(excluded.begin(), excluded.end(), effect) != excluded.end();
  };
  const auto is_coarse = [](const gap::AppliedEffect& one) {
    return one.form.effect == Effect::kSensorQuantization;
  };
  const Sensors expected = with_known_steps(machine.configuration.sensors, machine.effects);
  std::vector<std::string> notices;
  know_effects(machine, notices);
  machine.configuration.sensors = with_own_steps(expected, signals, faults);
  gap::SampleLimits limits = sample_limits_of(machine.configuration);
  const auto& known = machine.effects;
  if (is_excluded(Effect::kSensorQuantization) || std::any_of(known.begin(), known.end(), is_coarse))
    limits = {.lost_share = limits.lost_share, .clock_jitter_s = limits.clock_jitter_s};
  if (is_excluded(Effect::kSampleDropout)) limits.lost_share = 0.0F;
  return limits;
}

GapTuning tuning_for_board(const gap::GapSettings& settings, const GapTuning& stated, double rate_ratio) {
  const double share = std::sqrt(rate_ratio);
  return {
      .speed_process_noise_rad_s = share * settings.noise.speed_step,
      .current_process_noise_a = share * settings.noise.current_step,
      .feed_process_noise_m_s = share * settings.noise.feed_step,
      .lost_share = settings.samples.lost_share > 0.0F ? stated.lost_share : 0.0,
      .clock_jitter_s = std::max(stated.clock_jitter_s, static_cast<double>(settings.samples.clock_jitter_s)),
      .spindle = settings.spindle,
      .feed = settings.feed};
}

MachineForms stated_forms(const MachineForms& forms, const gap::EffectScales<double>& from,
                          const gap::EffectScales<double>& to) {
  MachineForms stated;
  for (std::size_t i = 0; i < forms.count; ++i) {
    const EffectForm& form = forms.form[i];
    if (has_name(form) && gap::group_of(form.effect) != gap::EffectGroup::kSampling)
      stated.form[stated.count++] = restated({.form = form}, from, to).form;
  }
  return stated;
}

}  // namespace morepro::host
