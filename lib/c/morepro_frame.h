#ifndef MOREPRO_FRAME_H
#define MOREPRO_FRAME_H
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Indices of morepro_frame::value and of morepro_configuration::sensors; the unit stands in the name. Held:
/// applied from this frame's time to the next one's. Sampled: measured at this frame's time. A value outside
/// of its range is not used, and flagged.
enum {
  MOREPRO_ARMATURE_VOLTAGE_V = 0,            ///< held, -1000 .. 1000
  MOREPRO_FEED_FORCE_N = 1,                  ///< held, -1e6 .. 1e6
  MOREPRO_CONTACT = 2,                       ///< held, 0 = air, 1 = the tool cuts
  MOREPRO_ENGAGEMENT = 3,                    ///< held, 0 .. 10
  MOREPRO_SPINDLE_SPEED_RAD_S = 4,           ///< sampled, -2e4 .. 2e4
  MOREPRO_SPINDLE_ANGLE_RAD = 5,             ///< sampled, -1e9 .. 1e9
  MOREPRO_FEED_SPEED_M_S = 6,                ///< sampled, -100 .. 100
  MOREPRO_FEED_POSITION_M = 7,               ///< sampled, -100 .. 100
  MOREPRO_ARMATURE_CURRENT_A = 8,            ///< sampled, -2000 .. 2000
  MOREPRO_TOOL_TEMPERATURE_DEGC = 9,         ///< sampled, -100 .. 3000
  MOREPRO_WINDING_TEMPERATURE_DEGC = 10,     ///< sampled, -100 .. 500
  MOREPRO_CHIP_LOAD_MM = 11,                 ///< held, 0 .. 10: the commanded feed per tooth
  MOREPRO_SPINDLE_ACCELERATION_RAD_S2 = 12,  ///< sampled, -1e7 .. 1e7
  MOREPRO_FEED_ACCELERATION_M_S2 = 13,       ///< sampled, -1e5 .. 1e5
  MOREPRO_CHANNELS = 14
};

/// One sample of every channel.
typedef struct morepro_frame {
  uint32_t sequence;              ///< +1 per frame, wraps
  uint32_t time_us;               ///< microseconds since an arbitrary start, wraps after 71.6 minutes
  uint16_t present;               ///< bit 1 << channel set: value[channel] was measured
  float value[MOREPRO_CHANNELS];  ///< of a channel that is not present: anything
} morepro_frame;

/// Puts a measured value into a frame. `channel`: one of the constants above, nothing happens for another
/// number.
static inline void morepro_frame_set(morepro_frame* frame, int channel, float value) {
  if (channel < 0 || channel >= MOREPRO_CHANNELS) return;
  frame->value[channel] = value;
  frame->present = (uint16_t)(frame->present | (1U << channel));
}

#ifdef __cplusplus
}
#endif

#endif
