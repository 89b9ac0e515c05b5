#include "sim_host/diagnose/signals/written_digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace morepro::host {
namespace {

constexpr int kFewest = 2;
constexpr int kMost = 5;

constexpr double kOfFloat = 1.2e-7;  // relative

/// Of the last of so many digits of a value that is not 0; just below a power of ten a float is that power.
double step_at(double value, int digits) {
  return std::pow(10.0, std::floor(std::log10(std::fabs(value) * (1.0 + kOfFloat))) + 1.0 - digits);
}

bool is_value(float value) { return std::isfinite(value) && value != 0.0F; }

bool has_digits(float value, int digits) {
  if (!is_value(value)) return true;
  const auto exact = static_cast<double>(value);
  const double step = step_at(exact, digits);
  return std::fabs(exact - step * std::round(exact / step)) <= kOfFloat * std::fabs(exact);
}

/// Magnitude that a twentieth of a column is beyond; 0 where it hardly has values, or hardly different ones.
double large_value_of(const std::vector<float>& column) {
  constexpr std::size_t kFewestValues = 100;
  constexpr std::ptrdiff_t kFewestDifferent = 50;
  std::vector<float> values;
  std::ranges::copy_if(column, std::back_inserter(values), is_value);
  if (values.size() < kFewestValues) return 0.0;
  std::ranges::for_each(values, [](float& value) { value = std::fabs(value); });
  std::ranges::sort(values);
  const float large = values[values.size() - values.size() / 20 - 1];
  const auto repeated = std::ranges::unique(values);
  return std::distance(values.begin(), repeated.begin()) < kFewestDifferent ? 0.0
                                                                            : static_cast<double>(large);
}

/// Do small values have finer steps than large ones? Else these are a sensor's steps, like any.
bool has_finer(const std::vector<float>& column, double step) {
  constexpr double kSome = 0.02;
  const auto finer = std::ranges::count_if(column, [step](float value) {
    const double steps = static_cast<double>(value) / step;
    return is_value(value) && std::fabs(steps - std::round(steps)) > 0.05;
  });
  return static_cast<double>(finer) > kSome * static_cast<double>(column.size());
}

struct DigitsAndStep {
  int digits = 0;
  double step = 0.0;
};

/// The digits first: most columns have more, and are done with at once.
DigitsAndStep written(const std::vector<float>& column) {
  int digits = kFewest;
  for (const float value : column) {
    while (digits <= kMost && !has_digits(value, digits)) ++digits;
    if (digits > kMost) return {};
  }
  const double large = large_value_of(column);
  if (!(large > 0.0) || !has_finer(column, step_at(large, digits))) return {};
  return {.digits = digits, .step = step_at(large, digits)};
}

}  // namespace

int digits_of(const std::vector<float>& column) { return written(column).digits; }

double written_step_of(const std::vector<float>& column) { return written(column).step; }

std::vector<WrittenDigits> allow_for_digits(RecordingSignals& signals, Sensors& sensors) {
  std::vector<WrittenDigits> found;
  for (const Channel channel :
       {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed, Channel::kFeedPosition}) {
    if (!signals.has(channel)) continue;
    const auto& column = signals.value[index_of(channel)];
    const auto [digits, step] = written(column);
    SensorNoise& sensor = sensors[channel];
    if (!(step > static_cast<double>(sensor.coarsest_step()))) continue;
    sensor.lsb = step;
    double& known = signals.step[index_of(channel)];
    known = std::max(known, step);
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
