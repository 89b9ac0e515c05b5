#include "sim_host/diagnose/outcome/kept_without_name.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "sim_host/diagnose/fit/surprises.hpp"
#include "sim_host/diagnose/leftover/bursts.hpp"
#include "sim_host/diagnose/leftover/wandering.hpp"
#include "sim_host/diagnose/outcome/changed_values.hpp"
#include "sim_host/diagnose/outcome/ringing_beyond.hpp"

namespace morepro::host {
namespace {

bool shows_a_gap(const AxisOutcome& outcome) {
  return !outcome.diagnosis.found.empty() || outcome.unnamed_deviance() > 0.0;
}

/// What no model of noise expects is there, whether a function without a name follows it or not.
void keep_surprises(AxisOutcome& outcome) {
  const Surprises surprises = surprises_of(outcome.diagnosis.fit);
  if (outcome.diagnosis.found.empty() && surprises.share > kMostSurprising)
    outcome.keep_without_name(surprises.deviance);
}

/// What rings behind the motion is random forces to an observer: nothing is left, and nobody sees a gap. Of
/// the spindle, whose shaft may have a name, it tells less: a supply's ripple in closed loop left 242 there.
void keep_ringing(AxisOutcome& outcome) {
  const AxisFit& fit = outcome.diagnosis.fit;
  if (fit.axis() != Axis::kFeed || fit.signals().is_thinned) return;
  const double unnamed = outcome.unnamed_deviance();
  const Ringing ringing = ringing_beyond(unnamed, fit);
  if (!(ringing.deviance > 0.0)) return;
  if (!(unnamed > 0.0)) outcome.leftover = {};
  outcome.leftover.gain = ringing.deviance;
  outcome.leftover.ringing_hz = ringing.frequency_hz;
  outcome.leftover.lines.clear();
}

/// A machine that is another one from some time on looks like whatever may set in there, or like random
/// forces. Where nothing else was found, payloads were worth 0.11 per row and more, a guide that is tighter
/// here than there 0.02.
void keep_changed_values(AxisOutcome& outcome) {
  constexpr double kLeastAlone = 0.05;  // per row
  if (outcome.diagnosis.fit.signals().is_thinned) return;
  const auto rows = static_cast<double>(outcome.diagnosis.fit.signals().rows);
  const double least = shows_a_gap(outcome) ? std::max(outcome.least_unnamed(), outcome.unnamed_deviance())
                                            : std::max(outcome.least_unnamed(), kLeastAlone * rows);
  const auto changed = changed_values_of(outcome.diagnosis, outcome.least_function());
  if (!changed || changed->deviance < least) return;
  outcome.diagnosis.found.clear();
  outcome.diagnosis.fit = outcome.diagnosis.nominal;
  outcome.leftover = {
      .gain = changed->deviance, .torque_share = changed->torque_share, .changed_values = changed->words};
}

/// What comes and goes by itself is random forces to an observer, too.
void keep_wandering(AxisOutcome& outcome) {
  if (shows_a_gap(outcome) || outcome.diagnosis.fit.signals().is_thinned) return;
  const auto [deviance, torque_share] = wandering_of(outcome.diagnosis.fit);
  if (deviance > 0.0) outcome.leftover = {.gain = deviance, .torque_share = torque_share, .wanders = true};
}

/// Sensors that hang, lines that are disturbed: a robust fit takes no notice.
void keep_bursts(AxisOutcome& outcome) {
  const AxisFit& fit = outcome.diagnosis.fit;
  if (fit.signals().is_thinned) return;
  const double unnamed = outcome.unnamed_deviance();
  if (!outcome.diagnosis.found.empty() || (unnamed > 0.0 && outcome.leftover.is_described())) return;
  std::vector<Bursts> bursts = bursts_of(fit);
  double all = 0.0, of_speed = 0.0;
  for (const Bursts& one : bursts) {
    all += one.deviance;
    if (one.channel == Channel::kSpindleSpeed) of_speed += one.deviance;
  }
  if (!(all > 0.0)) return;
  outcome.leftover = {
      .gain = std::max(all, unnamed), .torque_share = of_speed / all, .bursts = std::move(bursts)};
}

}  // namespace

void keep_what_no_balance_shows(AxisOutcome& outcome) {
  keep_surprises(outcome);
  keep_ringing(outcome);
  keep_changed_values(outcome);
  keep_wandering(outcome);
  keep_bursts(outcome);
}

}  // namespace morepro::host
