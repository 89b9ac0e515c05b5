#include "sim_host/diagnose/search/clock_jitter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lib/plant/dynamics.hpp"
#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "sim_host/diagnose/fit/repeated_logarithm.hpp"
#include "sim_host/diagnose/fit/white_innovations.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

constexpr double kLeastEvidence = 40.0;
// What is beyond counts as this many deviations, or as what a whole interval makes of a position: its rate is
// the same before and behind the sample, those of the others are not.
constexpr double kLargestDeviation = 6.0;
// Of squares of rates over noise, in 1/s2: from what takes a second to be seen to a microsecond's part.
constexpr std::size_t kBins = 320;
constexpr double kFirstDecade = 0.0;
constexpr double kBinsPerDecade = 20.0;
// By neighbours. The observer takes part of a jitter for a change of the state, which comes back with the
// other sign: up to half of it, or more where process noise was fitted to a large jitter. Where a law is
// wrong it is nearly all, of either sign, or less beside what else goes with rates: an inductance that
// depends on the angle .27 to .49, jitters .19 at most, of a third of an interval .45, inputs and samples
// alike.
constexpr double kMostShared = 0.25;
constexpr double kMostSharedOfLarge = 0.45;
constexpr double kLarge = 0.2;  // of an interval
constexpr double kLeastShared = -0.6;
constexpr double kLeastSharedAtFirst = -1.0;  // where process noise was fitted to a large jitter
constexpr double kSizeError = 0.05;  // relative: between which two rates an instant lies is not recorded
constexpr std::size_t kFewestResiduals = 400;

/// Residuals that a jitter would add the same share to, in units of the observer's variance.
struct Bin {
  double count = 0.0;
  double squares = 0.0;
  double growth = 0.0;  ///< sum of what a jitter of a second adds
};

/// What one sensor shows beside the model, in the air or in contact.
struct Residuals {
  std::vector<Bin> bin = std::vector<Bin>(kBins);
  double count = 0.0;
  double log_variance = 0.0;  ///< sum, as the observer expects it
  RepeatedLogarithm log{};

  void add(double value, double rate, double variance) {
    const double growth = rate * rate / variance;
    const double decades = std::log10(std::max(growth, 1.0e-300)) - kFirstDecade;
    const double index = std::clamp(decades * kBinsPerDecade, 0.0, static_cast<double>(kBins - 1));
    Bin& here = bin[static_cast<std::size_t>(index)];
    here.count += 1.0;
    here.squares += value * value / variance;
    here.growth += growth;
    count += 1.0;
    log_variance += log(variance);
  }
};

/// Products of neighbouring residuals and rates, and what they would be with residuals of one second times
/// the rate: a wrong law makes residuals that go with rates, a jitter knows nothing of its neighbour.
struct Togetherness {
  double shared = 0.0;
  double per_s2 = 0.0;
  double product_before = 0.0;
  double growth_before = 0.0;

  void add(double value, double rate, double variance) {
    const double product = value * rate / variance;
    const double growth = rate * rate / variance;
    shared += product * product_before;
    per_s2 += growth * growth_before;
    product_before = product;
    growth_before = growth;
  }
};

struct Evaluation {
  std::vector<Residuals> residuals;
  std::vector<Togetherness> togetherness;  ///< of each sensor
  std::vector<std::size_t> fit;            ///< whose sensor it is
};

/// Rates of an axis's two sensors at the end of the interval that begins at a frame, as the model tells them:
/// by what is measured at its beginning and its input, so that they know nothing of the next measurement.
class Rates {
 public:
  Rates(Axis axis, const RecordingSignals& signals, const GapModel& model)
      : axis_(axis),
        period_s_(1.0 / signals.rate_hz),
        plant_(model.machine),
        frames_(signals, model.machine, 0) {}

  /// Of the interval that ends at `row`; rows in ascending order.
  std::array<double, kSensorsPerAxis> at(std::size_t row) {
    while (frames_.row() < row) {
      const auto frame = frames_.next();
      if (frame.has_speed) x_.speed_rad_s = frame.speed_rad_s;
      if (frame.has_current) x_.current_a = frame.current_a;
      if (frame.has_feed_speed) x_.feed_speed_m_s = frame.feed_speed_m_s;
      input_ = frame.input;
    }
    const auto first = plant_.derivative(x_, input_);
    const PlantState<double> end{x_.speed_rad_s + period_s_ * first.acceleration_rad_s2,
                                 x_.feed_speed_m_s + period_s_ * first.feed_acceleration_m_s2,
                                 x_.current_a + period_s_ * first.current_rate_a_s};
    const auto last = plant_.derivative(end, input_);
    if (axis_ == Axis::kSpindle) return {last.acceleration_rad_s2, last.current_rate_a_s};
    return {end.feed_speed_m_s, last.feed_acceleration_m_s2};
  }

