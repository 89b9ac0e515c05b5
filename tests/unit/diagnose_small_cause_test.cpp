// A cause that takes a few thousandths of what moves the machine beside random forces: noise that lasts may
// be worth more to a name, but leaves it nothing where the innovations before may predict the next one.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

struct SmallCause {
  Effect effect;
  double size_n;
};

void PrintTo(const SmallCause& cause, std::ostream* out) { *out << gap::name_of(cause.effect); }

class SmallCauses : public testing::TestWithParam<SmallCause> {};

TEST_P(SmallCauses, KeepTheirNamesBesideRandomForces) {
  const auto [small, size_n] = GetParam();
  const auto result = diagnosed(record({.effects = {effect(small, size_n)},
                                        .duration_s = 12.0,
                                        .rate_hz = 5000.0,
                                        .seed = 1,
                                        .process_noise = 1.0}),
                                wrong_datasheet(1));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.verdict, host::Verdict::kEffect);
  EXPECT_TRUE(names(result.which.front(), small)) << said(result);
  // Three standard errors.
  EXPECT_NEAR(result.which.front().magnitude, size_n, 3.0 * result.which.front().standard_error);
  EXPECT_TRUE(result.board_agrees) << gap::name_of(result.board.verdict);
}

INSTANTIATE_TEST_SUITE_P(OfTheFeed, SmallCauses,
                         testing::Values(SmallCause{Effect::kFeedForceOffset, 1.4},
                                         SmallCause{Effect::kFeedCoulombFriction, 1.5}));

}  // namespace
}  // namespace morepro::diagnose_test
