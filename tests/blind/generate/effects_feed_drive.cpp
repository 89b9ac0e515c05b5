#include <cmath>

#include "effect_parts.hpp"

namespace blind {
namespace {

std::unique_ptr<Effect> offset(Random& random, const Machine&) {
  const double sign = random.sign(), ripple = random.uniform(0.0, 0.04), rate = random.uniform(0.3, 1.0);
  return instant([=](const Point& p, double s, Loads& l) {
    l.force_n += sign * s * (1.0 + ripple * std::sin(rate * p.t));
  });
}

std::unique_ptr<Effect> screw(Random& random, const Machine& m) {
  const double phase = random.uniform(0.0, 6.28), second = random.uniform(0.15, 0.4),
               turn = 6.283185307 / m.screw_pitch;
  return instant([=](const Point& p, double s, Loads& l) {
    const double a = turn * p.x + phase;
    l.force_n += s * (std::sin(a) + second * std::sin(2.0 * a + 1.1));
  });
}

std::unique_ptr<Effect> spring(Random& random, const Machine&) {
  const double hardening = random.uniform(0.05, 0.25);
  return instant([hardening](const Point& p, double s, Loads& l) {
    l.force_n -= s * p.x * (1.0 + hardening * std::pow(p.x / 0.1, 2));
  });
}

std::unique_ptr<Effect> saturation(Random& random, const Machine&) {
  const double power = random.uniform(1.8, 2.4);
  return instant([power](const Point& p, double s, Loads& l) {
    l.applied_force_n /= 1.0 + std::pow(std::sqrt(s) * std::abs(p.in.force_n), power);
  });
}

std::unique_ptr<Effect> lag(Random&, const Machine&) {
  return std::make_unique<Lag>(&Inputs::force_n, &Loads::applied_force_n);
}

// Drive side and table, with play between them; speed and position are the drive side's.
std::unique_ptr<Effect> backlash(Random& random, const Machine& m) {
  const double table_share = random.uniform(0.4, 0.6), table = table_share * m.mass;
  const double reduced = table * (1.0 - table_share), stiffness = reduced * std::pow(6000.0, 2);
  auto push = [=](double v, double s, const double* z) {
    const double gap = 0.5 * s, squeeze = std::abs(z[0]) - gap;
    if (squeeze <= 0.0) return 0.0;
    return std::copysign(stiffness * squeeze, z[0]) + 0.8 * std::sqrt(stiffness * reduced) * (v - z[1]);
  };
  return dynamic<2>(
      [=](const Point& p, double s, const double* z, double* dz) {
        const Machine& now = p.machine;
        const double cut = p.in.contact * (now.contact_force * p.in.engagement + now.contact_offset);
        dz[0] = p.v - z[1];
        dz[1] = (push(p.v, s, z) - now.feed_viscous * z[1] - cut) / table;
      },
      [=](const Point& p, double s, const double* z, Loads& l) {
        l.mass *= 1.0 - table_share;
        l.feed_contact = 0.0;
        l.feed_viscous = 0.0;
        l.force_n -= push(p.v, s, z);
      });
}

}  // namespace

std::vector<EffectKind> feed_drive_effects() {
  auto spring_guess = [](const Machine& m) { return force_scale(m) / 0.1; };
  auto saturation_guess = [](const Machine& m) { return 0.02 / std::pow(20.0 + 0.1 * m.feed_viscous, 2); };
  auto lag_guess = [](const Machine&) { return 5e-4; };
  auto gap_guess = [](const Machine&) { return 2e-5; };
  return {
      {"feed_force_offset", kFeedForce, "N", force_scale, offset},
      {"feed_screw_periodic", kFeedForce, "N", force_scale, screw},
      {"feed_spring", kFeedForce, "N/m", spring_guess, spring},
      {"feed_force_saturation", kFeedForce, "1/N2", saturation_guess, saturation, 100.0},
      {"feed_drive_lag", kFeedForce, "s", lag_guess, lag, 20.0, false, false},
      {"feed_backlash", kFeedForce, "m", gap_guess, backlash, 50.0, false, false},
  };
}

}  // namespace blind