 private:
  Axis axis_;
  double period_s_;
  Plant<double> plant_;
  FrameSource frames_;
  PlantState<double> x_{};
  PlantInput<double> input_{};
};

bool knows_rates(const AxisFit& fit) {
  const RecordingSignals& signals = fit.signals();
  if (signals.is_thinned) return false;
  if (fit.axis() == Axis::kFeed) return signals.has(Channel::kFeedSpeed);
  return signals.has(Channel::kSpindleSpeed) && signals.has_electrics();
}

Evaluation look_at(const AxisFit& fit, const GapModel& model) {
  Evaluation evaluation{.residuals = std::vector<Residuals>(2 * kSensorsPerAxis),
                        .togetherness = std::vector<Togetherness>(kSensorsPerAxis),
                        .fit = {}};
  Rates rates(fit.axis(), fit.signals(), model);
  const double period_s = 1.0 / fit.signals().rate_hz;
  run_observer(fit.axis(), fit.signals(), model, 0, fit.signals().rows, [&](const Innovation& v) {
    if (v.row == 0) return;
    const double rate = rates.at(v.row)[v.sensor];
    const bool is_position = fit.axis() == Axis::kFeed && v.sensor == 0;
    const double of_interval = is_position ? period_s * std::fabs(rate) : 0.0;
    const double most = std::max(kLargestDeviation * std::sqrt(v.variance), of_interval);
    const double value = std::clamp(v.value, -most, most);
    evaluation.residuals[2 * v.sensor + (v.in_contact ? 1 : 0)].add(value, rate, v.variance);
    evaluation.togetherness[v.sensor].add(value, rate, v.variance);
  });
  return evaluation;
}

/// Twice the negative logarithm of the likelihood of residuals of variance (noise + jitter_s2 growth), for
/// the noise that fits best.
double unlikeliness(const Residuals& r, double jitter_s2) {
  constexpr int kRounds = 12;
  double total = 0.0;
  for (const Bin& bin : r.bin) total += bin.squares;
  double noise = total / r.count;
  const double least = 1.0e-6 * noise;
  const auto growth_of = [&](const Bin& bin) { return jitter_s2 * bin.growth / bin.count; };
  for (int round = 0; round < kRounds && jitter_s2 > 0.0; ++round) {
    double sum = 0.0;
    double weight = 0.0;
    for (const Bin& bin : r.bin) {
      if (bin.count == 0.0) continue;
      const double variance = noise + growth_of(bin);
      const double w = 1.0 / (variance * variance);
      sum += w * (bin.squares - bin.count * growth_of(bin));
      weight += w * bin.count;
    }
    noise = std::max(sum / weight, least);
  }
  double sum = r.log_variance;
  for (const Bin& bin : r.bin) {
    if (bin.count == 0.0) continue;
    const double variance = noise + growth_of(bin);
    sum += bin.count * std::log(variance) + bin.squares / variance;
  }
  return sum;
}

double unlikeliness(const Evaluation& evaluation, double jitter_s) {
  double sum = 0.0;
  for (const Residuals& r : evaluation.residuals)
    if (r.count >= kFewestResiduals) sum += unlikeliness(r, jitter_s * jitter_s);
  return sum;
}

double evidence_of(const Evaluation& evaluation, std::size_t sensor, double jitter_s2) {
  double sum = 0.0;
  for (const std::size_t i : {2 * sensor, 2 * sensor + 1}) {
    const Residuals& r = evaluation.residuals[i];
    if (r.count >= kFewestResiduals) sum += unlikeliness(r, 0.0) - unlikeliness(r, jitter_s2);
  }
  return sum;
}

Evaluation evaluate(std::span<const AxisFit* const> fits, double share_of_current_noise) {
  std::vector<Evaluation> of_axis(fits.size());
  in_parallel(fits.size(), [&](std::size_t i) {
    if (!knows_rates(*fits[i])) return;
    GapModel model = fits[i]->model();
    model.noise.current_step *= share_of_current_noise;
    of_axis[i] = look_at(*fits[i], model);
  });
  Evaluation all;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Evaluation& one = of_axis[i];
    all.residuals.insert(all.residuals.end(), one.residuals.begin(), one.residuals.end());
    all.togetherness.insert(all.togetherness.end(), one.togetherness.begin(), one.togetherness.end());
    all.fit.insert(all.fit.end(), one.togetherness.size(), i);
  }
  return all;
}

