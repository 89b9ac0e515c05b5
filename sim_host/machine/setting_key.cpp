#include "sim_host/machine/setting_key.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/monitor/monitor.hpp"

namespace morepro::host {
namespace {

using Configuration = MonitorConfiguration;

constexpr bool kExclusive = false;

/// A key of the member that a path of members leads to.
template <auto... kPath>
constexpr SettingKey setting(std::string_view table, std::string_view key, std::string_view part,
                             std::string_view origin = {}) {
  SettingKey made{.table = table, .key = key, .part = part, .get = nullptr, .set = nullptr, .origin = origin};
  made.get = [](const Configuration& c) { return static_cast<double>((c.*....*kPath)); };
  made.set = [](Configuration& c, double value) {
    auto& member = (c.*....*kPath);
    member = static_cast<std::remove_reference_t<decltype(member)>>(value);
  };
  return made;
}

constexpr SettingKey between(SettingKey key, double lowest, bool may_be_lowest,
                             double highest = std::numeric_limits<double>::infinity(),
                             bool may_be_highest = true) {
  key.lowest = lowest;
  key.may_be_lowest = may_be_lowest;
  key.highest = highest;
  key.may_be_highest = may_be_highest;
  return key;
}

constexpr SettingKey positive(const SettingKey& key) { return between(key, 0.0, kExclusive); }
constexpr SettingKey at_least_1(const SettingKey& key) { return between(key, 1.0, true); }

constexpr SettingKey hypotheses() {
  SettingKey key = setting<&Configuration::grid, &HypothesisGrid::count>(
      "bank", "hypotheses", "contact", "as many as the contact law has room for, at most 11");
  static_assert(kMonitorHypotheses == 11);
  key.is_whole = true;
  return between(key, 1.0, true, static_cast<double>(kMonitorHypotheses));
}

constexpr auto kGrid = &Configuration::grid;
constexpr auto kTuning = &Configuration::tuning;
constexpr auto kGap = &Configuration::gap;
constexpr auto kWear = &Configuration::wear;
constexpr auto kSpindle = &GapTuning::spindle;
constexpr auto kFeed = &GapTuning::feed;

constexpr std::array kSettingKeys{
    hypotheses(),
    positive(setting<kGrid, &HypothesisGrid::first_mm>(
        "bank", "first_hypothesis_mm", "contact",
        "so that tool.chip_load_mm is one, in the middle if it can")),
    positive(setting<kGrid, &HypothesisGrid::step_mm>("bank", "hypothesis_step_mm", "contact",
                                                      "a fifth of tool.chip_load_mm or finer")),
    positive(setting<kTuning, &FilterTuning::speed_process_noise_rad_s>(
        "tuning", "speed_process_noise_rad_s", "spindle", "per sample; 3 % of the sensor's noise at 10 kHz")),
    positive(setting<kTuning, &FilterTuning::current_process_noise_a>(
        "tuning", "current_process_noise_a", "spindle", "per sample; 30 % of the sensor's noise at 10 kHz")),
    positive(setting<kTuning, &FilterTuning::feed_process_noise_m_s>(
        "tuning", "feed_process_noise_m_s", "feed", "per sample; 5 % of the sensor's noise at 10 kHz")),
    positive(setting<kTuning, &FilterTuning::chip_load_drift_mm>(
        "tuning", "chip_load_drift_mm", "contact",
        "per sample; 0.5 % of the step between hypotheses at 10 kHz")),
    between(
        setting<kTuning, &FilterTuning::switch_probability>(
            "tuning", "switch_probability", "contact", "per sample, for the rule \"markov\"; once a second"),
        0.0, kExclusive, 1.0, kExclusive),
    positive(
        setting<kTuning, &FilterTuning::parameter_start_fraction>("tuning", "parameter_start_fraction", "")),
    setting<kGap, &GapTuning::speed_process_noise_rad_s>("gap", "speed_process_noise_rad_s", "spindle",
                                                         "per sample; 1 % of the sensor's noise at 10 kHz"),
    setting<kGap, &GapTuning::current_process_noise_a>("gap", "current_process_noise_a", "spindle",
                                                       "per sample; 1 % of the sensor's noise at 10 kHz"),
    setting<kGap, &GapTuning::feed_process_noise_m_s>("gap", "feed_process_noise_m_s", "feed",
                                                      "per sample; 1 % of the sensor's noise at 10 kHz"),
    between(setting<kGap, &GapTuning::lost_share>("gap", "lost_share", "", "of its frames a good link loses"),
            0.0, true, 1.0),
    setting<kGap, &GapTuning::clock_jitter_s>("gap", "clock_jitter_s", "", "as far as it is known"),
    positive(setting<kGap, kSpindle, &gap::GapLimits::evidence>("gap", "spindle_evidence", "spindle")),
    at_least_1(
        setting<kGap, kSpindle, &gap::GapLimits::temperature>("gap", "spindle_temperature", "spindle")),
    positive(setting<kGap, kSpindle, &gap::GapLimits::excitation>("gap", "spindle_excitation", "spindle")),
    positive(setting<kGap, kSpindle, &gap::GapLimits::noise_ratio>("gap", "spindle_noise_ratio", "spindle")),
    positive(setting<kGap, kSpindle, &gap::GapLimits::parameter_spread>("gap", "spindle_parameter_spread",
                                                                        "spindle")),
    positive(setting<kGap, kFeed, &gap::GapLimits::evidence>("gap", "feed_evidence", "feed")),
    at_least_1(setting<kGap, kFeed, &gap::GapLimits::temperature>("gap", "feed_temperature", "feed")),
    positive(setting<kGap, kFeed, &gap::GapLimits::excitation>("gap", "feed_excitation", "feed")),
    positive(setting<kGap, kFeed, &gap::GapLimits::noise_ratio>("gap", "feed_noise_ratio", "feed")),
    positive(setting<kGap, kFeed, &gap::GapLimits::parameter_spread>("gap", "feed_parameter_spread", "feed")),
    at_least_1(setting<kWear, &WearLimits::watch_ratio>("wear", "watch_ratio", "contact")),
    at_least_1(setting<kWear, &WearLimits::replace_ratio>("wear", "replace_ratio", "contact")),
    between(setting<kWear, &WearLimits::low_ratio>("wear", "low_ratio", "contact"), 0.0, kExclusive, 1.0),
    setting<kWear, &WearLimits::hold_s>("wear", "hold_s", "contact"),
    setting<kWear, &WearLimits::datasheet_tolerance>("wear", "datasheet_tolerance", "contact"),
};

}  // namespace

std::span<const SettingKey> setting_keys() { return kSettingKeys; }

std::string full_name(const SettingKey& key) { return fmt::format("{}.{}", key.table, key.key); }

std::string range_text(const SettingKey& key) {
  if (key.is_whole)
    return fmt::format("a whole number from {} to {} (the board's bank holds no more)", key.lowest,
                       key.highest);
  const std::string low = fmt::format("{} {}", key.may_be_lowest ? "at least" : "greater than", key.lowest);
  if (std::isinf(key.highest)) return low;
  return fmt::format("{} and {} {}", low, key.may_be_highest ? "at most" : "less than", key.highest);
}

bool is_in_range(const SettingKey& key, double value) {
  if (key.is_whole && value != std::round(value)) return false;
  const bool is_high_enough = value > key.lowest || (key.may_be_lowest && value == key.lowest);
  return is_high_enough && (value < key.highest || (key.may_be_highest && value == key.highest));
}

}  // namespace morepro::host
