#include "sim_host/diagnose/signals/written_digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace morepro::host {
namespace {

constexpr int kFewest = 2;
constexpr int kMost = 5;

/// Of the last of so many digits of a value that is not 0.
double step_at(double value, int digits) {
  return std::pow(10.0, std::floor(std::log10(std::fabs(value))) + 1.0 - digits);
}

bool has_digits(float value, int digits) {
  constexpr double kOfFloat = 1.2e-7;  // relative
  if (!std::isfinite(value) || value == 0.0F) return true;
  const auto exact = static_cast<double>(value);
  // A value just below a power of ten in a float is that power.
  const double step = step_at(exact * (1.0 + kOfFloat), digits);
  return std::fabs(exact - step * std::round(exact / step)) <= kOfFloat * std::fabs(exact);
}

double rms_step_of(const std::vector<float>& column, int digits) {
  double squares = 0.0;
  double count = 0.0;
  for (const float value : column) {
    if (!std::isfinite(value)) continue;
    count += 1.0;
    if (value == 0.0F) continue;
    const double step = step_at(static_cast<double>(value), digits);
    squares += step * step;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace

int digits_of(const std::vector<float>& column) {
  constexpr std::ptrdiff_t kFewestValues = 100;
  const auto is_value = [](float value) { return std::isfinite(value) && value != 0.0F; };
  if (std::ranges::count_if(column, is_value) < kFewestValues) return 0;
  int digits = kFewest;
  for (const float value : column)
    while (digits <= kMost && !has_digits(value, digits)) ++digits;
  return digits <= kMost ? digits : 0;
}

std::vector<WrittenDigits> allow_for_digits(const RecordingSignals& signals, Sensors& sensors) {
  std::vector<WrittenDigits> found;
  for (const Channel channel :
       {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed, Channel::kFeedPosition}) {
    if (!signals.has(channel)) continue;
    const auto& column = signals.value[index_of(channel)];
    const int digits = digits_of(column);
    if (digits == 0) continue;
    const double step = rms_step_of(column, digits);
    SensorNoise& sensor = sensors[channel];
    if (!(step > static_cast<double>(sensor.coarsest_step()))) continue;
    sensor.lsb = step;
    found.push_back({.channel = channel, .digits = digits, .step = step});
  }
  return found;
}

std::string sentence_of(const WrittenDigits& written) {
  return fmt::format(
      "{} was written with {} digits, which leaves steps of {:.2g}: that is taken for its last bit",
      kChannels[index_of(written.channel)].column, written.digits, written.step);
}

}  // namespace morepro::host