struct Jitter {
  double size_s = 0.0;
  double unlikeliness = 0.0;
};

/// The most likely one up to half of a sampling interval.
Jitter best_jitter(const Evaluation& evaluation, double period_s) {
  constexpr double kRatio = 1.02;
  Jitter best{0.0, unlikeliness(evaluation, 0.0)};
  for (double size_s = 1.0e-3 * period_s; size_s < 0.5 * period_s; size_s *= kRatio) {
    const double here = unlikeliness(evaluation, size_s);
    if (here < best.unlikeliness) best = {size_s, here};
  }
  return best;
}

struct Judged {
  Evaluation evaluation;
  Jitter jitter;
};

/// Process noise that was fitted without a jitter has taken part of it: less of it may be more likely with
/// one.
Judged with_its_noise(std::span<const AxisFit* const> fits, Judged best, double period_s) {
  for (double share = 0.5; share > 0.01; share *= 0.5) {
    Evaluation here = evaluate(fits, share);
    const Jitter jitter = best_jitter(here, period_s);
    if (!(jitter.unlikeliness < best.jitter.unlikeliness)) break;
    best = {std::move(here), jitter};
  }
  return best;
}

/// What neighbours share of it, of the sensor that shares least of those that tell much of the jitter; and is
/// there a sensor whose samples say that they were taken in time? All are taken by one clock. Or is it a law
/// of the axis that shows the jitter: does its other sensor shake, too, where neighbours share all of it?
struct Doubt {
  double shared = 0.0;
  bool is_refuted = false;
};

Doubt doubt_about(const Judged& judged) {
  const auto& [evaluation, jitter] = judged;
  const double jitter_s2 = jitter.size_s * jitter.size_s;
  constexpr double kMuch = 0.2;   // of what the one says that tells most
  constexpr double kSome = 0.05;  // of it, so that it is asked at all
  constexpr double kByLaw = 0.7;  // shared by neighbours: of three laws without a name .78 at least
  std::vector<double> evidence(evaluation.togetherness.size());
  for (std::size_t sensor = 0; sensor < evidence.size(); ++sensor)
    evidence[sensor] = evidence_of(evaluation, sensor, jitter_s2);
  if (evidence.empty()) return {};
  const auto [least, most] = std::minmax_element(evidence.begin(), evidence.end());
  const auto shows_most = static_cast<std::size_t>(most - evidence.begin());
  Doubt doubt{.shared = 1.0, .is_refuted = *least < -kLeastEvidence};
  for (std::size_t sensor = 0; sensor < evidence.size(); ++sensor) {
    if (!(evidence[sensor] > 0.0 && evidence[sensor] >= kSome * *most)) continue;
    const Togetherness& t = evaluation.togetherness[sensor];
    const double shared = t.shared / (jitter_s2 * t.per_s2);
    const bool is_same_axis = evaluation.fit[sensor] == evaluation.fit[shows_most];
    doubt.is_refuted |= is_same_axis && evidence[sensor] > kLeastEvidence && shared > kByLaw;
    if (evidence[sensor] < kMuch * *most) continue;
    if (std::fabs(shared) < std::fabs(doubt.shared)) doubt.shared = shared;
  }
  return doubt;
}

/// Where a jitter shakes a sensor, is there more than its stated noise? An encoder whose speed is differences
/// of coarse steps is quieter than that as long as it turns evenly.
bool exceeds_stated_noise(const Judged& judged) {
  constexpr double kShaken = 0.25;  // of the stated variance, by the jitter
  constexpr double kMore = 1.2;
  const double jitter_s2 = judged.jitter.size_s * judged.jitter.size_s;
  return std::any_of(judged.evaluation.residuals.begin(), judged.evaluation.residuals.end(),
                     [&](const Residuals& r) {
                       double count = 0.0;
                       double squares = 0.0;
                       for (const Bin& bin : r.bin) {
                         if (!(jitter_s2 * bin.growth > kShaken * bin.count)) continue;
                         count += bin.count;
                         squares += bin.squares;
                       }
                       return squares > kMore * count;
                     });
}

/// By how much the size may change until the likelihood is that of one standard deviation, as a share.
double relative_error(const Evaluation& evaluation, const Jitter& jitter) {
  constexpr double kProbe = 0.1;
  const double rise = 0.5 * (unlikeliness(evaluation, (1.0 + kProbe) * jitter.size_s) +
                             unlikeliness(evaluation, (1.0 - kProbe) * jitter.size_s)) -
                      unlikeliness(evaluation, jitter.size_s);
  return kProbe / std::sqrt(std::max(rise, kProbe * kProbe));
}

