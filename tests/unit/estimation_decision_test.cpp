#include <gtest/gtest.h>

#include <cmath>

#include "lib/estimation/decision.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

constexpr std::size_t kLaneCount = 11;
using Lanes = std::array<double, kLaneCount>;

Lanes lanes(const nlohmann::json& row) {
  Lanes result;
  for (std::size_t j = 0; j < kLaneCount; ++j) result[j] = row.at(j).get<double>();
  return result;
}

template <class Decision>
void expect_golden(Decision decision, const char* key) {
  const auto golden = test::golden_json("model_probability.json");
  for (std::size_t k = 0; k < golden.at("loglik").size(); ++k) {
    decision.step(lanes(golden.at("loglik").at(k)));
    const Lanes expected = lanes(golden.at(key).at(k));
    for (std::size_t j = 0; j < kLaneCount; ++j)
      EXPECT_NEAR(decision.probability()[j], expected[j], 1.0e-13) << "step " << k;
  }
}

TEST(MarkovDecision, EqualsTheGoldenProbabilities) {
  expect_golden(MarkovDecision<double, kLaneCount>(kLaneCount, 1.0e-4), "markov_filter");
}
TEST(BayesianDecision, EqualsTheGoldenProbabilities) {
  expect_golden(BayesianDecision<double, kLaneCount>(kLaneCount, 1.0e-6), "mmae");
}

TEST(BayesianDecision, KeepsEveryHypothesisAboveItsFloor) {
  BayesianDecision<float, 3> decision(3, 1.0e-6F);
  for (int k = 0; k < 1000; ++k) decision.step({0.0F, -20.0F, -40.0F});
  for (float p : decision.probability()) EXPECT_GE(p, 0.9e-6F);
  for (int k = 0; k < 2; ++k) decision.step({-20.0F, 0.0F, -20.0F});
  EXPECT_EQ(decision.selected(), 1U);
}

TEST(MarkovDecision, FloatFollowsDouble) {
  const auto golden = test::golden_json("model_probability.json");
  MarkovDecision<float, kLaneCount> decision(kLaneCount, 1.0e-4F);
  for (std::size_t k = 0; k < golden.at("loglik").size(); ++k) {
    std::array<float, kLaneCount> log_likelihood;
    for (std::size_t j = 0; j < kLaneCount; ++j)
      log_likelihood[j] = golden.at("loglik").at(k).at(j).get<float>();
    decision.step(log_likelihood);
    // exp to 4e-7 and some ten roundings.
    for (std::size_t j = 0; j < kLaneCount; ++j)
      EXPECT_NEAR(static_cast<double>(decision.probability()[j]),
                  golden.at("markov_filter").at(k).at(j).get<double>(), 3.0e-6);
  }
}

TEST(MarkovDecision, SumsToOneWhenNoHypothesisFits) {
  MarkovDecision<float, kLaneCount> decision(kLaneCount, 1.0e-4F);
  for (int k = 0; k < 1000; ++k) {
    std::array<float, kLaneCount> log_likelihood;
    for (std::size_t j = 0; j < kLaneCount; ++j)
      log_likelihood[j] = -1.0e30F * static_cast<float>(j + 1 + static_cast<std::size_t>(k % 3));
    decision.step(log_likelihood);
    float sum = 0.0F;
    for (float p : decision.probability()) sum += p;
    ASSERT_NEAR(sum, 1.0F, 1.0e-5F);
  }
}

TEST(MarkovDecision, LeavesALongBelievedHypothesisWithinSomeSteps) {
  MarkovDecision<float, 2> decision(2, 1.0e-4F);
  for (int k = 0; k < 10000; ++k) decision.step({0.0F, -5.0F});
  ASSERT_EQ(decision.selected(), 0U);
  for (int k = 0; k < 4; ++k) decision.step({-5.0F, 0.0F});
  EXPECT_EQ(decision.selected(), 1U);
}

TEST(MarkovDecision, IgnoresLanesBeyondItsCount) {
  MarkovDecision<float, 4> decision(2, 1.0e-4F);
  decision.step({0.0F, -1.0F, 50.0F, 50.0F});
  EXPECT_EQ(decision.selected(), 0U);
  EXPECT_EQ(decision.probability()[2], 0.0F);
  EXPECT_NEAR(decision.probability()[0] + decision.probability()[1], 1.0F, 1.0e-6F);
}

TEST(MinimumIntegralDecision, SelectsTheSmallestIntegralInUnitsOfTheNoise) {
  MinimumIntegralDecision<double, 3> decision(3, 1000.0, 0.1, 1.0e-4);
  // The accelerations alone would select 2; in units of the noise the currents decide.
  for (int k = 0; k < 10; ++k) decision.step({30.0, 20.0, -10.0}, {0.2, -0.1, 0.3});
  EXPECT_EQ(decision.selected(), 1U);
  EXPECT_NEAR(decision.integral()[1], 10.0 * 1.0e-4 * (0.02 + 1.0), 1.0e-15);
}

TEST(MinimumIntegralDecision, NeverForgets) {
  MinimumIntegralDecision<double, 2> decision(2, 1.0, 1.0, 1.0e-4);
  for (int k = 0; k < 1000; ++k) decision.step({0.0, 1.0}, {0.0, 0.0});
  for (int k = 0; k < 999; ++k) decision.step({1.0, 0.0}, {0.0, 0.0});
  EXPECT_EQ(decision.selected(), 0U);
}

}  // namespace
}  // namespace morepro
