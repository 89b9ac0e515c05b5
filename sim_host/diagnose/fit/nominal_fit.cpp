#include "sim_host/diagnose/fit/nominal_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lib/gap/dry_friction.hpp"
#include "lib/gap/feed_observer.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

constexpr double kSame = 20.0;            // deviance by which two ways to the same fit may differ
constexpr double kBeyondAnyEffect = 0.1;  // deviance per row that no effect makes up for
// As a share of the sensor's: an observer that trusts its sensors looks one step ahead, where wrong
// parameters are hardly more than a linear regression has them.
constexpr std::array kOneStepNoise{0.3, kTrustingNoiseShare};
// With which no fit of a slide that swings behind a play was astray any more (five of a sweep: masses 60
// times too light or 19 times too heavy before, within 4 % then).
constexpr double kCalmNoiseShare = 0.1;
constexpr double kMuchNearer = 0.7;  // to the datasheet, which may be wrong: then all fits are far from it

/// Where the machine file states a dry friction, an axis may be held or let go a moment before it says so: an
/// observer that expects nothing of the kind remembers it for seconds.
void allow_little_noise(AxisFit& fit) {
  const auto& known = fit.model().known;
  if (std::none_of(known.begin(), known.end(),
                   [](const gap::AppliedEffect& one) { return gap::is_dry_friction(one.form); }))
    fit.allow_little_noise();
}

/// Innovations of which as much as `new_share` is new, and not more than `scale` as large as expected.
bool leaves_noise(const AxisFit& fit, double new_share, double scale) {
  const Whitening& whitening = fit.whitening();
  return std::all_of(whitening.begin(), whitening.end(), [=](const SensorWhitening& sensor) {
    return sensor.left > new_share && std::max(sensor.scale[0], sensor.scale[1]) < scale;
  });
}

/// Nothing is left to be desired.
bool leaves_white_noise(const AxisFit& fit) {
  constexpr double kNew = 0.9;
  constexpr double kAsExpected = 1.2;
  return leaves_noise(fit, kNew, kAsExpected);
}

/// Hardly any process noise was needed: no other way ends in anything else.
bool leaves_nothing(const AxisFit& fit) {
  constexpr double kNew = 0.99;
  constexpr double kAsExpected = 1.05;
  return !needs_noise(fit) && leaves_noise(fit, kNew, kAsExpected);
}

void noise_first(AxisFit& fit) {
  fit.settle();
  allow_little_noise(fit);
  fit.settle(1);
}

void parameters_first(AxisFit& fit) {
  allow_little_noise(fit);
  fit.refit();
  fit.settle();
}

void one_step_first(AxisFit& fit, double noise) {
  fit.expect_noise(noise);
  fit.refit();
  fit.settle();
  allow_little_noise(fit);
  fit.settle(1);
}

/// From afar, where the other ways have not come to an end that leaves noise only, and this one does; the
/// best of them is the other way then.
void begin_with_one_step(const AxisFit& start, AxisFit& best, AxisFit& other) {
  std::array<AxisFit, kOneStepNoise.size()> fits{start, start};
  in_parallel(fits.size(), [&](std::size_t i) {
    fits[i].narrow_down();
    one_step_first(fits[i], kOneStepNoise[i]);
  });
  const AxisFit usual = best;
  for (AxisFit& fit : fits) {
    if (!leaves_noise(fit) || !(fit.unlikeliness() < best.unlikeliness())) continue;
    best = std::move(fit);
    other = usual;
  }
}

AxisFit with_model_of(const AxisFit& other, AxisFit fit) {
  fit.change_model() = other.model();
  fit.allow_noise_like(other);
  fit.set_whitening(other.whitening());
  return fit;
}

