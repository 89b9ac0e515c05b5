#include "sim_host/recording/recording_info.hpp"

#include <fast_float/fast_float.h>

#include <cmath>

namespace morepro::host {

std::optional<double> RecordingInfo::metadata_number(std::string_view key) const {
  const std::string_view text = metadata_value(key);
  double value = 0.0;
  const auto result = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = result.ec == std::errc{} && result.ptr == text.data() + text.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace morepro::host
