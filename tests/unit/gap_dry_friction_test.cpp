#include <gtest/gtest.h>

#include <cmath>

#include "lib/gap/dry_friction.hpp"
#include "lib/math/matrix_exponential.hpp"

namespace morepro::gap {
namespace {

constexpr double kWidth = 0.2;

/// dx/dt = -loss tanh(x / width) over a time of one, in small steps of fourth order.
double integrated(double x, double loss) {
  constexpr int kSteps = 20000;
  const auto rate = [loss](double value) { return -loss * std::tanh(value / kWidth); };
  const double h = 1.0 / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double a = rate(x);
    const double b = rate(x + 0.5 * h * a);
    const double c = rate(x + 0.5 * h * b);
    x += h / 6.0 * (a + 2.0 * b + 2.0 * c + rate(x + h * c));
  }
  return x;
}

TEST(DryFriction, IsTheSolutionOfItsEquation) {
  for (const double start : {-9.0, -1.0, -0.1, 0.0, 0.05, 0.5, 3.0, 9.0})
    for (const double loss : {0.0, 0.1, 1.0, 2.9})
      EXPECT_NEAR(friction_step(start, kWidth, loss).value, integrated(start, loss), 1.0e-9)
          << start << " " << loss;
}

TEST(DryFriction, KnowsWhatIsLeftOfASmallDifference) {
  constexpr double kStep = 1.0e-5;
  for (const double start : {-1.0, -0.1, 0.02, 0.5, 3.0})
    for (const double loss : {0.1, 1.0, 2.9}) {
      const double difference =
          friction_step(start + kStep, kWidth, loss).value - friction_step(start - kStep, kWidth, loss).value;
      EXPECT_NEAR(friction_step(start, kWidth, loss).slope, difference / (2.0 * kStep), 1.0e-6)
          << start << " " << loss;
    }
}

// A filter knows its state only so well: what friction does on average is what counts for its mean.
TEST(DryFriction, OfAnUncertainStateIsItsAverage) {
  constexpr double kLoss = 1.0e-3;  // small: the average changes little meanwhile
  for (const double deviation : {0.05, 0.2, 1.0})
    for (const double mean : {0.03, 0.2, 0.9}) {
      double average = 0.0;
      double weights = 0.0;
      for (double z = -6.0; z <= 6.0; z += 0.01) {
        const double weight = std::exp(-0.5 * z * z);
        average += weight * std::tanh((mean + deviation * z) / kWidth);
        weights += weight;
      }
      average /= weights;
      const double width = blurred(kWidth, deviation * deviation);
      const double loss = mean - friction_step(mean, width, kLoss).value;
      // tanh and the error function with the same slope differ by 0.04 at most.
      EXPECT_NEAR(loss / kLoss, average, 0.04) << mean << " +- " << deviation;
      EXPECT_GT(std::fabs(std::tanh(mean / kWidth) - average), deviation > kWidth ? 0.1 : 0.0);
    }
}

/// x after a step in which `drive` moves it and friction takes `loss` at most, in small steps.
double driven(double x, double drive, double loss) {
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = x + 0.5 / kSteps * (drive - loss * std::tanh(x / kWidth));
    x += (drive - loss * std::tanh(middle / kWidth)) / kSteps;
  }
  return x;
}

/// The same in two halves around the drive.
FrictionStep<double> halved(double x, double drive, double loss, bool sees_the_turn) {
  auto first = friction_step(x, kWidth, 0.5 * loss);
  const double free = first.value + drive;
  const auto last = friction_step(free, kWidth, 0.5 * loss);
  const auto all = sees_the_turn ? around_a_turn(x, first, free, last, Rubbing<double>(0.5)) : last;
  return {all.value, first.slope * all.slope};
}

// Where a state is driven through zero halves are wrong by up to half of the friction, and systematically:
// brushes of 1 V came back 0.8 % too large and their resistance twelve standard errors off.
TEST(DryFriction, ActsOnEachSideForAsLongAsTheStateIsThere) {
  for (const double start : {0.3, 1.0, 4.0, 7.0, 9.0, 9.6})
    for (const double side : {1.0, -1.0}) {
      const double truth = driven(side * start, side * -10.0, 1.0);
      const double turned = halved(side * start, side * -10.0, 1.0, true).value;
      EXPECT_NEAR(turned, truth, 0.04) << start;
      EXPECT_LE(std::abs(turned - truth),
                std::abs(halved(side * start, side * -10.0, 1.0, false).value - truth) + 0.01);
    }
  EXPECT_NEAR(halved(1.0, -10.0, 1.0, true).slope, 1.0, 1.0e-12) << "driven through, a difference stays";
}

