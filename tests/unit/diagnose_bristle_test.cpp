// Friction as machines have it: bristles that bend before they slide, and are damped while they bend.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

/// Canudas de Wit's friction in the steps of a driven axis, critically damped or nearly so while it sticks.
class Bristles {
 public:
  Bristles(double level_n, double yield_m, double step_s)
      : level_n_(level_n), yield_m_(yield_m), step_s_(step_s) {}

  double operator()(double speed_m_s) {
    const double side = speed_m_s < 0.0 ? -1.0 : 1.0;
    const double before = deflection_;
    deflection_ = side + (before - side) * std::exp(-std::fabs(speed_m_s) * step_s_ / yield_m_);
    return level_n_ * deflection_ + damping() * (deflection_ - before) / step_s_;
  }

 private:
  /// In N per 1/s of the deflection.
  [[nodiscard]] double damping() const {
    const double stiffness_n_m = level_n_ / yield_m_;
    return 0.8 * std::sqrt(stiffness_n_m * reference_configuration().machine.feed.mass_kg) * yield_m_;
  }

  double level_n_;
  double yield_m_;
  double step_s_;
  double deflection_ = 0.0;
};

constexpr double kLevelN = 5.0;

// Without the damping it was Coulomb and Stribeck friction, or "unexplained".
TEST(Bristles, ThatAreDampedAreOneCause) {
  DrivenAxis axis{.rate_hz = 5000.0, .rows = 20000};
  axis.brake_at = Bristles(kLevelN, 5.0e-6, 1.0 / (20 * axis.rate_hz));
  const DiagnosisResult result = diagnosed(record(axis), datasheet(0.1));
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_TRUE(names(result.which.front(), Effect::kFeedPresliding)) << said(result);
  EXPECT_TRUE(names(result.which.front(), Effect::kFeedCoulombFriction)) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, kLevelN, 0.03 * kLevelN);
}

// What friction holds shows in no linearisation: the force promised 13 beside the friction, of 40 that a
// trial takes, and the verdict was "unexplained".
TEST(Bristles, HoldAForceThatIsFoundAllTheSame) {
  constexpr double kForceN = 2.5;
  MachineDescription machine = datasheet(0.1);
  machine.configuration.sensors[Channel::kFeedPosition] = {2.0e-8, 0.0};
  DrivenAxis axis{.rate_hz = 1000.0, .rows = 12000, .has_speed = false, .position_noise_m = 2.0e-8};
  Bristles bristles(kLevelN, 1.0e-4, 1.0 / (20 * axis.rate_hz));
  axis.brake_at = [&bristles](double speed_m_s) { return kForceN + bristles(speed_m_s); };
  const DiagnosisResult result = diagnosed(record(axis), machine);
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 2U) << said(result);
  EXPECT_NEAR(result.which[0].magnitude, kLevelN, 0.03 * kLevelN) << said(result);
  EXPECT_EQ(result.which[1].effect, Effect::kFeedForceOffset) << said(result);
  EXPECT_NEAR(result.which[1].magnitude, kForceN, 0.03 * kForceN) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
