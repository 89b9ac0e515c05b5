#include "sim_host/diagnose/outcome/axis_outcome.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/fit/nominal_fit.hpp"
#include "sim_host/diagnose/fit/surprises.hpp"
#include "sim_host/diagnose/fit/white_innovations.hpp"
#include "sim_host/diagnose/outcome/causes.hpp"
#include "sim_host/diagnose/outcome/kept_without_name.hpp"
#include "sim_host/diagnose/outcome/name_checks.hpp"
#include "sim_host/diagnose/search/effect_trial.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

constexpr double kSearchShare = 0.9;  // of an axis's time, about
// Of what is predictable: names that were not there had up to 1.16 of it in 237 recordings of another
// simulator, right ones 1.2 and more.
constexpr double kNamedOfNoise = 1.2;
constexpr std::size_t kManyEffects = 3;
// Of the deviance that names and what is left beside them take: on tests/blind functions without a name took
// up to 0.62 of it where names were right, and 0.73 and more where the cause had none.
constexpr double kNearlyAll = 0.68;

ChanceEvidence bootstrapped(const AxisDiagnosis& diagnosis, const DiagnosisOptions& options) {
  int done = 0;
  return chance_evidence(diagnosis.fit, diagnosis.rest, diagnosis.others, options.bootstrap_runs,
                         options.seed, [&] {
                           const double share = ++done / static_cast<double>(options.bootstrap_runs);
                           options.on_progress(kSearchShare + (1.0 - kSearchShare) * share);
                         });
}

/// Deviance that refitted parameters gain by chance.
double freedom_of_parameters(const AxisFit& fit) {
  return static_cast<double>(parameter_count(fit.axis())) *
         std::log(static_cast<double>(fit.signals().rows) + 2.0);
}

/// Deviance by which a datasheet's values are worse than those that were fitted.
double deviance_of_datasheet(const AxisFit& nominal) {
  AxisFit datasheet = nominal;
  datasheet.change_model().machine = nominal.datasheet().machine;
  const GapStatistics& wrong = datasheet.innovations();
  const GapStatistics& right = nominal.innovations();
  if (!(right.total_rows() > 0.0)) return 0.0;
  const double rows = right.total_rows();
  return rows * std::log(wrong.total()(0, 0) / right.total()(0, 0));
}

/// Squared distance of the values from a datasheet's, in standard errors, where these are right to a little
/// all the same. Solvers and sensors that average leave as much, and a long recording is sure of it.
double distance_from_datasheet(const AxisFit& nominal) {
  constexpr double kExact = 0.005;  // relative
  const Eigen::VectorXd deviation = nominal.deviation();
  Eigen::VectorXd tolerance = Eigen::VectorXd::Constant(deviation.size(), kExact);
  if (nominal.axis() == Axis::kFeed)
    tolerance.tail(2).setConstant(kExact * std::fabs(nominal.datasheet().machine.feed.contact_force_n));
  if (nominal.covariance().cols() < deviation.size()) return 0.0;
  Eigen::MatrixXd covariance = nominal.covariance().topLeftCorner(deviation.size(), deviation.size());
  covariance.diagonal() += tolerance.cwiseAbs2();
  return deviation.dot(covariance.ldlt().solve(deviation));
}

bool is_datasheet_wrong(const AxisFit& nominal, double deviance) {
  // What six values reach once in a thousand recordings, and four.
  const double far = nominal.axis() == Axis::kSpindle ? 22.5 : 18.5;
  return deviance - freedom_of_parameters(nominal) > kFixedThreshold &&
         distance_from_datasheet(nominal) > far;
}

/// The same where noise may last: what it bends the parameters by makes the recording likelier, too.
bool is_datasheet_wrong_beside_lasting_noise(AxisFit nominal) {
  AxisFit datasheet = nominal;
  datasheet.change_model().machine = nominal.datasheet().machine;
  const double wrong = datasheet.deviance_beside_lasting_noise(Memory::kLong);
  const double right = nominal.refit_beside_lasting_noise(Memory::kLong);
  return is_datasheet_wrong(nominal, wrong - right);
}

/// In closed loop, noise that lasts longer than the observer expects is in the regressors, too: names take
/// some of what is predictable of it, the more the longer the recording.
double noise_evidence(const AxisFit& fit) {
  const double most = kMostOfNoise * static_cast<double>(fit.signals().rows);
  return std::min(kNamedOfNoise * predictable_deviance(fit.innovations()), most);
}

