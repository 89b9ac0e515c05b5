#include "sim_host/diagnose/outcome/unnamed_where.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "lib/gap/unnamed_laws.hpp"
#include "sim_host/diagnose/balances/line_columns.hpp"
#include "sim_host/diagnose/balances/where.hpp"

namespace morepro::host {
namespace {

constexpr std::array<std::string_view, gap::laws::kUnnamedSpindleLaws> kOfSpindle{
    "a constant",
    "the speed",
    "the square of the speed",
    "the square of the speed with its sign",
    "the cube of the speed",
    "the sign of the speed",
    "the current",
    "the square of the current",
    "the square of the current with its sign",
    "the cube of the current",
    "the sign of the current",
    "speed times current",
    "current times the square of the speed",
    "speed times the square of the current",
    "the speed in contact",
    "the current in contact",
    "the square of the speed in contact",
    "speed times feed speed",
    "winding temperature times current",
    "winding temperature times speed",
    "the tool temperature in contact",
    "the feed speed",
    "the square of the feed speed with its sign",
    "the feed force",
    "contact",
    "the acceleration",
};
constexpr std::size_t kBeforePlaces = gap::laws::kUnnamedBeforePlaces;
constexpr std::array<std::string_view, kBeforePlaces> kOfFeed{
    "a constant",
    "the feed speed",
    "the magnitude of the feed speed",
    "the square of the feed speed with its sign",
    "the sign of the feed speed",
    "the feed speed near standstill",
    "the feed force",
    "the square of the feed force with its sign",
    "feed force times feed speed",
    "position times feed speed",
    "position times the sign of the feed speed",
    "the feed speed in contact",
    "the spindle speed in contact",
    "spindle speed times feed speed",
    "the spindle speed",
    "position times feed force",
};

/// "the estimated current" where it was not recorded.
std::string as_known(std::string words, const RecordingSignals& signals) {
  struct Signal {
    std::string_view name;
    Channel channel;
  };
  constexpr std::array<Signal, 4> kEstimated{{{"current", Channel::kArmatureCurrent},
                                              {"feed speed", Channel::kFeedSpeed},
                                              {"position", Channel::kFeedPosition},
                                              {"winding temperature", Channel::kWindingTemperature}}};
  constexpr std::string_view kPrefix = "estimated ";
  for (const auto& [name, channel] : kEstimated) {
    if (signals.has(channel)) continue;
    for (std::size_t at = words.find(name); at != std::string::npos;
         at = words.find(name, at + kPrefix.size() + name.size()))
      words.insert(at, kPrefix);
  }
  return words;
}

std::string words_for(const gap::EffectForm& form, const gap::EffectScales<double>& scales) {
  const std::size_t law = form.kind;
  if (form.effect != gap::Effect::kUnnamedForce) return std::string(kOfSpindle.at(law));
  if (law < kBeforePlaces) return std::string(kOfFeed.at(law));
  const std::size_t bell = law - kBeforePlaces;
  const double place =
      (static_cast<double>(bell % gap::laws::kUnnamedPlaces) + 0.5) / gap::laws::kUnnamedPlaces;
  constexpr std::array<std::string_view, 3> kThere{"the place", "the sign of the feed speed",
                                                   "the feed force"};
  return fmt::format("{} near {:.4g} m", kThere.at(bell / gap::laws::kUnnamedPlaces),
                     scales.travel_from_m + place * scales.travel_m);
}

std::string words_for(const Bursts& bursts) {
  return fmt::format(
      "nothing: {} time{}, for {} rows in all, {} shows what nothing leads to, first at {:.4f} s{}",
      bursts.times, bursts.times == 1 ? "" : "s", bursts.rows, kChannels[index_of(bursts.channel)].column,
      bursts.first_s, bursts.hangs ? "; it repeats its last sample there" : "");
}

gap::Balance balance_of_spindle(bool acts_on_voltage, const RecordingSignals& signals) {
  return signals.balance_that_shows(acts_on_voltage ? gap::Balance::kArmatureVoltage
                                                    : gap::Balance::kSpindleTorque);
}

gap::Balance balance_of(const gap::EffectForm& form, const RecordingSignals& signals) {
  if (form.effect == gap::Effect::kUnnamedForce) return gap::Balance::kFeedForce;
  return balance_of_spindle(form.effect == gap::Effect::kUnnamedVoltage, signals);
}

/// The balance in which most of what has no name sits.
gap::Balance balance_of_most(const AxisOutcome& outcome) {
  const AxisFit& fit = outcome.diagnosis.fit;
  if (fit.axis() == Axis::kFeed) return gap::Balance::kFeedForce;
  return balance_of_spindle(outcome.leftover.torque_share < 0.5, fit.signals());
}

/// The model with the functions that stand in for what has no name.
AxisDiagnosis with_functions(const AxisOutcome& outcome) {
  AxisDiagnosis diagnosis = outcome.diagnosis;
  for (const gap::EffectForm& form : outcome.leftover.functions) {
    diagnosis.fit.change_model().effects.push_back({.form = form});
    diagnosis.found.push_back({.effect = {.form = form}, .rivals = {}});
  }
  diagnosis.fit.refit_with_this_noise();
  return diagnosis;
}

/// Its balances over the noise itself: what the functions leave, too, is structure.
std::vector<BalanceResult> balances_over_noise(const AxisDiagnosis& diagnosis, const Leftover& leftover) {
  std::vector<BalanceRows> rows = balance_rows(diagnosis, &leftover);
  for (BalanceRows& balance : rows)
    for (WindowPower& window : balance.after) window.power.fill(1.0);
  return balances_of(diagnosis, rows);
}

void add_line_cells(const AxisOutcome& outcome, BalanceResult& balance) {
  for (const LeftLine& line : outcome.leftover.lines) {
    if (balance_of(outcome.diagnosis.fit.axis(), line) != balance.balance) continue;
    balance.cells.push_back({line.is_order ? "order" : "frequency", line.frequency - 0.5 * line.resolution,
                             line.frequency + 0.5 * line.resolution, line.power, line.p_value});
  }
}

}  // namespace

bool shows_unnamed(const AxisOutcome& outcome, const BalanceResult& balance) {
  const double here = outcome.unnamed_deviance_in(balance.balance);
  return balance.is_evaluated && here > 0.0 && here >= 0.5 * outcome.leftover.gain;
}

void show_unnamed(AxisOutcome& outcome, std::vector<BalanceResult>& balances) {
  if (!(outcome.unnamed_deviance() > 0.0)) return;
  AxisDiagnosis explained = with_functions(outcome);
  tell_lines_from_functions(explained.fit, outcome.leftover);
  if (outcome.leftover.is_lines_only) explained = outcome.diagnosis;
  const std::vector<BalanceResult> shown = balances_over_noise(explained, outcome.leftover);
  const auto samples = static_cast<double>(outcome.diagnosis.fit.signals().rows);
  const double window_rows = samples / (0.5 * kWindowLength) * kRowsPerWindow;
  for (std::size_t i = 0; i < balances.size(); ++i) {
    BalanceResult& balance = balances[i];
    if (!shows_unnamed(outcome, balance)) continue;
    const double left_by_names = balance.residual_ratio_after / balance.residual_ratio;
    // Above the frequencies of the windows only the evidence tells of it.
    const double by_evidence =
        (1.0 + outcome.unnamed_deviance_in(balance.balance) / window_rows) / left_by_names;
    balance.residual_ratio = std::max(shown[i].residual_ratio, by_evidence);
    balance.residual_ratio_after = left_by_names * balance.residual_ratio;
    balance.cells = shown[i].cells;
    add_line_cells(outcome, balance);
  }
}

std::vector<FollowedSignal> followed_by_unnamed(const AxisOutcome& outcome) {
  std::vector<FollowedSignal> followed;
  if (!(outcome.unnamed_deviance() > 0.0) || outcome.leftover.is_lines_only) return followed;
  const AxisFit& fit = outcome.diagnosis.fit;
  if (outcome.leftover.ringing_hz > 0.0)
    followed.push_back({gap::Balance::kFeedForce, fmt::format("a resonance near {:.0f} Hz behind the motion",
                                                              outcome.leftover.ringing_hz)});
  if (outcome.leftover.wanders)
    followed.push_back({balance_of_most(outcome),
                        "its own past, for longer than random forces last, and nothing that is recorded"});
  for (const Bursts& bursts : outcome.leftover.bursts)
    followed.push_back(
        {fit.signals().balance_that_shows(balance_shown_by(bursts.channel)), words_for(bursts)});
  if (has_changed(outcome)) followed.push_back({balance_of_most(outcome), outcome.leftover.changed_values});
  const gap::EffectScales<double> scales(fit.model().machine, fit.model().point);
  for (const gap::EffectForm& form : outcome.leftover.functions) {
    FollowedSignal one{balance_of(form, fit.signals()), as_known(words_for(form, scales), fit.signals())};
    // The same function, late and not, is one.
    if (std::find(followed.begin(), followed.end(), one) == followed.end())
      followed.push_back(std::move(one));
  }
  return followed;
}

}  // namespace morepro::host