/// The likeliest way to fit the nominal model first; a second one where another way ends elsewhere.
std::vector<AxisFit> likeliest_fits(const AxisFit& start) {
  AxisFit best = start;
  best.narrow_down();
  AxisFit other = best;
  noise_first(best);
  if (leaves_nothing(best)) {
    best.widen();
    best.polish();
    return {std::move(best)};
  }
  parameters_first(other);
  if (other.unlikeliness() < best.unlikeliness()) std::swap(best, other);
  if (!leaves_white_noise(best)) begin_with_one_step(start, best, other);
  const bool are_same = !(other.unlikeliness() - best.unlikeliness() > kSame);
  best.widen();
  other.widen();
  in_parallel(are_same ? 1 : 2, [&](std::size_t i) { (i == 0 ? best : other).polish(); });
  if (are_same) return {std::move(best)};
  if (other.unlikeliness() < best.unlikeliness()) std::swap(best, other);
  const double worse = other.unlikeliness() - best.unlikeliness();
  const double hopeless = kBeyondAnyEffect * static_cast<double>(start.signals().rows);
  if (worse > kSame && worse < hopeless) return {std::move(best), std::move(other)};
  return {std::move(best)};
}

/// Three times what is usual.
gap::GapNoise<double> loud_noise(const AxisFit& fit) {
  gap::GapNoise<double> noise = fit.model().noise;
  expect_process_noise(3.0 * kUsualNoiseShare, noise);
  return noise;
}

}  // namespace

bool leaves_noise(const AxisFit& fit) {
  constexpr double kMostlyNew = 0.5;
  constexpr double kAsExpected = 1.5;
  return leaves_noise(fit, kMostlyNew, kAsExpected);
}

bool needs_noise(const AxisFit& fit) {
  const bool is_spindle = fit.axis() == Axis::kSpindle;
  return needs_random_forces(fit) ||
         (is_spindle && fit.model().noise.current_step > loud_noise(fit).current_step);
}

// The other axis has what a fit of this one has begun with.
bool needs_random_forces(const AxisFit& fit) {
  const gap::GapNoise<double> loud = loud_noise(fit);
  const gap::GapNoise<double>& noise = fit.model().noise;
  return fit.axis() == Axis::kSpindle ? noise.speed_step > loud.speed_step : noise.feed_step > loud.feed_step;
}

std::vector<AxisFit> nominal_fits(const AxisFit& start) {
  std::vector<AxisFit> fits = likeliest_fits(start);
  // A spindle's causes bend its many parameters as far, and are told beside loud noise as well.
  if (start.axis() != Axis::kFeed || !fits.front().has_gone_astray()) return fits;
  AxisFit calm = start;
  calm.allow_noise_up_to(kCalmNoiseShare);
  std::vector<AxisFit> others = likeliest_fits(calm);
  const AxisFit& other = others.front();
  const bool is_nearer = std::isfinite(other.unlikeliness()) &&
                         other.tells(static_cast<Eigen::Index>(gap::FeedColumn::kMass)) &&
                         other.farthest_factor() < kMuchNearer * fits.front().farthest_factor();
  return is_nearer ? std::move(others) : std::move(fits);
}

std::optional<AxisFit> fit_of_beginning(const AxisFit& fitted) {
  constexpr double kMuchBetter = 0.1;  // deviance per row
  const RecordingSignals beginning = beginning_of(fitted.signals(), fitted.signals().rows / 3);
  AxisFit start(fitted.axis(), beginning, fitted.datasheet());
  start.allow_noise_up_to(fitted.most_noise_share());
  const AxisFit of_all = with_model_of(fitted, start);
  const std::vector<AxisFit> alone = nominal_fits(start);
  const double gain = of_all.unlikeliness_as_it_is() - alone.front().unlikeliness();
  if (!(gain > kMuchBetter * static_cast<double>(beginning.rows))) return std::nullopt;
  AxisFit fit = with_model_of(alone.front(), AxisFit(fitted.axis(), fitted.signals(), fitted.datasheet()));
  fit.stay();
  return fit;
}

}  // namespace morepro::host
