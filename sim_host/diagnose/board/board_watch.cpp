#include "sim_host/diagnose/board/board_watch.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "lib/gap/gap_watch.hpp"
#include "lib/gap/reference_point.hpp"
#include "sim_host/diagnose/board/board_frames.hpp"
#include "sim_host/replay/gap_report.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

using gap::Effect;
using gap::GapVerdict;
using Watch = gap::GapWatch<float>;

GapVerdict verdict_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoGap:
      return GapVerdict::kNoGap;
    case Verdict::kParameterError:
      return GapVerdict::kParameterError;
    case Verdict::kEffect:
      return GapVerdict::kEffect;
    case Verdict::kUnexplained:
      return GapVerdict::kUnexplained;
    case Verdict::kInsufficientExcitation:
      break;
  }
  return GapVerdict::kInsufficientExcitation;
}

bool holds(const std::vector<Effect>& effects, Effect effect) {
  return std::find(effects.begin(), effects.end(), effect) != effects.end();
}

// Of a stretch the last frames give rows. Watches that take turns, each of which begins a stretch as soon as
// the others have had theirs, use nearly every row once; a board alone uses one of ninety.
constexpr std::size_t kShift = Watch::kRowsOfStretch;
constexpr std::size_t kWatches = (Watch::kStretch + kShift - 1) / kShift;

/// Shows a recording to a watch whose first stretch begins at row `first`.
void show(std::span<const BoardFrame> frames, std::size_t first, Watch& watch) {
  std::uint32_t lost = 0;
  for (std::size_t row = 0; row < frames.size(); ++row) {
    const bool is_turn = row >= first && (row - first) % (kWatches * kShift) == 0;
    if (is_turn && watch.is_resting()) watch.begin_anew();
    const BoardFrame& seen = frames[row];
    if (!seen.is_lost && lost <= kLongestBridge) watch.count_lost(lost);
    lost = seen.is_lost ? lost + 1 : 0;
    if (!seen.is_missing) watch.step(seen.frame);
    if (seen.is_missing || row < first) watch.interrupt();
  }
}

/// Lowers what a name needs of an axis to what the recording holds for it.
void allow(float excitation, gap::GapLimits& limits) {
  constexpr double kMargin = 0.5;
  if (excitation > 0.0F)
    limits.excitation = std::min(limits.excitation, kMargin * static_cast<double>(excitation));
}

/// Raises what a name needs of an axis above what it shows where it stands still: a controller's answer to
/// its sensors' noise.
void ask_for_more(float excitation, gap::GapLimits& limits) {
  constexpr double kMargin = 2.0;
  limits.excitation = std::max(limits.excitation, kMargin * static_cast<double>(excitation));
}

/// Lifts what an effect needs above what the best form of an axis without one takes, and the noise to what is
/// left; of a machine that is right, above what better values than its datasheet's take, too. Noise that
/// lasts gives each row its share of evidence, and a watch that goes on has up to `kMostRows`. Was there
/// anything?
template <class Axis>
bool calm(const Axis& axis, bool is_right, gap::GapLimits& limits) {
  constexpr double kMargin = 1.25;
  const auto& evaluation = axis.evaluation();
  const GapVerdict verdict = evaluation.finding().verdict;
  const bool is_wrong = verdict == GapVerdict::kParameterError && is_right;
  if (verdict != GapVerdict::kEffect && verdict != GapVerdict::kUnexplained && !is_wrong) return false;
  const auto evidence = static_cast<double>(evaluation.finding().evidence);
  const double growth = static_cast<double>(Axis::kMostRows) / static_cast<double>(axis.statistics().rows());
  if (evidence > limits.evidence) limits.evidence = kMargin * evidence * std::max(1.0, growth);
  limits.noise_ratio = std::max(limits.noise_ratio, static_cast<double>(evaluation.residual_ratio()));
  return true;
}

bool calm(const Watch& watch, const BoardSight& sight, gap::GapSettings& settings) {
  const bool is_right = sight.verdict == Verdict::kNoGap;
  const bool of_spindle = sight.is_spindle_quiet && calm(watch.spindle(), is_right, settings.spindle);
  const bool of_feed = sight.is_feed_quiet && calm(watch.feed(), is_right, settings.feed);
  return of_spindle || of_feed;
}

