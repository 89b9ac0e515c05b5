#include "sim_host/diagnose/outcome/ringing_beyond.hpp"

#include <algorithm>

#include "sim_host/diagnose/fit/input_news.hpp"
#include "sim_host/diagnose/fit/nominal_fit.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"

namespace morepro::host {
namespace {

// Swinging parts left 0.016 per mean of the innovations and more. So do random forces that a controller sees
// (0.3 of slow ones, 0.025 of fast ones): of these news of its force predict as much, or the sign of its
// answer tells. By the sign alone masses on springs left 0.026 and more, the elastic ends of a play 0.013.
constexpr double kLeastPerMean = 0.012;
constexpr double kLeastBySign = 0.018;

bool is_enough(const Ringing& ringing, double per_mean, double unnamed) {
  return ringing.deviance > std::max({kLeastUnnamed, per_mean * ringing.means, unnamed});
}

/// A controller that sees the machine's state itself answers to random forces before the sensors show them,
/// so that its force, and what that sets swinging, predicts them. A force that moves what it drives more than
/// all of its mass lets it is no answer: the rest hangs on a spring.
bool answers(const InputNews& news) { return news.answer > 0.0; }

/// Does what is new in the answer predict as much (0.98 of it and more; behind swinging parts 0.45 at most)?
bool is_told_by(const InputNews& news, const AxisFit& fit, double deviance_without, double ringing_deviance) {
  constexpr double kMoreThanNews = 1.5;
  AxisFit told = fit;
  const double of_news = deviance_without - told.refit_beside_lasting_noise(Memory::kLong, &news);
  return ringing_deviance < kMoreThanNews * of_news;
}

Ringing slow_ringing_beyond(double unnamed, const AxisFit& fit) {
  if (!is_enough(ringing_of(fit), kLeastPerMean, unnamed)) return {};
  AxisFit unbent = fit;
  const double deviance = unbent.refit_beside_lasting_noise(Memory::kLong);
  const Ringing ringing = ringing_of(unbent);
  if (!is_enough(ringing, kLeastPerMean, unnamed)) return {};
  const InputNews news = input_news(fit.axis(), fit.signals(), fit.model());
  if (!is_told_by(news, fit, deviance, ringing.deviance)) return ringing;
  return is_enough(ringing, kLeastBySign, unnamed) && !answers(news) ? ringing : Ringing{};
}

/// What rings fast hides in random forces, or is left.
Ringing fast_ringing_beyond(double unnamed, const AxisFit& fit) {
  if (!needs_random_forces(fit) && leaves_noise(fit)) return {};
  const Ringing ringing = ringing_of(fit, kFastRinging);
  if (!is_enough(ringing, kLeastBySign, unnamed)) return {};
  return answers(input_news(fit.axis(), fit.signals(), fit.model())) ? Ringing{} : ringing;
}

}  // namespace

Ringing ringing_beyond(double unnamed, const AxisFit& fit) {
  const Ringing slow = slow_ringing_beyond(unnamed, fit);
  const Ringing fast = fast_ringing_beyond(std::max(unnamed, slow.deviance), fit);
  return fast.deviance > 0.0 ? fast : slow;
}

}  // namespace morepro::host
