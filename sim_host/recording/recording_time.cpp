#include "sim_host/recording/recording_time.hpp"

#include <cmath>

namespace morepro::host {

std::int64_t microseconds(double time_s) { return std::llround(time_s * 1.0e6); }

}  // namespace morepro::host
