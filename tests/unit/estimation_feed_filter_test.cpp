#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lib/estimation/feed_filter.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/integrators.hpp"

namespace morepro {
namespace {

constexpr double kFeedPeriod_s = 1.0e-4;

PlantInput<double> cutting(double force_n) {
  return {.feed_force_n = force_n, .contact = 1.0, .engagement = 0.7};
}

template <class Real>
FeedInput<Real> held(const PlantInput<double>& u) {
  return {static_cast<Real>(u.feed_force_n), static_cast<Real>(u.contact), static_cast<Real>(u.engagement)};
}

TEST(FeedFilter, PredictsWhatThePlantDoes) {
  for (const auto& machine : {reference_machine(), thesis_machine()}) {
    FeedFilter<double> filter(machine.feed, kFeedPeriod_s, 1.0e-8);
    filter.start({0.0, 0.0, 1.0e-6, 1.0e-12});
    const ExponentialIntegrator<double> plant(machine, kFeedPeriod_s);
    PlantState<double> state{};
    double position_m = 0.0;
    for (int k = 0; k < 2000; ++k) {
      const auto u = cutting(30.0 + 5.0 * std::sin(0.01 * k));
      const double speed_before = state.feed_speed_m_s;
      state = plant.step(state, u);
      position_m += kFeedPeriod_s * 0.5 * (speed_before + state.feed_speed_m_s);
      filter.predict(held<double>(u));
    }
    // The speed is exact; the trapezoid of the position is not: h^2/12 times the change of the acceleration.
    EXPECT_NEAR(filter.speed_m_s(), state.feed_speed_m_s, 1.0e-12);
    EXPECT_NEAR(filter.position_m(), position_m, 1.0e-7);
  }
}

struct Measured {
  const char* name;
  bool speed, position;
};

class FeedSensors : public testing::TestWithParam<Measured> {};

TEST_P(FeedSensors, GiveTheSpeedWithTheVarianceThatIsClaimed) {
  const auto machine = reference_machine();
  const double speed_noise = 2.0e-3, position_noise = 1.0e-6, process_noise = 1.0e-4;
  FeedFilter<float> filter(machine.feed, kFeedPeriod_s, static_cast<float>(process_noise * process_noise));
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const ExponentialIntegrator<double> plant(machine, kFeedPeriod_s);
  PlantState<double> state{};
  double position_m = 0.0, normalised = 0.0, nis = 0.0;
  const int frames = 20000, counted_from = 2000;
  filter.start({0.0F, 0.0F, 4.0e-6F, 1.0e-12F});
  for (int k = 0; k < frames; ++k) {
    const auto u = cutting(30.0);
    const double before = state.feed_speed_m_s;
    state = plant.step(state, u);
    const double kick = process_noise * normal(random);
    state.feed_speed_m_s += kick;
    position_m += kFeedPeriod_s * (0.5 * (before + state.feed_speed_m_s));
    filter.predict(held<float>(u));
    const FeedMeasurement<float> y{
        static_cast<float>(state.feed_speed_m_s + speed_noise * normal(random)),
        static_cast<float>(position_m + position_noise * normal(random)),
        GetParam().speed ? static_cast<float>(speed_noise * speed_noise) : kUnmeasured,
        GetParam().position ? static_cast<float>(position_noise * position_noise) : kUnmeasured};
    const float frame_nis = filter.update(y);
    if (k < counted_from) continue;
    const double error = static_cast<double>(filter.speed_m_s()) - state.feed_speed_m_s;
    normalised += error * error / static_cast<double>(filter.speed_variance()) / (frames - counted_from);
    nis += static_cast<double>(frame_nis) / (frames - counted_from);
  }
  // Means over some 18,000 frames that are correlated over some tens of them: 10 % is three standard
  // deviations.
  EXPECT_NEAR(normalised, 1.0, 0.15);
  EXPECT_NEAR(nis, (GetParam().speed ? 1.0 : 0.0) + (GetParam().position ? 1.0 : 0.0), 0.1);
}

INSTANTIATE_TEST_SUITE_P(FeedFilter, FeedSensors,
                         testing::Values(Measured{"speed", true, false}, Measured{"position", false, true},
                                         Measured{"both", true, true}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace morepro
