#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "lib/math/elementary.hpp"
#include "tests/support/not_finite.hpp"

namespace morepro {
namespace {

constexpr int kSamples = 1'000'000;
constexpr float kSubnormal = 1.0e-42F;

/// Largest relative error of `ours` against `theirs` over random arguments.
template <class Draw, class Ours, class Theirs>
double worst_error(Draw draw, Ours ours, Theirs theirs) {
  std::mt19937 generator(20240611);
  double worst = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    const float x = draw(generator);
    worst = std::max(worst, std::abs(double{ours(x)} / theirs(double{x}) - 1.0));
  }
  return worst;
}

auto uniform(float low, float high) {
  return [low, high](std::mt19937& g) { return std::uniform_real_distribution<float>(low, high)(g); };
}

auto log_uniform(double low_decade, double high_decade) {
  return [low_decade, high_decade](std::mt19937& g) {
    return static_cast<float>(
        std::pow(10.0, std::uniform_real_distribution<double>(low_decade, high_decade)(g)));
  };
}

constexpr auto kOurExp = [](float x) { return math::exp(x); };
constexpr auto kOurExp2 = [](float x) { return math::exp2(x); };
constexpr auto kOurLog = [](float x) { return math::log(x); };
constexpr auto kOurTanh = [](float x) { return math::tanh(x); };
constexpr auto kExp = [](double x) { return std::exp(x); };
constexpr auto kExp2 = [](double x) { return std::exp2(x); };
constexpr auto kLog = [](double x) { return std::log(x); };
constexpr auto kTanh = [](double x) { return std::tanh(x); };

// The bounds are those that the header promises; a sweep of 2e7 arguments gave 2.1e-7, 4.0e-7, 3.8e-7
// and 2.0e-7.
TEST(Elementary, ExpIsWithinItsBound) {
  EXPECT_LT(worst_error(uniform(-87.0F, 88.0F), kOurExp, kExp), 3.0e-7);
}
TEST(Elementary, Exp2IsWithinItsBound) {
  EXPECT_LT(worst_error(uniform(-125.9F, 127.9F), kOurExp2, kExp2), 5.0e-7);
}
TEST(Elementary, LogIsWithinItsBoundOverTheWholeRange) {
  EXPECT_LT(worst_error(log_uniform(-37.0, 38.0), kOurLog, kLog), 4.0e-7);
}
TEST(Elementary, LogKeepsItsRelativePrecisionAroundOne) {
  const auto beside_one = [](std::mt19937& g) { return 1.0F + uniform(1.0e-6F, 0.05F)(g); };
  EXPECT_LT(worst_error(beside_one, kOurLog, kLog), 4.0e-7);
}
TEST(Elementary, TanhIsWithinItsBound) {
  EXPECT_LT(worst_error(uniform(-10.0F, 10.0F), kOurTanh, kTanh), 3.0e-7);
  EXPECT_LT(worst_error(log_uniform(-30.0, 0.0), kOurTanh, kTanh), 3.0e-7);
}

TEST(Elementary, PowIsWithinItsBoundForExponentsUpToOne) {
  std::mt19937 generator(7);
  double worst = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    const float x = log_uniform(-6.0, 6.0)(generator);
    const float y = uniform(-1.0F, 1.0F)(generator);
    worst = std::max(worst, std::abs(double{math::pow(x, y)} / std::pow(double{x}, double{y}) - 1.0));
  }
  EXPECT_LT(worst, 3.0e-7);
}

TEST(Elementary, ExpAndExp2SaturateWithoutNan) {
  for (const float x : {-1.0e38F, -test::kInfinity<float>, -200.0F}) {
    EXPECT_EQ(math::exp(x), 0.0F);
    EXPECT_EQ(math::exp2(x), 0.0F);
  }
  for (const float x : {1.0e38F, test::kInfinity<float>, 200.0F}) {
    EXPECT_EQ(math::exp(x), test::kInfinity<float>);
    EXPECT_EQ(math::exp2(x), test::kInfinity<float>);
  }
  EXPECT_TRUE(std::isnan(math::exp(test::kNan<float>)));
  EXPECT_TRUE(std::isnan(math::exp2(test::kNan<float>)));
}

TEST(Elementary, ValuesAtZeroAndOneAreExact) {
  EXPECT_EQ(math::exp(0.0F), 1.0F);
  EXPECT_EQ(math::exp2(10.0F), 1024.0F);
  EXPECT_EQ(math::log(1.0F), 0.0F);
  EXPECT_EQ(math::pow(1.0F, 0.37F), 1.0F);
  EXPECT_EQ(math::pow(3.0F, 0.0F), 1.0F);
  EXPECT_EQ(math::tanh(0.0F), 0.0F);
}

