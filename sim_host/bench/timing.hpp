#pragma once
#include <cstdint>
#include <functional>

namespace morepro::host {

/// Time of one call in ns over several batches: what a quiet machine takes, and what is usual here.
struct Timing {
  double least_ns = 0.0;
  double median_ns = 0.0;
};

/// `run(n)` makes n calls. Takes about `seconds`, > 0.
Timing timing_of(const std::function<void(std::uint32_t)>& run, double seconds);

}  // namespace morepro::host
