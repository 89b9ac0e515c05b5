#include "sim_host/bench/timing.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace morepro::host {
namespace {

constexpr std::size_t kBatches = 21;
constexpr std::uint32_t kMostCalls = 1U << 28;

double seconds_of(const std::function<void(std::uint32_t)>& run, std::uint32_t calls) {
  const auto begin = std::chrono::steady_clock::now();
  run(calls);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Timing timing_of(const std::function<void(std::uint32_t)>& run, double seconds) {
  const double batch_s = seconds / static_cast<double>(kBatches);
  // Twice as many calls until a batch is long enough for the clock; that warms up, too.
  std::uint32_t calls = 64;
  while (calls < kMostCalls && seconds_of(run, calls) < batch_s) calls *= 2;
  std::vector<double> ns;
  for (std::size_t i = 0; i < kBatches; ++i) ns.push_back(seconds_of(run, calls) / calls * 1.0e9);
  std::sort(ns.begin(), ns.end());
  return {ns.front(), ns[kBatches / 2]};
}

}  // namespace morepro::host