TEST(Elementary, LogIsDefinedForEveryArgument) {
  EXPECT_EQ(math::log(0.0F), -test::kInfinity<float>);
  EXPECT_EQ(math::log(test::kInfinity<float>), test::kInfinity<float>);
  EXPECT_TRUE(std::isnan(math::log(-1.0F)));
  EXPECT_TRUE(std::isnan(math::log(-test::kInfinity<float>)));
  EXPECT_TRUE(std::isnan(math::log(test::kNan<float>)));
  EXPECT_NEAR(double{math::log(kSubnormal)}, std::log(double{kSubnormal}), 4.0e-5);
}

TEST(Elementary, PowIsDefinedForEveryArgument) {
  EXPECT_EQ(math::pow(0.0F, 0.5F), 0.0F);
  EXPECT_EQ(math::pow(0.0F, -0.5F), test::kInfinity<float>);
  EXPECT_EQ(math::pow(0.0F, 0.0F), 1.0F);
  EXPECT_EQ(math::pow(test::kInfinity<float>, 0.5F), test::kInfinity<float>);
  EXPECT_EQ(math::pow(test::kInfinity<float>, -0.5F), 0.0F);
  EXPECT_EQ(math::pow(2.0F, 1000.0F), test::kInfinity<float>);
  EXPECT_EQ(math::pow(2.0F, -1000.0F), 0.0F);
  EXPECT_TRUE(std::isnan(math::pow(-2.0F, 0.5F)));
  EXPECT_TRUE(std::isnan(math::pow(test::kNan<float>, 0.0F)));
  EXPECT_TRUE(std::isnan(math::pow(2.0F, test::kNan<float>)));
  EXPECT_TRUE(std::isnan(math::pow(2.0F, test::kInfinity<float>)));
  EXPECT_NEAR(double{math::pow(kSubnormal, 0.5F)} / std::sqrt(double{kSubnormal}), 1.0, 1.0e-6);
}

TEST(Elementary, TanhIsOddAndSaturates) {
  for (const float x : {1.0e-40F, 0.3F, 0.8F, 1.7F, 9.0F, 50.0F}) EXPECT_EQ(math::tanh(-x), -math::tanh(x));
  EXPECT_EQ(math::tanh(test::kInfinity<float>), 1.0F);
  EXPECT_EQ(math::tanh(-test::kInfinity<float>), -1.0F);
  EXPECT_TRUE(std::isnan(math::tanh(test::kNan<float>)));
}

/// Largest errors of sin_cos against the standard library's, of either function.
struct AngleError {
  double absolute = 0.0;
  double relative = 0.0;
  void take(float ours, double theirs) {
    absolute = std::max(absolute, std::abs(double{ours} - theirs));
    relative = std::max(relative, std::abs(double{ours} / theirs - 1.0));
  }
};

template <class Draw>
AngleError worst_angle_error(Draw draw) {
  std::mt19937 generator(20260101);
  AngleError worst;
  for (int k = 0; k < kSamples; ++k) {
    const float x = draw(generator);
    const auto ours = math::sin_cos(x);
    worst.take(ours.sin, std::sin(double{x}));
    worst.take(ours.cos, std::cos(double{x}));
  }
  return worst;
}

// A sweep of 2e7 arguments each gave 1.8e-7 of the value up to 100, and an error of 1.1e-7 everywhere.
TEST(Elementary, SinAndCosKeepTheirRelativePrecisionBesideTheirZeros) {
  EXPECT_LT(worst_angle_error(uniform(-100.0F, 100.0F)).relative, 2.0e-7);
  for (int quarter = 1; quarter <= 63; ++quarter) {
    const auto x = static_cast<float>(quarter * 1.5707963267948966);
    const auto zero_near = quarter % 2 == 0 ? double{math::sin(x)} / std::sin(double{x})
                                            : double{math::cos(x)} / std::cos(double{x});
    EXPECT_NEAR(zero_near, 1.0, 2.0e-7) << quarter;
  }
}
TEST(Elementary, SinAndCosAreWithinTheirBoundForEveryArgument) {
  EXPECT_LT(worst_angle_error(uniform(-1.0e5F, 1.0e5F)).absolute, 1.2e-7);
  EXPECT_LT(worst_angle_error(log_uniform(-30.0, 38.0)).absolute, 1.2e-7);
}

TEST(Elementary, SinAndCosAgreeWhereTheReductionChanges) {
  for (const float x :
       {1.0e5F, std::nextafter(1.0e5F, 1.0e6F), 131072.0F, std::numeric_limits<float>::max()}) {
    EXPECT_NEAR(double{math::sin(x)}, std::sin(double{x}), 1.2e-7) << x;
    EXPECT_NEAR(double{math::cos(x)}, std::cos(double{x}), 1.2e-7) << x;
  }
}