// A current that forgets nine tenths of itself in a step and is driven through zero by a voltage, of which
// brushes take a tenth; in small steps, against one. A twentieth of what they take: their side is not all
// that sharp.
TEST(DryFriction, KnowsHowMuchIsForgottenSinceATurn) {
  constexpr double kForgets = 2.3, kDrive = -100.0, kLoad = 10.0;
  const double kept = std::exp(-kForgets), own = (1.0 - kept) / kForgets;
  const Rubbing<double> rubbing(own, kept, 0.0, 0.0, 1.0);
  for (const double start : {4.0, 10.0, 30.0, 60.0}) {
    double truth = start;
    constexpr int kSteps = 200000;
    const auto rate = [](double x) { return kDrive - kForgets * x - kLoad * std::tanh(x / kWidth); };
    for (int i = 0; i < kSteps; ++i) truth += rate(truth + 0.5 / kSteps * rate(truth)) / kSteps;
    auto first = friction_step(start, kWidth, kLoad * rubbing.before);
    const double free = kept * first.value + own * kDrive;
    const auto last = friction_step(free, kWidth, kLoad * rubbing.after);
    EXPECT_NEAR(around_a_turn(start, first, free, last, rubbing).value, truth, 0.05 * kLoad * own) << start;
  }
}

TEST(Rubbing, KnowsWhatItTakesWithinAStep) {
  constexpr double kForgets = 1.7;
  const auto taken = [](double share) { return (1.0 - std::exp(-kForgets * share)) / kForgets; };
  const Rubbing<double> rubbing(taken(1.0), std::exp(-kForgets), 0.0, 0.0, 2.0);
  for (double share = 0.0; share <= 1.0; share += 0.1)
    EXPECT_NEAR(rubbing.during_last(share), 0.5 * taken(share), 1.0e-12) << share;
  for (double share = 0.0; share <= 1.0; share += 0.1)
    EXPECT_NEAR(rubbing.time_of(taken(share) / taken(1.0)), share, 1.0e-12);
  const Rubbing<double> halves(0.3);
  for (double share = 0.0; share <= 1.0; share += 0.1)
    EXPECT_NEAR(halves.during_last(share), 0.6 * share, 1.0e-12);
}

TEST(DryFriction, HalvesStayWhereNothingTurnsOrFrictionHolds) {
  for (const double start : {-3.0, -0.2, 0.1, 0.5, 4.0})
    for (const double drive : {-0.9, -0.3, 0.0, 0.4, 0.9}) {
      const auto seen = halved(start, drive, 1.0, true), plain = halved(start, drive, 1.0, false);
      if (start * (start + drive) >= 0.0) {
        EXPECT_EQ(seen.value, plain.value) << start << " " << drive;
      }
      EXPECT_NEAR(seen.value, driven(start, drive, 1.0), 0.3) << start << " " << drive;
    }
}

/// Friction of 2 and, of its second part, -0.7, within a range of 0.5; a reference speed of one.
DryFriction<double> curve(double size = 2.0, double bend = -0.7) {
  return {{.effect = Effect::kFeedStribeckFriction, .parts = 2, .shape = 0.5F}, size, bend};
}
double after(const DryFriction<double>& friction, double speed) {
  EffectScales<double> scales;
  scales.feed_speed_m_s = 1.0;
  return friction.step(speed, {.state = BrakedState::kFeedSpeed, .yield = 0.1, .variance = 1.0e-4}, scales)
      .value;
}

// What falls with the speed lets differences grow; an observer that does not know that trusts itself too
// much, and no parameter beside it is right.
TEST(DryFriction, ThatFallsWithTheSpeedKnowsItsDerivatives) {
  constexpr double kStep = 1.0e-6;
  EffectScales<double> scales;
  scales.feed_speed_m_s = 1.0;
  for (const double speed : {-1.2, -0.3, -0.02, 0.004, 0.1, 0.45, 0.9}) {
    const auto one =
        curve().step(speed, {.state = BrakedState::kFeedSpeed, .yield = 0.1, .variance = 1.0e-4}, scales);
    const auto slope = [&](const auto& more, const auto& less) { return (more - less) / (2.0 * kStep); };
    EXPECT_NEAR(one.slope, slope(after(curve(), speed + kStep), after(curve(), speed - kStep)), 1.0e-6)
        << speed;
    EXPECT_NEAR(one.by_part[0], slope(after(curve(2.0 + kStep), speed), after(curve(2.0 - kStep), speed)),
                1.0e-6)
        << speed;
    EXPECT_NEAR(one.by_part[1],
                slope(after(curve(2.0, -0.7 + kStep), speed), after(curve(2.0, -0.7 - kStep), speed)), 1.0e-6)
        << speed;
  }
  EXPECT_GT(curve().step(0.3, {.yield = 0.1}, scales).slope, 1.0);
}