/// Lowers what an effect needs of an axis to what a cause has that the host, which sees more, is sure of:
/// what noise may be worth is an estimate.
template <class Axis>
void heed(const Axis& axis, const BoardSight& sight, gap::GapLimits& limits) {
  constexpr double kMargin = 0.9;
  constexpr double kLeastShare = 0.4;
  const gap::GapFinding& finding = axis.evaluation().finding();
  if (finding.verdict != GapVerdict::kNoGap || !holds(sight.causes, finding.effect)) return;
  const double needed = kMargin * static_cast<double>(finding.evidence);
  const double least = std::max(gap::GapLimits{}.evidence, kLeastShare * limits.evidence);
  if (needed > least) limits.evidence = std::min(limits.evidence, needed);
}

constexpr int kMostMistakes = 3;

/// What looks like a clock that jitters and is none is noise to the board.
void take_for_noise(float clock_jitter_s, gap::SampleLimits& limits) {
  constexpr float kMargin = 1.2F;
  limits.clock_jitter_s = std::hypot(limits.clock_jitter_s, kMargin * clock_jitter_s);
}

/// By so many of the watches that take turns. `rate_hz`: of the frames.
gap::GapFinding found_by(std::size_t watches, std::span<const BoardFrame> frames, double rate_hz,
                         const MachineParameters& machine, const BoardSight& sight,
                         gap::GapSettings& settings) {
  const auto new_watch = [&] {
    return std::make_unique<Watch>(machine, gap::reference_point_of(machine), 1.0 / rate_hz, settings);
  };
  const auto since = static_cast<std::size_t>(sight.since_s * rate_hz);
  const auto look = [&] {
    std::vector<std::unique_ptr<Watch>> parts(watches);
    in_parallel(watches, [&](std::size_t k) {
      parts[k] = new_watch();
      show(frames, since + k * kShift, *parts[k]);
      parts[k]->finish();
    });
    auto all = new_watch();
    for (const auto& part : parts) all->merge(*part);
    all->finish();
    return all;
  };
  auto all = look();
  for (int i = 0;
       i < kMostMistakes && all->clock_jitter_s() > 0.0F && !holds(sight.causes, Effect::kClockJitter); ++i) {
    take_for_noise(all->clock_jitter_s(), settings.samples);
    all = look();
  }
  const auto judge_again = [&] {
    auto judged = new_watch();
    judged->merge(*all);
    judged->finish();
    all = std::move(judged);
  };
  if (!sight.is_excited) {
    const GapVerdict verdict = all->finding().verdict;
    const bool is_told =
        verdict == GapVerdict::kNotEnoughData || verdict == GapVerdict::kInsufficientExcitation;
    if (is_told || sight.verdict != Verdict::kInsufficientExcitation) return all->finding();
    ask_for_more(all->spindle().evaluation().excitation(), settings.spindle);
    ask_for_more(all->feed().evaluation().excitation(), settings.feed);
    judge_again();
    return all->finding();
  }
  allow(all->spindle().evaluation().excitation(), settings.spindle);
  allow(all->feed().evaluation().excitation(), settings.feed);
  judge_again();
  // What looked like an effect may look like other values without it.
  for (int i = 0; i < kMostMistakes && calm(*all, sight, settings); ++i) judge_again();
  if (sight.verdict != Verdict::kEffect || all->finding().verdict == GapVerdict::kEffect)
    return all->finding();
  heed(all->spindle(), sight, settings.spindle);
  heed(all->feed(), sight, settings.feed);
  judge_again();
  return all->finding();
}

gap::GapFinding found_on_board(std::span<const BoardFrame> frames, double rate_hz,
                               const MachineParameters& machine, const BoardSight& sight,
                               gap::GapSettings& settings) {
  return found_by(kWatches, frames, rate_hz, machine, sight, settings);
}

/// One watch of a part is mostly enough to see that values are wrong, and the others would find the same.
gap::GapFinding found_by_datasheet(std::span<const BoardFrame> frames, double rate_hz,
                                   const MachineParameters& datasheet, const BoardSight& sight,
                                   gap::GapSettings& settings) {
  if (sight.verdict == Verdict::kParameterError) {
    gap::GapSettings of_one = settings;
    const gap::GapFinding found =
        found_by(1, frames.first(frames.size() / 4), rate_hz, datasheet, sight, of_one);
    if (found.verdict >= GapVerdict::kParameterError) return found;
  }
  return found_on_board(frames, rate_hz, datasheet, sight, settings);
}