TEST(Elementary, SinIsOddAndCosIsEven) {
  for (const float x : {1.0e-40F, 1.0e-3F, 0.7853982F, 1.5707964F, 3.0F, 777.7F, 1.0e5F, 3.0e6F, 2.0e38F}) {
    EXPECT_EQ(math::sin(-x), -math::sin(x)) << x;
    EXPECT_EQ(math::cos(-x), math::cos(x)) << x;
  }
  EXPECT_EQ(math::sin(0.0F), 0.0F);
  EXPECT_EQ(math::cos(0.0F), 1.0F);
}

TEST(Elementary, SinAndCosOfNoNumberAreNan) {
  for (const float x : {test::kInfinity<float>, -test::kInfinity<float>, test::kNan<float>}) {
    EXPECT_TRUE(std::isnan(math::sin(x)));
    EXPECT_TRUE(std::isnan(math::cos(x)));
  }
}

TEST(Elementary, Atan2IsWithinItsBoundInEveryOctant) {
  std::mt19937 generator(5);
  double worst = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    const float y = uniform(-10.0F, 10.0F)(generator);
    const float x = uniform(-10.0F, 10.0F)(generator);
    worst = std::max(worst, std::abs(double{math::atan2(y, x)} - std::atan2(double{y}, double{x})));
  }
  EXPECT_LT(worst, 3.0e-7);
}

TEST(Elementary, Atan2KeepsItsRelativePrecisionForSmallAngles) {
  const auto ours = [](float y) { return math::atan2(y, 2.0F); };
  EXPECT_LT(worst_error(log_uniform(-30.0, 0.0), ours, [](double y) { return std::atan2(y, 2.0); }), 3.0e-7);
}

TEST(Elementary, Atan2IsDefinedForEveryArgument) {
  EXPECT_EQ(math::atan2(0.0F, 0.0F), 0.0F);
  EXPECT_EQ(math::atan2(0.0F, 1.0F), 0.0F);
  for (const float y : {1.0e-40F, 1.0F, 3.0e38F}) {
    EXPECT_NEAR(math::atan2(y, 0.0F), 1.57079633F, 2.0e-7F);
    EXPECT_NEAR(math::atan2(-y, 0.0F), -1.57079633F, 2.0e-7F);
  }
  EXPECT_NEAR(math::atan2(0.0F, -1.0F), 3.14159265F, 3.0e-7F);
  EXPECT_NEAR(math::atan2(3.0e38F, 3.0e38F), 0.785398163F, 1.0e-7F);
  for (const float x : {test::kNan<float>, test::kInfinity<float>, -test::kInfinity<float>}) {
    EXPECT_TRUE(std::isnan(math::atan2(x, 1.0F)));
    EXPECT_TRUE(std::isnan(math::atan2(1.0F, x)));
  }
}

TEST(Elementary, EveryNanGivesNan) {
  for (const std::uint32_t bits :
       {0x7F800001U, 0x7FBFFFFFU, 0x7FC00000U, 0x7FFFFFFFU, 0xFF812345U, 0xFFFFFFFFU}) {
    const float x = std::bit_cast<float>(bits);
    for (const float y : {math::exp(x), math::exp2(x), math::log(x), math::tanh(x), math::sin(x),
                          math::cos(x), math::pow(x, 0.5F), math::pow(2.0F, x)}) {
      EXPECT_TRUE(std::isnan(y)) << std::hex << bits;
    }
  }
}

TEST(Elementary, PowTakesLargeExponents) {
  EXPECT_NEAR(double{math::pow(1.4F, 259.0F)} / std::pow(double{1.4F}, 259.0), 1.0, 3.0e-5);
  EXPECT_NEAR(double{math::pow(0.7F, 240.0F)} / std::pow(double{0.7F}, 240.0), 1.0, 3.0e-5);
}

TEST(Elementary, BranchFreeLogIsTheSameFunction) {
  for (const float x : {1.2e-38F, 1.0e-3F, 0.5F, 1.0F, 7.0F, 3.0e38F}) {
    EXPECT_EQ(math::log_of_normal(x), math::log(x));
  }
}

TEST(Elementary, BranchFreeExpIsTheSameFunctionDownToItsFloor) {
  for (const float x : {0.0F, -1.0e-6F, -1.0F, -50.0F, -85.9F}) {
    EXPECT_EQ(math::exp_of_nonpositive(x), math::exp(x));
  }
  EXPECT_EQ(math::exp_of_nonpositive(-1.0e30F), math::exp(-86.0F));
}

}  // namespace
}  // namespace morepro
