#include "sim_host/diagnose/signals/shown_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "sim_host/diagnose/signals/current_noise.hpp"
#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kBlockRows = 256;
constexpr std::size_t kFewestToTell = 8;
constexpr double kNoisier = 1.5;  // times what was said: less than that changes no answer

std::vector<double> differences_of(std::span<const float> column, std::size_t times) {
  std::vector<double> values(column.begin(), column.end());
  for (; times > 0 && !values.empty(); --times) {
    for (std::size_t i = 0; i + 1 < values.size(); ++i) values[i] = values[i + 1] - values[i];
    values.pop_back();
  }
  return values;
}

/// Less what a steady motion adds, and no farther off than noise gets: an outlier is no noise.
void centre_and_clip(std::span<double> block) {
  constexpr double kFarthest = 4.0;  // standard deviations
  std::vector<double> sorted;
  std::ranges::copy_if(block, std::back_inserter(sorted), [](double value) { return std::isfinite(value); });
  if (sorted.empty()) return;
  const double centre = median_of(sorted);
  for (double& value : sorted) value = std::fabs(value - centre);
  const double most = kFarthest * kDeviationPerMedian * median_of(sorted);
  for (double& value : block) value = std::clamp(value - centre, -most, most);
}

/// Mean product of values that are `lag` apart; NaN where hardly any were recorded.
double product_at(std::size_t lag, std::span<const double> block) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = lag; i < block.size(); ++i) {
    const double product = block[i] * block[i - lag];
    if (!std::isfinite(product)) continue;
    sum += product;
    count += 1.0;
  }
  return count > 0.5 * static_cast<double>(block.size()) ? sum / count : std::nan("");
}

/// The median of all blocks; NaN where there are too few.
double usual_product_at(std::size_t lag, std::span<const double> values) {
  std::vector<double> products;
  for (std::size_t first = 0; first + kBlockRows <= values.size(); first += kBlockRows)
    if (const double product = product_at(lag, values.subspan(first, kBlockRows)); std::isfinite(product))
      products.push_back(product);
  return products.size() < kFewestToTell ? std::nan("") : median_of(products);
}

/// Standard deviation of what is white in a column, where once and twice differenced it shows the same: then
/// no motion is taken for less noise. Of 211 sensors of two other simulators that showed both within a
/// quarter all showed 0.84 to 1.13 times what was stated. 0: not known.
double surely_white_noise_of(std::span<const float> column) {
  constexpr double kSame = 1.25;
  const double once = white_noise_of(column, 1), twice = white_noise_of(column, 2);
  return once > 0.0 && std::max(once, twice) < kSame * std::min(once, twice) ? std::sqrt(once * twice) : 0.0;
}

}  // namespace

// Differences of white noise that are neighbours share a sample, with opposite signs; what lasts has them
// alike, also farther apart, and those of a random walk share nothing. Lags at which white noise shares
// nothing differ where there is a wave.
double white_noise_of(std::span<const float> column, std::size_t differences) {
  constexpr double kMostOfWave = 0.2;  // differences of a position share 0.25
  std::vector<double> values = differences_of(column, differences);
  for (std::size_t first = 0; first + kBlockRows <= values.size(); first += kBlockRows)
    centre_and_clip(std::span(values).subspan(first, kBlockRows));
  std::array<double, 3> lasting{};
  for (std::size_t i = 0; i < lasting.size(); ++i) lasting[i] = usual_product_at(differences + 1 + i, values);
  if (!std::isfinite(lasting[0] + lasting[1] + lasting[2])) return 0.0;
  const auto [least, most] = std::ranges::minmax(lasting);
  const double shared = differences == 1 ? 1.0 : 4.0;
  const double variance = (least - usual_product_at(1, values)) / shared;
  return variance > 0.0 && most - least <= kMostOfWave * variance ? std::sqrt(variance) : 0.0;
}

std::optional<ShownNoise> shown_noise(Channel channel, double deviation, const Sensors& sensors) {
  const SensorNoise& stated = sensors[channel];
  if (!(stated.variance() > 0.0)) return std::nullopt;
  const double ratio = deviation / std::sqrt(stated.variance());
  if (ratio < kNoisier) return std::nullopt;
  const double noise = std::sqrt(deviation * deviation - stated.lsb * stated.lsb / 12.0);
  return ShownNoise{.channel = channel, .noise = noise, .ratio = ratio};
}

std::vector<ShownNoise> noisier_than_stated(const RecordingSignals& signals, const Sensors& sensors) {
  struct Watched {
    Channel channel;
    std::size_t differences;
  };
  constexpr std::array<Watched, 3> kWatched{
      {{Channel::kSpindleSpeed, 1}, {Channel::kFeedSpeed, 1}, {Channel::kFeedPosition, 2}}};
  std::vector<ShownNoise> noisier;
  if (signals.is_thinned) return noisier;
  for (const auto& [channel, differences] : kWatched) {
    if (!signals.has(channel)) continue;
    const double deviation = white_noise_of(signals.value[index_of(channel)], differences);
    if (const auto shown = shown_noise(channel, deviation, sensors)) noisier.push_back(*shown);
  }
  return noisier;
}

std::string sentence_of(const ShownNoise& shown) {
  return fmt::format("{} is {:.1f} times as noisy as the machine file says: a noise of {:.2g} is taken",
                     kChannels[index_of(shown.channel)].column, shown.ratio, shown.noise);
}

// Without noise, or nearly so, no simulation of another's would do: a thirtieth of what is usual is enough.
std::vector<ShownNoise> instead_of_assumed(const RecordingSignals& signals, std::uint16_t assumed,
                                           const Sensors& sensors) {
  constexpr double kLeastOfUsual = 1.0 / 30.0;
  std::vector<ShownNoise> others;
  if (signals.is_thinned) return others;
  for (const Channel channel :
       {Channel::kSpindleSpeed, Channel::kFeedSpeed, Channel::kFeedPosition, Channel::kArmatureCurrent}) {
    if (!signals.has(channel) || (assumed & bit_of(channel)) == 0) continue;
    const bool is_bound = channel == Channel::kArmatureCurrent;
    const double deviation =
        is_bound ? most_noise_of_current(signals) : surely_white_noise_of(signals.value[index_of(channel)]);
    const SensorNoise& usual = sensors[channel];
    const double without_rounding =
        std::sqrt(std::max(0.0, deviation * deviation - usual.lsb * usual.lsb / 12.0));
    const double noise = std::max(without_rounding, kLeastOfUsual * usual.noise);
    const double ratio = noise / usual.noise;
    const bool is_less = deviation > 0.0 && ratio < 1.0 / kNoisier;
    const bool is_more = !is_bound && ratio > kNoisier;
    if (is_less || is_more) others.push_back({.channel = channel, .noise = noise, .ratio = ratio});
  }
  return others;
}

std::string sentence_of_assumed(const ShownNoise& shown) {
  return fmt::format("{}: a noise of {:.2g} is taken, by what was recorded",
                     kChannels[index_of(shown.channel)].column, shown.noise);
}

}  // namespace morepro::host