/// Does the board name what the host, which has found another cause or none that has a name, knows not to
/// explain it?
bool is_mistaken(const gap::GapFinding& found, const BoardSight& sight) {
  if (found.verdict != GapVerdict::kEffect) return false;
  if (sight.verdict == Verdict::kUnexplained) return true;
  if (sight.verdict != Verdict::kEffect) return false;
  const std::vector<Effect> named = alias_set(found);
  return std::none_of(named.begin(), named.end(),
                      [&sight](Effect effect) { return holds(sight.causes, effect); });
}

/// The board does not look for it any more; false where there is no room to say so.
bool take_away(Effect effect, gap::GapSettings& settings) {
  gap::MachineForms& forms = gap::is_of_feed(effect) ? settings.feed.forms : settings.spindle.forms;
  const gap::EffectForm none{.effect = effect, .kind = 0, .parts = 0, .shape = 0.0F};
  const auto end = forms.form.begin() + forms.count;
  const auto known =
      std::find_if(forms.form.begin(), end, [effect](const auto& form) { return form.effect == effect; });
  if (known == end && !forms.has_room(none)) return false;
  if (known == end) ++forms.count;
  *known = none;
  return true;
}

gap::GapFinding found_by_refitted(std::span<const BoardFrame> frames, double rate_hz,
                                  const MachineParameters& machine, const BoardSight& sight,
                                  gap::GapSettings& settings) {
  gap::GapFinding found = found_on_board(frames, rate_hz, machine, sight, settings);
  if (sight.verdict == Verdict::kUnexplained && found.verdict != GapVerdict::kUnexplained) {
    settings.noise = sight.expected_noise;
    found = found_on_board(frames, rate_hz, machine, sight, settings);
  }
  for (int i = 0; i < kMostMistakes && is_mistaken(found, sight) && take_away(found.effect, settings); ++i)
    found = found_on_board(frames, rate_hz, machine, sight, settings);
  return found;
}

/// Takes what is found there if it is an effect.
void look_beside_effects(std::span<const BoardFrame> frames, double rate_hz, const FittedValues& fitted,
                         const BoardSight& sight, gap::GapSettings& settings, gap::GapFinding& found) {
  gap::GapSettings other = settings;
  other.spindle.parameter_spread = fitted.spindle_spread;
  other.feed.parameter_spread = fitted.feed_spread;
  const gap::GapFinding beside = found_by_refitted(frames, rate_hz, fitted.beside_effects, sight, other);
  if (beside.verdict != GapVerdict::kEffect) return;
  found = beside;
  settings = other;
}

}  // namespace

gap::GapFinding watch_on_board(const RecordingSignals& signals, const MachineDescription& machine,
                               const FittedValues& fitted, const BoardSight& sight,
                               gap::GapSettings& settings) {
  const MachineParameters& datasheet = machine.configuration.machine;
  const std::vector<BoardFrame> frames = board_frames(signals, machine, fitted.without_effects);
  gap::GapFinding found = found_by_refitted(frames, signals.rate_hz, fitted.without_effects, sight, settings);
  // A large effect bends the values so far that its column does not reach back, and one that sets in late is
  // between two sets of values.
  if (sight.verdict == Verdict::kEffect && found.verdict != GapVerdict::kEffect)
    look_beside_effects(frames, signals.rate_hz, fitted, sight, settings, found);
  if (found.verdict != GapVerdict::kNoGap && found.verdict != GapVerdict::kParameterError) return found;
  // Beside wrong values everything looks like something.
  BoardSight of_values = sight;
  const bool is_right = sight.verdict == Verdict::kNoGap;
  if (!is_right) of_values.verdict = Verdict::kParameterError;
  of_values.is_spindle_quiet = of_values.is_feed_quiet = is_right;
  gap::GapFinding by_datasheet = found_by_datasheet(frames, signals.rate_hz, datasheet, of_values, settings);
  // What other values explain is no effect, whatever it looks like beside wrong ones.
  if (by_datasheet.verdict != GapVerdict::kNoGap) by_datasheet.verdict = GapVerdict::kParameterError;
  return by_datasheet;
}

bool agree(const gap::GapFinding& board, const DiagnosisResult& host) {
  if (board.verdict != verdict_of(host.verdict)) return false;
  if (board.verdict != GapVerdict::kEffect) return true;
  const std::vector<Effect> named = alias_set(board);
  return std::any_of(host.which.begin(), host.which.end(), [&](const EffectResult& found) {
    return holds(found.alias_set, board.effect) || holds(named, found.effect);
  });
}

}  // namespace morepro::host