/// What has no name where an effect acts; what a voltage's shape leaves is no torque, nor the other way
/// round. A flux, as the second kind of its laws, is in both.
double unnamed_beside(const gap::EffectForm& form, const AxisOutcome& outcome) {
  const auto acted_on = static_cast<gap::Balance>(gap::info_of(form.effect).group);
  const bool is_flux = acted_on == gap::Balance::kArmatureVoltage && form.kind == 1;
  if (gap::is_in_sensor(form.effect) || is_flux) return outcome.unnamed_deviance();
  return outcome.unnamed_deviance_in(outcome.diagnosis.fit.signals().balance_that_shows(acted_on));
}

/// The least of several causes, where it is worth little more than what has none beside it: what the shape of
/// the strongest one leaves of another machine. Of 24 right names of a further simulator two were like that,
/// of 35 wrong ones 16. The parts of a friction, which are one cause, leave as much on real machines.
std::optional<std::size_t> least_beside_much_left(const AxisOutcome& outcome) {
  constexpr double kLittle = 0.5;  // of the strongest one's evidence
  constexpr double kMuchLeft = 0.3;
  const std::vector<Finding>& found = outcome.diagnosis.found;
  double most = 0.0;
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < found.size(); ++i) {
    most = std::max(most, found[i].evidence);
    const bool is_least = !least || found[i].evidence < found[*least].evidence;
    if (is_least && is_cause_of_its_own(found, i)) least = i;
  }
  if (!least || !(found[*least].evidence < kLittle * most)) return std::nullopt;
  if (!(unnamed_beside(found[*least].effect.form, outcome) > kMuchLeft * found[*least].evidence))
    return std::nullopt;
  return least;
}

void drop_what_is_left_of_shapes(AxisOutcome& outcome) {
  while (const auto least = least_beside_much_left(outcome)) {
    drop(outcome.diagnosis, *least);
    outcome.leftover = leftover_of(outcome.diagnosis.fit, outcome.least_function());
  }
}

/// Evidence below which nothing is looked at.
double least_evidence(Axis axis, const RecordingSignals& signals) {
  const auto rounding = [&signals](Channel channel) { return signals.rounding_deviance[index_of(channel)]; };
  return std::max(kFixedThreshold,
                  axis == Axis::kSpindle
                      ? rounding(Channel::kSpindleSpeed) + rounding(Channel::kArmatureCurrent)
                      : rounding(Channel::kFeedSpeed) + rounding(Channel::kFeedPosition));
}

AxisDiagnosis searched(const AxisFit& start, const AxisFit& nominal, double to_beat,
                       const DiagnosisOptions& options) {
  const auto on_progress = [&](double share) { options.on_progress(kSearchShare * share); };
  const double least = least_evidence(start.axis(), start.signals());
  return search_effects(start, nominal, options.excluded, least, to_beat, on_progress);
}

AxisOutcome outcome_from(AxisDiagnosis diagnosis, const DiagnosisOptions& options) {
  AxisOutcome outcome{std::move(diagnosis)};
  outcome.chance = bootstrapped(outcome.diagnosis, options);
  outcome.noise_evidence = noise_evidence(outcome.diagnosis.fit);
  drop_what_chance_explains(outcome.diagnosis, outcome.least_name());
  outcome.leftover = leftover_of(outcome.diagnosis.fit, outcome.least_function());
  return outcome;
}

/// A good deal is left or surprises, or it took many effects: perhaps the parameters that the search began
/// with were not the right ones.
bool is_doubtful(const AxisOutcome& outcome) {
  if (outcome.diagnosis.runs_away()) return true;
  constexpr double kGoodDeal = 0.1;  // of everything, in deviance
  const double left = outcome.leftover.gain;
  const bool is_left =
      left >= outcome.least_unnamed() && left > kGoodDeal * (left + outcome.named_deviance());
  return is_left || outcome.diagnosis.found.size() >= kManyEffects ||
         surprises_of(outcome.diagnosis.fit).share > kMostSurprising;
}

/// What sets in late has bent the parameters that all of the recording was fitted with at first.
bool sets_in_late(const AxisOutcome& outcome) {
  const auto& found = outcome.diagnosis.found;
  return std::any_of(found.begin(), found.end(), [](const Finding& f) { return f.effect.onset_s > 0.0; });
}

