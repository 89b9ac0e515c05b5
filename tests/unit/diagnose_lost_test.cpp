// What comes back, and passes for random forces where an observer may follow it: a model that runs free is
// lost.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "sim_host/diagnose/balances/share_closed.hpp"
#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

host::ModelError error(double value, double low, double high) {
  return {.value = value, .interval90 = {low, high}};
}

/// Of a datasheet's model that is off by 0.20, 0.19 .. 0.21.
host::ModelComparison beside(const host::ModelError& refit, double noise_floor) {
  host::ModelComparison models;
  models.datasheet = error(0.20, 0.19, 0.21);
  models.refit = refit;
  models.noise_floor = noise_floor;
  return models;
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(LostModel, IsFarBeyondRandomForcesOrBehindTheDatasheet) {
  EXPECT_TRUE(host::is_lost(beside(error(0.10, 0.09, 0.11), 0.02)));
  EXPECT_TRUE(host::is_lost(beside(error(0.29, 0.27, 0.31), 0.25)));
  EXPECT_TRUE(host::is_lost(beside(error(kUnknown, kUnknown, kUnknown), 0.25))) << "it diverges";
}

TEST(LostModel, IsNoneThatRandomForcesMayMake) {
  EXPECT_FALSE(host::is_lost(beside(error(0.10, 0.07, 0.11), 0.02))) << "it may be less than 4 times";
  EXPECT_FALSE(host::is_lost(beside(error(0.26, 0.22, 0.31), 0.25))) << "it may be the datasheet's";
  EXPECT_FALSE(host::is_lost(beside(error(0.90, kUnknown, kUnknown), 0.02))) << "nobody knows how far";
  EXPECT_FALSE(host::is_lost(std::nullopt)) << "nothing was compared";
}

/// A slide of 60 kg with good sensors.
MonitorConfiguration heavy(MonitorConfiguration configuration) {
  configuration.machine.feed.mass_kg *= 20.0;
  configuration.sensors[Channel::kFeedSpeed] = {.noise = 2.0e-4F, .lsb = 2.0e-5F};
  configuration.sensors[Channel::kFeedPosition] = {.noise = 2.0e-6F, .lsb = 1.0e-6F};
  return configuration;
}

/// Along 0.6 m and back, at 0.3 m/s and then at half of it.
double strokes_m(double time_s) {
  constexpr double kStrokeM = 0.6;
  const double way_m = 0.15 * time_s + 0.15 * std::min(time_s, 4.4);
  const double back_and_forth_m = std::fmod(way_m, 2.0 * kStrokeM);
  return std::min(back_and_forth_m, 2.0 * kStrokeM - back_and_forth_m);
}

/// The feed's balance is the only one. `viscosity_at`: as in DrivenAxis.
DiagnosisResult diagnosed_on(const std::function<double(double)>& viscosity_at) {
  DrivenAxis axis{.rate_hz = 1000.0, .rows = 10000, .position_noise_m = 2.0e-6, .wanted_m = strokes_m};
  axis.configuration = heavy(axis.configuration);
  axis.viscosity_at = viscosity_at;
  MachineDescription sheet = datasheet(0.05);
  sheet.configuration = heavy(sheet.configuration);
  return diagnosed(record(axis), sheet);
}

/// Tighter and looser in turn, every `period_m` of the way.
std::function<double(double)> wavy(double period_m) {
  return [=](double m) { return 1.0 + 0.4 * std::cos(2.0 * std::numbers::pi * m / period_m); };
}

// A guide that is tight here and loose there was "no_gap" or a wrong datasheet, with residual ratios
// of 1.000. What comes back within 0.2 m no function over a place follows.
TEST(LostModel, IsOfAGuideThatIsTighterHereThanThere) {
  const auto result = diagnosed_on(wavy(0.2));
  EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  EXPECT_THAT(result.explanation, testing::HasSubstr("runs free is lost in feed_force"));
  EXPECT_TRUE(result.has_place());
  EXPECT_EQ(result.unexplained_share, 1.0);
}

// Every 0.3 m a function with the side of the speed in each place does.
TEST(LostModel, IsNotNeededWhereThePlacesTell) {
  const auto result = diagnosed_on(wavy(0.3));
  EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  ASSERT_FALSE(result.unexplained_follows.empty());
  EXPECT_THAT(result.unexplained_follows.front().signal,
              testing::StartsWith("the sign of the feed speed near "));
}

TEST(LostModel, IsNotOfAGuideThatIsTheSameEverywhere) {
  const auto result = diagnosed_on([](double) { return 1.2; });
  EXPECT_EQ(result.verdict, host::Verdict::kParameterError) << said(result);
}

// Random forces that act only while an axis moves were a clock that shakes, a Stribeck curve and a delay, at
// 97 and 98 %, with nothing of the gap closed.
TEST(NothingClosed, IsNoEffectBesideAClockThatShakes) {
  const auto moves = [](double time_s) { return std::fmod(time_s, 20.0) < 10.0; };
  DrivenAxis axis{.rate_hz = 500.0, .rows = 30000, .random_force_n = 20.0};
  axis.random_share = [=](double time_s) { return moves(time_s) ? 1.0 : 0.0; };
  axis.wanted_m = [=](double time_s) {
    return moves(time_s) ? 0.02 * std::sin(4.4 * time_s) + 0.004 * std::sin(33.3 * time_s) : 0.0;
  };
  MachineDescription sheet = datasheet(0.05);
  sheet.has_spindle = false;
  sheet.configuration.sensors[Channel::kFeedPosition].noise = axis.position_noise_m;
  const auto result = diagnosed(record(axis), sheet);
  EXPECT_NE(result.verdict, host::Verdict::kEffect) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
