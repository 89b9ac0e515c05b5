#include <cmath>

#include "effect_parts.hpp"

namespace blind {
namespace {

// A bristle that bends up to `length`: elastic first, then sliding.
double bend_rate(double speed, double bend, double length) {
  return (speed - std::abs(speed) * bend) / length;
}

std::unique_ptr<Effect> coulomb_force(Random& random, const Machine&) {
  if (random.chance(0.5)) {
    const double scale = random.uniform(0.0005, 0.002);
    return instant([scale](const Point& p, double s, Loads& l) { l.force_n -= s * soft_sign(p.v, scale); });
  }
  const double length = random.uniform(5e-6, 2e-5);
  return dynamic<1>(
      [length](const Point& p, double, const double* z, double* dz) { dz[0] = bend_rate(p.v, z[0], length); },
      [](const Point&, double s, const double* z, Loads& l) { l.force_n -= s * z[0]; });
}

std::unique_ptr<Effect> viscous(Random& random, const Machine&) {
  const double power = random.uniform(0.95, 1.05);
  return instant([power](const Point& p, double s, Loads& l) {
    l.force_n -= s * 0.1 * std::copysign(std::pow(std::abs(p.v) / 0.1, power), p.v);
  });
}

std::unique_ptr<Effect> stribeck_force(Random& random, const Machine&) {
  const double speed = random.uniform(0.01, 0.03), power = random.uniform(0.5, 1.5);
  return instant([=](const Point& p, double s, Loads& l) {
    l.force_n -= s * soft_sign(p.v, 0.001) * std::exp(-std::pow(std::abs(p.v) / speed, power));
  });
}

std::unique_ptr<Effect> asymmetric(Random& random, const Machine&) {
  const double share = random.uniform(0.5, 0.9), power = random.uniform(0.85, 1.15), sign = random.sign();
  return instant([=](const Point& p, double s, Loads& l) {
    const double viscous_part = std::pow(std::abs(p.v) / 0.1, power),
                 dry_part = std::abs(soft_sign(p.v, 0.001));
    l.force_n -= sign * s * (share * viscous_part + (1.0 - share) * dry_part);
  });
}

std::unique_ptr<Effect> presliding(Random& random, const Machine&) {
  const double short_m = random.uniform(3e-5, 8e-5), long_m = random.uniform(1.5e-4, 4e-4);
  return dynamic<2>(
      [=](const Point& p, double, const double* z, double* dz) {
        dz[0] = bend_rate(p.v, z[0], short_m);
        dz[1] = bend_rate(p.v, z[1], long_m);
      },
      [](const Point&, double s, const double* z, Loads& l) { l.force_n -= s * (0.5 * z[0] + 0.5 * z[1]); });
}

}  // namespace

std::vector<EffectKind> feed_friction_effects() {
  auto viscous_guess = [](const Machine&) { return 50.0; };
  return {
      {"feed_coulomb_friction", kFeedForce, "N", force_scale, coulomb_force},
      {"feed_viscous_friction", kFeedForce, "N s/m", viscous_guess, viscous, 20.0, false, false},
      {"feed_stribeck_friction", kFeedForce, "N", force_scale, stribeck_force},
      {"feed_asymmetric_friction", kFeedForce, "N", force_scale, asymmetric},
      {"feed_presliding", kFeedForce, "N", force_scale, presliding},
  };
}

}  // namespace blind
