#include "conditions.hpp"

#include <algorithm>

#include "random.hpp"

namespace blind {

Conditions conditions_of(const TrialSpec& spec) {
  Conditions c;
  c.duration_s = spec.duration_s;
  if (!spec.is_varied) return c;
  static constexpr double kSamples_s[] = {5e-4, 2e-4, 1e-4, 5e-5};
  constexpr double kMostRows = 2e5;
  Random random(spec.seed, 2);
  c.sample_s = kSamples_s[random.pick(4)];
  c.duration_s = std::min(random.log_uniform(6.0, 30.0), kMostRows * c.sample_s);
  c.loudness = random.log_uniform(0.3, 3.0);
  c.controllers_see_state = random.chance(0.5);
  c.is_white = random.chance(0.4);
  return c;
}

}  // namespace blind