/// `dropped`: deviance of the names that lasting noise explains.
void tell_wandering_from_noise(double dropped, AxisOutcome& outcome) {
  const AxisFit& fit = outcome.diagnosis.fit;
  if (!(dropped > 0.0) && outcome.leftover.functions.empty()) return;
  if (remembers_for_long(fit))
    outcome.keep_without_name(dropped);
  else if (is_lasting_noise(fit, outcome.leftover))
    outcome.leftover = {};
}

/// Noise that lasts bends parameters in closed loop, and what a controller is asked to follow is a line then.
void forget_lines_of_bent_values(AxisOutcome& outcome) {
  if (!outcome.diagnosis.found.empty() || outcome.leftover.lines.empty()) return;
  AxisFit unbent = outcome.diagnosis.fit;
  unbent.refit_beside_lasting_noise(Memory::kLong);
  Leftover left = leftover_of(unbent, outcome.least_function());
  if (left.gain < outcome.leftover.gain) outcome.leftover = std::move(left);
}

/// Lags that the input's news explain as well, unless structure is left without them: noise has none.
void drop_lags_of_news(AxisOutcome& outcome) {
  AxisDiagnosis before = outcome.diagnosis;
  if (!drop_what_input_news_explain(outcome.diagnosis)) return;
  Leftover left = leftover_of(outcome.diagnosis.fit, outcome.least_function());
  if (left.gain < outcome.least_unnamed() || left.gain < outcome.leftover.gain)
    outcome.leftover = std::move(left);
  else
    outcome.diagnosis = std::move(before);
}

/// Sizes of the fit as it is. The size of a law that may bend is extrapolated, and a fit beside noise that
/// lasts bends it further: 8 N of a Stribeck curve were right to a tenth before, and 10.2 N after.
void take_plain_sizes(AxisDiagnosis& diagnosis) {
  for (std::size_t i = 0; i < diagnosis.found.size(); ++i)
    if (!gap::bends(diagnosis.found[i].effect.form.effect))
      diagnosis.found[i].effect = diagnosis.fit.model().effects[i];
}

void conclude(AxisOutcome& outcome, double noise_evidence) {
  if (outcome.diagnosis.runs_away()) {
    outcome.leftover = {};
    return;
  }
  AxisDiagnosis& diagnosis = outcome.diagnosis;
  const bool is_lasting = outcome.noise_evidence > 0.0 && !diagnosis.fit.signals().is_thinned;
  outcome.noise_evidence = noise_evidence;
  bool has_changed = drop_what_chance_explains(diagnosis, outcome.least_name());
  const double named = outcome.named_deviance();
  has_changed |= drop_what_lasting_noise_explains(diagnosis, noise_evidence);
  const double dropped = named - outcome.named_deviance();
  if (has_changed) outcome.leftover = leftover_of(diagnosis.fit, outcome.least_function());
  drop_lags_of_news(outcome);
  drop_what_is_left_of_shapes(outcome);
  tell_wandering_from_noise(dropped, outcome);
  drop_what_no_balance_shows(diagnosis);
  if (is_lasting) forget_lines_of_bent_values(outcome);
  keep_what_no_balance_shows(outcome);
  if (is_lasting) {
    diagnosis.fit.refit_beside_lasting_noise(Memory::kLong);
    take_plain_sizes(diagnosis);
  }
  diagnosis.fit.attribute_load();
  diagnosis.nominal.attribute_load();
  outcome.is_datasheet_wrong =
      is_lasting ? is_datasheet_wrong_beside_lasting_noise(diagnosis.nominal)
                 : is_datasheet_wrong(diagnosis.nominal, deviance_of_datasheet(diagnosis.nominal));
}

/// Three causes and more that a few functions without a name nearly stand in for share a cause that has none.
void drop_what_needs_no_names(AxisOutcome& outcome) {
  AxisDiagnosis& diagnosis = outcome.diagnosis;
  if (causes_of(diagnosis.found) < kManyEffects) return;
  Leftover nameless = leftover_of(diagnosis.nominal, outcome.least_function());
  if (!(nameless.gain > kNearlyAll * (outcome.named_deviance() + outcome.leftover.gain))) return;
  diagnosis.found.clear();
  diagnosis.fit = diagnosis.nominal;
  outcome.leftover = std::move(nameless);
}

}  // namespace

