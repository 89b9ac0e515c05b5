#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "sim_host/support/in_parallel.hpp"
#include "sim_host/support/tiny_numbers.hpp"

namespace morepro::host {
namespace {

TEST(InParallel, DoesEveryTaskOnce) {
  std::array<int, 20> done{};
  in_parallel(done.size(), [&done](std::size_t i) { ++done[i]; });
  for (const int times : done) EXPECT_EQ(times, 1);
  in_parallel(0, [](std::size_t) { FAIL(); });
}

TEST(InParallel, HandsOnWhatATaskThrows) {
  std::array<int, 4> done{};
  const auto task = [&done](std::size_t i) {
    ++done[i];
    if (i == 2) throw std::runtime_error("two");
  };
  EXPECT_THROW(in_parallel(done.size(), task), std::runtime_error);
  for (const int times : done) EXPECT_EQ(times, 1);
}

#if defined(__SSE2__)
TEST(TinyNumbers, AreZeroAsLongAsTheGuardLives) {
  volatile double smallest = std::numeric_limits<double>::min();
  volatile double tiny = 0.5 * smallest;
  volatile double made = 1.0, taken = 1.0;
  {
    const NoTinyNumbers guard;
    made = 0.5 * smallest;
    taken = 2.0 * tiny;
  }
  // Looked at outside: inside, a tiny number equals zero whether it is one or not.
  EXPECT_EQ(made, 0.0);
  EXPECT_EQ(taken, 0.0);
  EXPECT_GT(0.5 * smallest, 0.0);
}
#endif

}  // namespace
}  // namespace morepro::host
