#include <array>
#include <cstdint>

#include "lib/gap/board_forms.hpp"
#include "lib/gap/gap_watch.hpp"
#include "lib/gap/square_root_statistics.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "tests/support/bit_hash.hpp"
#include "tests/support/check.hpp"

namespace morepro::gap {
namespace {

// The same bits on every machine: the hashes hold for x86, ARM, RISC-V and s390x alike.

class Numbers {
 public:
  float next() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<float>(static_cast<std::int32_t>(state_)) * 4.6566129e-10F;
  }

 private:
  std::uint32_t state_ = 1;
};

TEST(SquareRootStatistics, HasTheSameBitsEverywhere) {
  static SquareRootStatistics<float, 12> statistics;
  Numbers numbers;
  for (int k = 0; k < 200; ++k) {
    SquareRootStatistics<float, 12>::Row row;
    for (float& x : row) x = numbers.next();
    statistics.add(row);
  }
  test::BitHash hash;
  for (std::size_t i = 0; i < 13; ++i)
    for (std::size_t j = i; j < 13; ++j) hash.add(statistics.factor(i, j));
  const auto group = ExplainedColumns<float, 12>(4).gain_of(statistics, 5, 4);
  hash.add(group.gain);
  hash.add(group.coefficient);
  hash.add(statistics.correlation(7, 9, 4));
  EXPECT_EQ(hash.value(), 1678969159U);
}

GapFrame<float> swinging(Numbers& numbers, int k) {
  const float swing = (k / 700) % 2 == 0 ? 1.0F : -0.5F;
  GapFrame<float> frame;
  frame.input = {
      30.0F * swing + numbers.next(), 20.0F * swing, swing > 0.0F ? 1.0F : 0.0F, 1.0F, 0.05F, 500.0F};
  frame.winding_degc = 30.0F;
  frame.speed_rad_s = 400.0F * swing + numbers.next();
  frame.current_a = 2.0F * swing + 0.05F * numbers.next();
  frame.feed_speed_m_s = 0.02F * swing + 0.002F * numbers.next();
  frame.has_speed = frame.has_current = frame.has_feed_speed = true;
  return frame;
}

TEST(GapWatch, HasTheSameBitsEverywhere) {
  static GapWatch<float> watch(
      reference_machine(), {577.0, 2.2, 0.02, 0.05, 500.0}, 1.0e-4,
      {.noise = {1.0, 0.0025, 4.0e-6, 1.0e-12, 1.0e30, 0.01, 0.0005, 2.0e-5}, .spindle = {}, .feed = {}});
  Numbers numbers;
  test::BitHash hash;
  for (int k = 0; k < 40000; ++k) watch.step(swinging(numbers, k));
  for (std::size_t i = 0; i <= watch.spindle().kColumns; ++i)
    hash.add(watch.spindle().statistics().factor(i, watch.spindle().kColumns));
  for (std::size_t i = 0; i <= watch.feed().kColumns; ++i)
    hash.add(watch.feed().statistics().factor(i, watch.feed().kColumns));
  hash.add(watch.finding().evidence);
  hash.add(watch.finding().confidence);
  EXPECT_TRUE(watch.finding().verdict != GapVerdict::kNotEnoughData);
  EXPECT_EQ(hash.value(), 927475103U);
}

}  // namespace
}  // namespace morepro::gap