// The same law as in the closed form, and its derivatives: by the state, and by each of its sizes.
TEST(ActingFriction, KnowsItsDerivatives) {
  constexpr double kStep = 1.0e-6;
  EffectScales<double> scales;
  scales.feed_speed_m_s = 1.0;
  const Braking<double> on{.state = BrakedState::kFeedSpeed, .yield = 0.3, .variance = 1.0e-4};
  const DryFriction<double> plain{{.effect = Effect::kFeedCoulombFriction, .shape = 0.05F}, 2.0};
  for (const auto& friction : {curve(), plain})
    for (const double speed : {-1.2, -0.3, -0.02, 0.004, 0.1, 0.45, 0.9}) {
      const auto rate = [&](double v, double more_size, double more_bend) {
        const DryFriction<double> other{friction.form, friction.size + more_size, friction.bend + more_bend};
        return other.acting(on, scales).at(v).rate;
      };
      const FrictionAt<double> at = friction.acting(on, scales).at(speed);
      EXPECT_NEAR(at.slope, (rate(speed + kStep, 0, 0) - rate(speed - kStep, 0, 0)) / (2.0 * kStep), 1.0e-6);
      EXPECT_NEAR(at.by_part[0], (rate(speed, kStep, 0) - rate(speed, -kStep, 0)) / (2.0 * kStep), 1.0e-8);
      EXPECT_NEAR(at.by_part[1], (rate(speed, 0, kStep) - rate(speed, 0, -kStep)) / (2.0 * kStep), 1.0e-8);
      // Over a step that is too short for anything to change, the closed form takes just as much.
      const Braking<double> short_step{.state = on.state, .yield = 1.0e-9, .variance = on.variance};
      EXPECT_NEAR((friction.step(speed, short_step, scales).value - speed) * on.yield / 1.0e-9, at.rate,
                  1.0e-5);
    }
}

// Of two states that drive each other, over a step as long as the slower one's memory.
TEST(Rubbing, TakesFromBothStatesWhatAFrictionTakesThatDoesNotChange) {
  const math::Matrix2 a{.a00 = -0.4, .a01 = 90.0, .a10 = -70.0, .a11 = -1700.0};
  constexpr double kStepS = 1.0e-3, kInertia = 5.0e-4, kTorque = 0.03;
  const auto [phi, psi] = math::exponential_step(a, kStepS);
  const Rubbing<double> rubbing(psi.a00, phi.a00, psi.a10, phi.a10, kInertia);
  const double before = rubbing.before * kTorque, after = rubbing.after * kTorque;
  EXPECT_NEAR(phi.a00 * before + after, psi.a00 * kTorque / kInertia, 1.0e-12);
  EXPECT_NEAR(phi.a10 * before, psi.a10 * kTorque / kInertia, 1.0e-12);
  EXPECT_GT(std::fabs(rubbing.before - rubbing.after), 0.1 * rubbing.all) << "no two halves";
}

TEST(Rubbing, IsRightInItsOwnStateWhereNothingElseSeesIt) {
  const Rubbing<double> rubbing(0.9, 0.8, 0.0, 0.0, 2.0);
  EXPECT_NEAR(rubbing.before, 0.25, 1.0e-12);
  EXPECT_NEAR(0.8 * rubbing.before + rubbing.after, 0.9 / 2.0, 1.0e-12);
}

// A motor of little inertia swings, and one of much has forgotten its speed after a second: what is left of a
// speed in the current passes zero, and friction would drive, or take a thousand times what it is.
TEST(Rubbing, TakesNeverMoreThanAFrictionHas) {
  for (const double inertia : {1.0e-5, 1.0e-4, 5.0e-4})
    for (double step_s = 1.0e-4; step_s < 2.0; step_s *= 1.1) {
      const math::Matrix2 a{.a00 = -1.0e-4 / inertia, .a01 = 0.1 / inertia, .a10 = -100.0, .a11 = -1700.0};
      const auto [phi, psi] = math::exponential_step(a, step_s);
      const Rubbing<double> rubbing(psi.a00, phi.a00, psi.a10, phi.a10, inertia);
      EXPECT_GE(rubbing.before, 0.0) << inertia << " " << step_s;
      EXPECT_LE(rubbing.before, 1.3 * psi.a00 / inertia) << inertia << " " << step_s;
      EXPECT_NEAR(phi.a00 * rubbing.before + rubbing.after, psi.a00 / inertia, 1.0e-9 * psi.a00 / inertia);
    }
}

TEST(DryFriction, StopsAndDoesNotTurnRoundWhateverItsSize) {
  for (const float loss : {1.0F, 1.0e3F, 1.0e9F}) {
    const auto stuck = friction_step(0.3F, 0.2F, loss);
    EXPECT_GE(stuck.value, 0.0F);
    EXPECT_LE(stuck.value, 0.01F);
    EXPECT_TRUE(std::isfinite(stuck.slope));
  }
}

}  // namespace
}  // namespace morepro::gap