void AxisOutcome::keep_without_name(double deviance, double torque_share) {
  const double of_noise = kMuch * static_cast<double>(diagnosis.fit.signals().rows);
  const double counts = unnamed_deviance() > 0.0 ? least_unnamed() : 0.0;  // what is there does
  if (!(deviance > std::max({of_noise, leftover.gain, counts}))) return;
  if (!(leftover.gain > 0.0)) leftover.torque_share = torque_share;
  leftover.gain = deviance;
  leftover.ringing_hz = 0.0;
  leftover.wanders = false;
  leftover.bursts.clear();
}

double AxisOutcome::threshold() const { return std::max(least_function(), noise_evidence); }

double AxisOutcome::least_name() const {
  return diagnosis.fit.signals().is_thinned ? threshold() : least_function();
}

double AxisOutcome::threshold_of(const Finding& finding) const {
  const bool is_judged_beside_noise = finding.evidence < threshold() || finding.kept > kUsuallyKept;
  return is_judged_beside_noise ? least_name() : threshold();
}

const Finding& AxisOutcome::strongest() const {
  return *std::ranges::max_element(diagnosis.found, {}, &Finding::evidence);
}

NamingContext AxisOutcome::context_of(const Finding& finding, double unnamed_share) const {
  const Finding& most = strongest();
  const bool is_strongest = finding.evidence >= most.evidence;
  const bool is_whole = is_strongest || are_of_one_friction(finding, most);
  return {.temperature = chance.temperature,
          .threshold = threshold_of(finding),
          .unnamed_share = unnamed_share,
          .causes = causes_of(diagnosis.found),
          .may_be_one = may_be_one_cause(diagnosis.found),
          .farthest_factor = diagnosis.fit.farthest_factor(),
          .is_strongest = is_strongest,
          .share = is_whole ? 1.0 : finding.evidence / most.evidence};
}

double AxisOutcome::least_function() const { return std::max(diagnosis.least_evidence, chance.quantile99); }

double AxisOutcome::unnamed_deviance_in(gap::Balance balance) const {
  // Without a current, the torque's balance is all that is evaluated of both.
  const double torque = diagnosis.fit.signals().has_electrics() ? leftover.torque_share : 1.0;
  const double share = balance == gap::Balance::kArmatureVoltage ? 1.0 - torque
                       : balance == gap::Balance::kSpindleTorque ? torque
                                                                 : 1.0;
  return share * unnamed_deviance();
}

// Where much is left, or it took many causes, the search begins once more from other values, and with what
// the first third of the recording says by itself: what sets in late has bent the values of all of it.
std::optional<AxisOutcome> outcome_of(Axis axis, const RecordingSignals& signals, const GapModel& datasheet,
                                      const DiagnosisOptions& options) {
  const std::vector<AxisFit> starts = nominal_fits(AxisFit(axis, signals, datasheet));
  if (starts.front().unlikeliness() == 0.0) return std::nullopt;
  static_cast<void>(starts.front().innovations());  // which the outcome's fits share where nothing is found
  const AxisFit& nominal = starts.front();
  AxisOutcome outcome = outcome_from(searched(nominal, nominal, AxisFit::kNone, options), options);
  const auto try_from = [&](const AxisFit& start) {
    const double to_beat = outcome.diagnosis.cost_of_two;
    AxisDiagnosis other = searched(start, nominal, to_beat, options);
    const auto is_better = [&outcome](const AxisFit& fit) {
      return cost_of(fit) < cost_of(outcome.diagnosis.fit);
    };
    if (other.is_behind(to_beat) || !is_better(other.fit)) return;
    AxisOutcome nearer = outcome_from(std::move(other), options);
    if (is_better(nearer.diagnosis.fit)) outcome = std::move(nearer);
  };
  if (starts.size() > 1 && is_doubtful(outcome)) try_from(starts.back());
  if (is_doubtful(outcome) || sets_in_late(outcome))
    if (const auto early = fit_of_beginning(outcome.diagnosis.fit)) try_from(*early);
  drop_what_needs_no_names(outcome);
  return outcome;
}

void conclude(std::span<AxisOutcome> outcomes) {
  double noise_evidence = 0.0;
  for (const AxisOutcome& outcome : outcomes)
    noise_evidence = std::max(noise_evidence, outcome.noise_evidence);
  in_parallel(outcomes.size(), [&](std::size_t i) { conclude(outcomes[i], noise_evidence); });
}

}  // namespace morepro::host
