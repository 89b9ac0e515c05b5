#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sim_host/thesis/bank_trial.hpp"

namespace morepro::host::thesis {
namespace {

const std::vector<BankTrialRow>& rows() {
  static const std::vector<BankTrialRow> all = run_bank_trial({.runs = 3, .seed = 1, .on_progress = {}});
  return all;
}

const BankTrialRow& row(std::string_view machine, double noise, std::string_view mismatch,
                        std::string_view rule) {
  for (const BankTrialRow& one : rows())
    if (one.machine == machine && one.noise == noise && one.mismatch == mismatch && one.rule == rule)
      return one;
  throw std::runtime_error("no such row");
}

// The thesis's integral never forgets: 200 ms of another chip load outweigh what comes after.
TEST(BankTrial, TheThesisRuleFindsTheFirstChipLoadAndNotTheSecond) {
  const BankTrialRow& thesis = row("thesis", 1.0, "", "thesis, integral");
  EXPECT_LT(thesis.contact_ms, 2.0);
  EXPECT_FALSE(std::isfinite(thesis.switch_ms));
  EXPECT_LT(thesis.right_share, 0.05);
}

TEST(BankTrial, TheMarkovRuleFindsBoth) {
  for (const std::string_view machine : {"thesis", "reference"}) {
    const BankTrialRow& markov = row(machine, 1.0, "", "Markov");
    EXPECT_LT(markov.contact_ms, 15.0) << machine;
    EXPECT_LT(markov.switch_ms, 25.0) << machine;
    EXPECT_GT(markov.right_share, 0.99) << machine;
  }
}

// One percent of the torque constant is 0.82 hypotheses on the thesis's machine: no rule can tell them apart.
TEST(BankTrial, AWrongTorqueConstantMovesEveryRuleOnTheThesisMachine) {
  for (const std::string_view rule : {"thesis, integral", "Bayes, floor", "Markov", "continuous"})
    EXPECT_GT(row("thesis", 1.0, "Kt + 1 %", rule).mean_error_mm, 0.05) << rule;
  EXPECT_NEAR(row("thesis", 1.0, "Kt + 1 %", "continuous").mean_error_mm, 0.082, 0.03);
  EXPECT_LT(std::abs(row("reference", 1.0, "Kt + 1 %", "Markov").mean_error_mm), 0.005);
}

TEST(BankTrial, MoreNoiseTakesLonger) {
  for (const std::string_view machine : {"thesis", "reference"})
    EXPECT_GT(row(machine, 10.0, "", "Markov").contact_ms, row(machine, 1.0, "", "Markov").contact_ms)
        << machine;
}

TEST(BankTrial, ASeedGivesTheSameTable) {
  const auto again = run_bank_trial({.runs = 3, .seed = 1, .on_progress = {}});
  for (std::size_t k = 0; k < again.size(); ++k) {
    EXPECT_EQ(again[k].contact_ms, rows()[k].contact_ms) << k;
    EXPECT_EQ(again[k].mean_error_mm, rows()[k].mean_error_mm) << k;
  }
}

}  // namespace
}  // namespace morepro::host::thesis
