#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace morepro {

/// One signal of the machine. The order is the bit order of SensorFrame::present and the order on the wire.
enum class Channel : std::uint8_t {
  kArmatureVoltage = 0,
  kFeedForce,
  kContact,
  kEngagement,
  kSpindleSpeed,
  kSpindleAngle,
  kFeedSpeed,
  kFeedPosition,
  kArmatureCurrent,
  kToolTemperature,
  kWindingTemperature,
  kChipLoad,
  kSpindleAcceleration,
  kFeedAcceleration,
};

inline constexpr std::size_t kChannelCount = 14;

constexpr std::size_t index_of(Channel channel) { return static_cast<std::size_t>(channel); }
constexpr std::uint16_t bit_of(Channel channel) {
  return static_cast<std::uint16_t>(1U << index_of(channel));
}

/// Held: the value is applied from this frame's time to the next one's. Sampled: measured at this frame's
/// time.
enum class ChannelKind : std::uint8_t { kHeldInput, kSampled };

/// What one channel means and which values a sensor of it can give; outside of [lowest, highest] the value is
/// rejected by the guard. The ranges are those of any machine of this class, not of one machine.
struct ChannelInfo {
  std::string_view column;  ///< column name in a CSV recording, unit included
  ChannelKind kind;
  float lowest;
  float highest;
};

inline constexpr std::array<ChannelInfo, kChannelCount> kChannels{{
    {"armature_voltage_v", ChannelKind::kHeldInput, -1000.0F, 1000.0F},
    {"feed_force_n", ChannelKind::kHeldInput, -1.0e6F, 1.0e6F},
    {"contact", ChannelKind::kHeldInput, 0.0F, 1.0F},
    {"engagement", ChannelKind::kHeldInput, 0.0F, 10.0F},
    {"spindle_speed_rad_s", ChannelKind::kSampled, -2.0e4F, 2.0e4F},
    {"spindle_angle_rad", ChannelKind::kSampled, -1.0e9F, 1.0e9F},
    {"feed_speed_m_s", ChannelKind::kSampled, -100.0F, 100.0F},
    {"feed_position_m", ChannelKind::kSampled, -100.0F, 100.0F},
    {"armature_current_a", ChannelKind::kSampled, -2000.0F, 2000.0F},
    {"tool_temperature_degc", ChannelKind::kSampled, -100.0F, 3000.0F},
    {"winding_temperature_degc", ChannelKind::kSampled, -100.0F, 500.0F},
    {"chip_load_mm", ChannelKind::kHeldInput, 0.0F, 10.0F},
    {"spindle_acceleration_rad_s2", ChannelKind::kSampled, -1.0e7F, 1.0e7F},
    {"feed_acceleration_m_s2", ChannelKind::kSampled, -1.0e5F, 1.0e5F},
}};

constexpr const ChannelInfo& info_of(Channel channel) { return kChannels[index_of(channel)]; }

}  // namespace morepro
