#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "lib/gap/sample_watch.hpp"

namespace morepro::sample_watch_test {
namespace {

using gap::Effect;
using gap::EffectGroup;
using gap::GapFinding;
using gap::GapVerdict;

using Watch = gap::SampleWatch<float>;
using Frame = gap::GapFrame<float>;

constexpr gap::SampleLimits kLimits{.speed_step_rad_s = 1.5F,
                                    .current_step_a = 0.08F,
                                    .feed_step_m_s = 0.003F,
                                    .position_step_m = 0.0F,
                                    .lost_share = 0.001F};

double in_steps(double value, double step) { return step > 0.0 ? step * std::round(value / step) : value; }

/// A machine that turns at 300 rad/s, with noise of 1 rad/s, 0.05 A and 2 mm/s, and what its samples are made
/// of.
struct Samples {
  double speed_step_rad_s = 0.0;
  double noise = 1.0;         ///< as a factor
  double coarse_steps = 0.0;  ///< of current and feed speed, over their noise
  int repeated_every = 0;
  int speed_repeated_every = 0;
  int rest = 0;  ///< so many frames in the middle
  int lost_every = 0;
  int frames = 3000;
};

void show(const Samples& samples, Watch& watch, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Frame before;
  Frame earlier;
  for (int i = 0; i < samples.frames; ++i) {
    watch.count(1);
    if (samples.lost_every > 0 && i % samples.lost_every == 0) watch.lose(1);
    Frame frame;
    frame.has_speed = frame.has_current = frame.has_feed_speed = true;
    frame.speed_rad_s =
        static_cast<float>(in_steps(300.0 + samples.noise * normal(random), samples.speed_step_rad_s));
    const auto sampled = [&](double value, double noise) {
      return static_cast<float>(
          in_steps(value + noise * samples.noise * normal(random), samples.coarse_steps * noise));
    };
    frame.current_a = sampled(5.0, 0.05);
    frame.feed_speed_m_s = sampled(0.02, 0.002);
    const bool is_speed_repeated = samples.speed_repeated_every > 0 && i % samples.speed_repeated_every == 0;
    if (is_speed_repeated && i > 0) frame.speed_rad_s = before.speed_rad_s;
    const bool is_repeated = samples.repeated_every > 0 && i % samples.repeated_every == 0 && i > 0;
    const int middle = samples.frames / 2;
    if (is_repeated || (i >= middle && i < middle + samples.rest)) frame = before;
    if (i > 1) watch.see(frame, before, earlier);
    earlier = std::exchange(before, frame);
  }
  watch.end();
}

GapFinding after(const Samples& samples) {
  Watch watch(kLimits);
  show(samples, watch);
  return watch.finding();
}

TEST(SampleWatch, FindsNothingInSoundSamples) {
  EXPECT_EQ(after({}).verdict, GapVerdict::kNotEnoughData);
  EXPECT_EQ(Watch(kLimits).finding().verdict, GapVerdict::kNotEnoughData);
}

TEST(SampleWatch, FindsStepsThatAreCoarserThanTheSensors) {
  const GapFinding found = after({.speed_step_rad_s = 3.0});
  EXPECT_EQ(found.verdict, GapVerdict::kEffect);
  EXPECT_EQ(found.effect, Effect::kSensorQuantization);
  EXPECT_EQ(found.where, EffectGroup::kSensor);
  EXPECT_EQ(after({.speed_step_rad_s = 1.0}).verdict, GapVerdict::kNotEnoughData);
}

/// A position far away, of which a float shows the noise in a few steps.
TEST(SampleWatch, TheStepsOfAFloatAreNotTheSensors) {
  gap::StepWatch<float> steps;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  float before = 0.3F;
  float earlier = 0.3F;
  for (int i = 0; i < 3000; ++i) {
    const auto position_m = static_cast<float>(0.3 + 3.0e-7 * normal(random));
    steps.see(position_m, before, earlier);
    earlier = std::exchange(before, position_m);
  }
  EXPECT_EQ(steps.step(), 0.0F);
}

/// Seven digits of multiples of a step that is none of theirs, with zero among them.
TEST(SampleWatch, StepsAreFoundInRoundedNumbers) {
  gap::StepWatch<float> steps;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  constexpr double kStep = 0.38568714;
  std::array<float, 3> last{};
  for (int i = 0; i < 3000; ++i) {
    const double value = 4.0 * std::sin(0.01 * i) + 0.2 * normal(random);
    last = {static_cast<float>(1.0e-7 * std::round(1.0e7 * in_steps(value, kStep))), last[0], last[1]};
    if (i > 1) steps.see(last[0], last[1], last[2]);
  }
  EXPECT_NEAR(steps.step(), kStep, 1.0e-5);
}

/// From frame to frame it changes by the same, but for its noise.
TEST(SampleWatch, APositionThatMovesEvenlyIsNotInSteps) {
  gap::StepWatch<float> steps;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::array<float, 3> last{};
  for (int i = 0; i < 3000; ++i) {
    last = {static_cast<float>(2.0e-5 * i + 3.0e-7 * normal(random)), last[0], last[1]};
    if (i > 1) steps.see(last[0], last[1], last[2]);
  }
  EXPECT_EQ(steps.step(), 0.0F);
}

TEST(SampleWatch, LooksForNothingThatNobodyAskedFor) {
  Watch watch({});
  show({.speed_step_rad_s = 3.0, .lost_every = 10}, watch);
  EXPECT_EQ(watch.finding().verdict, GapVerdict::kNotEnoughData);
}

TEST(SampleWatch, SeesThatASensorBecomesCoarseAndFineAgain) {
  Watch watch(kLimits);
  show({}, watch);
  show({.speed_step_rad_s = 3.0}, watch, 2);
  EXPECT_EQ(watch.finding().effect, Effect::kSensorQuantization);
  show({}, watch, 3);
  EXPECT_EQ(watch.finding().verdict, GapVerdict::kNotEnoughData);
}

TEST(SampleWatch, CountsLostFrames) {
  const GapFinding found = after({.lost_every = 500});
  EXPECT_EQ(found.verdict, GapVerdict::kEffect);
  EXPECT_EQ(found.effect, Effect::kSampleDropout);
  EXPECT_EQ(found.where, EffectGroup::kSampling);
  EXPECT_EQ(after({.lost_every = 2000}).verdict, GapVerdict::kNotEnoughData);
}

TEST(SampleWatch, AFrameThatShowsTheOneBeforeOnceMoreIsLost) {
  EXPECT_EQ(after({.repeated_every = 100}).effect, Effect::kSampleDropout);
}

constexpr gap::SampleLimits kOfCoarseSensors{.speed_step_rad_s = 1.5F, .lost_share = 0.001F};

GapVerdict verdict_beside_coarse_sensors(Samples samples) {
  samples.coarse_steps = 1.75;
  samples.frames = 20000;
  Watch watch(kOfCoarseSensors);
  show(samples, watch);
  return watch.finding().verdict;
}

TEST(SampleWatch, CoarseSensorsVouchForTheOnlyFineOne) {
  EXPECT_EQ(verdict_beside_coarse_sensors({.repeated_every = 100}), GapVerdict::kEffect);
  EXPECT_EQ(verdict_beside_coarse_sensors({}), GapVerdict::kNotEnoughData);
  // It stands still by itself: of the coarse ones both are the same in one of six frames.
  EXPECT_EQ(verdict_beside_coarse_sensors({.speed_repeated_every = 100}), GapVerdict::kNotEnoughData);
  // All stand still for a while.
  EXPECT_EQ(verdict_beside_coarse_sensors({.rest = 2000}), GapVerdict::kNotEnoughData);
  // Where these rest they vouch for nothing.
  Watch watch(kOfCoarseSensors);
  show({.coarse_steps = 100.0, .repeated_every = 100, .frames = 20000}, watch);
  EXPECT_EQ(watch.finding().verdict, GapVerdict::kNotEnoughData);
}

TEST(SampleWatch, RepeatedFramesMerge) {
  constexpr Samples kFewLost{.coarse_steps = 1.75, .repeated_every = 100, .frames = 450};
  Watch one(kOfCoarseSensors);
  show(kFewLost, one);
  Watch other(kOfCoarseSensors);
  show(kFewLost, other, 2);
  ASSERT_EQ(one.finding().verdict, GapVerdict::kNotEnoughData);
  one.merge(other);
  EXPECT_EQ(one.finding().effect, Effect::kSampleDropout);
}

// As most sensors are: all in steps as coarse as their noise. Each is the same in 28 of 100 frames, all three
// in two.
TEST(SampleWatch, SeesRepeatedFramesOfSensorsThatAllHaveSteps) {
  constexpr Samples kInSteps{.speed_step_rad_s = 1.0, .coarse_steps = 1.0, .frames = 20000};
  EXPECT_EQ(after(kInSteps).verdict, GapVerdict::kNotEnoughData);
  Samples repeated = kInSteps;
  repeated.repeated_every = 20;
  EXPECT_EQ(after(repeated).effect, Effect::kSampleDropout);
}

/// After 20000 frames: `shown(i, before, noise)` with noise of one.
template <class Shown>
GapVerdict verdict_after(Shown shown) {
  Watch watch({.lost_share = 0.001F});
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::array<Frame, 3> last{};
  for (int i = 0; i < 20000; ++i) {
    last = {shown(i, last[0], [&] { return normal(random); }), last[0], last[1]};
    watch.count(1);
    if (i > 1) watch.see(last[0], last[1], last[2]);
  }
  watch.end();
  return watch.finding().verdict;
}

// Of steps that are three times their noise sensors at rest are the same in six of ten frames; where the
// machine rests for 100 frames between two jogs, its edges would look like lost frames.
TEST(SampleWatch, SeesNoneAtTheEdgesOfARestOfCoarseSensors) {
  double place = 0.0;
  const auto shown = [&place](int i, const Frame&, auto noise) {
    if (i / 100 % 2 == 0) place = std::fmod(place + 5.0, 10000.0);
    Frame frame;
    frame.has_speed = frame.has_current = true;
    frame.speed_rad_s = static_cast<float>(std::round(place + 0.33 * noise()));
    frame.current_a = static_cast<float>(std::round(place + 0.33 * noise()));
    return frame;
  };
  EXPECT_EQ(verdict_after(shown), GapVerdict::kNotEnoughData);
}

// What is the same twice in a position is no speed, and then none again. Where it steps every third frame
// that is one frame in three, and none of the two is ever the same alone.
TEST(SampleWatch, SeesNoRepeatedFramesInAPositionAndItsDifference) {
  for (const double frames_per_step : {0.01, 2.5, 3.0, 3.5, 20.0}) {
    const auto shown = [frames_per_step](int i, const Frame& before, auto noise) {
      Frame frame;
      frame.has_feed_speed = frame.has_feed_position = true;
      const double way = 2000.0 * std::sin(0.0005 * i / frames_per_step) + 0.2 * noise();
      frame.feed_position_m = static_cast<float>(std::round(way));
      frame.feed_speed_m_s = frame.feed_position_m - before.feed_position_m;
      return frame;
    };
    EXPECT_EQ(verdict_after(shown), GapVerdict::kNotEnoughData) << frames_per_step << " frames per step";
  }
}

/// Sensors that rest, or have coarse steps, are the same from frame to frame without anything lost.
TEST(SampleWatch, SensorsAtRestRepeatNothing) {
  EXPECT_EQ(after({.noise = 0.0}).verdict, GapVerdict::kNotEnoughData);
}

TEST(SampleWatch, MergesInAnyOrder) {
  Watch coarse(kLimits);
  show({.speed_step_rad_s = 3.0}, coarse);
  Watch losing(kLimits);
  show({.lost_every = 300}, losing, 2);
  Watch one = coarse;
  one.merge(losing);
  Watch other = losing;
  other.merge(coarse);
  EXPECT_EQ(one.finding().effect, Effect::kSensorQuantization);
  EXPECT_EQ(other.finding().effect, Effect::kSensorQuantization);
  Watch sound(kLimits);
  show({}, sound, 3);
  losing.merge(sound);
  EXPECT_EQ(losing.finding().effect, Effect::kSampleDropout);
}

}  // namespace
}  // namespace morepro::sample_watch_test