/// Do neighbours share too much of a jitter, or too little, for a clock to have made it?
bool is_shared_by_law(double shared, const Jitter& jitter, double period_s, double least_shared) {
  const double most_shared = jitter.size_s > kLarge * period_s ? kMostSharedOfLarge : kMostShared;
  return shared > most_shared || shared < least_shared;
}

/// A sensor, and how much it says that something shakes.
struct Witness {
  double evidence = 0.0;
  std::size_t fit = 0;
  std::size_t sensor = 0;  ///< of the axis
  double variance = 1.0;   ///< that the observer expects, on average
};

/// The one that shakes most.
Witness strongest(const Judged& judged) {
  Witness witness;
  const auto& [evaluation, jitter] = judged;
  for (std::size_t sensor = 0; sensor < evaluation.togetherness.size(); ++sensor) {
    const double evidence = evidence_of(evaluation, sensor, jitter.size_s * jitter.size_s);
    if (!(evidence > witness.evidence)) continue;
    const Residuals& air = evaluation.residuals[2 * sensor];
    const Residuals& contact = evaluation.residuals[2 * sensor + 1];
    const double variance = std::exp((air.log_variance + contact.log_variance) / (air.count + contact.count));
    witness = {evidence, evaluation.fit[sensor], sensor % kSensorsPerAxis, variance};
  }
  return witness;
}

/// Is it still there in what its own past does not predict? In closed loop noise that lasts makes the rates
/// that it goes with, and is predicted; laws and clocks are where rates are.
bool is_unpredicted(const AxisFit& fit, const Witness& witness, double period_s) {
  constexpr double kLeastShare = 0.1;
  const GapStatistics& rest = fit.innovations();
  const std::size_t sensor = witness.sensor;
  const SensorWhitening whitening = whitening_of(rest)[sensor];
  const std::vector<float> white = white_innovations(rest, sensor, whitening);
  Evaluation evaluation{.residuals = std::vector<Residuals>(2), .togetherness = {}, .fit = {}};
  Rates rates(fit.axis(), fit.signals(), fit.model());
  for (std::size_t i = 0; i < white.size(); ++i) {
    if (rest.row[sensor][i] == 0) continue;
    const bool in_contact = rest.in_contact[sensor][i];
    const double deviation =
        whitening.scale[in_contact ? 1 : 0] * std::sqrt(whitening.left * witness.variance);
    const double value = std::clamp(static_cast<double>(white[i]), -kLargestDeviation, kLargestDeviation);
    evaluation.residuals[in_contact ? 1 : 0].add(deviation * value, rates.at(rest.row[sensor][i])[sensor],
                                                 witness.variance);
  }
  const double evidence = unlikeliness(evaluation, 0.0) - best_jitter(evaluation, period_s).unlikeliness;
  return evidence > kLeastShare * witness.evidence;
}

}  // namespace

Shaking find_shaking(std::span<const AxisFit* const> fits) {
  if (fits.empty()) return {};
  const double period_s = 1.0 / fits.front()->signals().rate_hz;
  Evaluation evaluation = evaluate(fits, 1.0);
  const Jitter best = best_jitter(evaluation, period_s);
  const double evidence = unlikeliness(evaluation, 0.0) - best.unlikeliness;
  const Judged first{std::move(evaluation), best};
  if (!(evidence > kLeastEvidence)) return {};
  const Witness witness = strongest(first);
  if (!is_unpredicted(*fits[witness.fit], witness, period_s)) return {};
  Shaking of_law;
  if (exceeds_stated_noise(first))
    of_law = {.of_law = witness.evidence, .fit = witness.fit, .sensor = witness.sensor};
  // A mass that is a seventieth of the machine's makes a jitter of every force that is missing.
  const AxisFit& shaken = *fits[witness.fit];
  if ((shaken.axis() == Axis::kFeed && shaken.has_gone_astray()) ||
      is_shared_by_law(doubt_about(first).shared, best, period_s, kLeastSharedAtFirst))
    return of_law;
  const Judged last = with_its_noise(fits, first, period_s);
  const Doubt doubt = doubt_about(last);
  if (doubt.is_refuted || is_shared_by_law(doubt.shared, last.jitter, period_s, kLeastShared)) return of_law;
  if (!exceeds_stated_noise(last)) return {};
  const double error = std::hypot(relative_error(first.evaluation, first.jitter), kSizeError);
  return {.of_clock = SamplingFault{gap::Effect::kClockJitter, Channel::kArmatureCurrent, last.jitter.size_s,
                                    error * last.jitter.size_s, evidence}};
}

}  // namespace morepro::host
