#ifndef MOREPRO_HEALTH_H
#define MOREPRO_HEALTH_H
#include <stdint.h>

#include "morepro_configuration.h"

#ifdef __cplusplus
extern "C" {
#endif

/// morepro_health::state.
enum {
  MOREPRO_NOT_ENOUGH_DATA = 0,
  MOREPRO_HEALTHY = 1,
  MOREPRO_WATCH = 2,
  MOREPRO_REPLACE = 3,
  MOREPRO_SENSOR_FAULT = 4,
  MOREPRO_MODEL_GAP = 5
};

/// Bits of morepro_health::frame_flags: what was unusual about this frame.
enum {
  MOREPRO_FRAME_DUPLICATE = 1 << 0,        ///< same sequence number again: ignored
  MOREPRO_FRAME_OLD = 1 << 1,              ///< sequence number or time runs backwards: ignored
  MOREPRO_FRAME_MISSING_BEFORE = 1 << 2,   ///< frames are missing before this one: the gap was predicted
  MOREPRO_FRAME_TIME_JUMP = 1 << 3,        ///< the gap is too long to predict: the estimators start again
  MOREPRO_FRAME_NOT_FINITE = 1 << 4,       ///< a NaN or an infinity: that channel was not used
  MOREPRO_FRAME_OUT_OF_RANGE = 1 << 5,     ///< a value no sensor of this kind gives: not used
  MOREPRO_FRAME_INNOVATION_GATE = 1 << 6,  ///< a value too far from its prediction: not used
  MOREPRO_FRAME_STUCK = 1 << 7,            ///< a channel has repeated one value for too long: not used
  MOREPRO_FRAME_ESTIMATOR_RESET = 1 << 8,  ///< an estimator was re-initialised
  MOREPRO_FRAME_SPEED_LOW = 1 << 9,        ///< cutting speed below the contact law's range
  MOREPRO_FRAME_SPEED_HIGH = 1 << 10,      ///< cutting speed above the contact law's range
  MOREPRO_FRAME_NO_INPUT = 1 << 11,        ///< neither voltage nor feed force was ever seen
  MOREPRO_FRAME_SEQUENCE_RESET = 1 << 12,  ///< the sender started again from another sequence number
  MOREPRO_FRAME_JUMP = 1 << 13             ///< a slow quantity jumped: that channel was not used
};

/// Indices of morepro_health::parameters, with the unit of value and standard error.
enum {
  MOREPRO_TORQUE_CONSTANT_NM_A = 0,
  MOREPRO_INERTIA_KGM2 = 1,
  MOREPRO_MASS_KG = 2,
  MOREPRO_CONTACT_FORCE_N = 3,
  MOREPRO_INDUCTANCE_H = 4,
  MOREPRO_RESISTANCE_OHM = 5,
  MOREPRO_BACK_EMF_CONSTANT_VS_RAD = 6,
  MOREPRO_PARAMETERS = 7
};

/// morepro_parameter::status.
enum {
  MOREPRO_PARAMETER_NO_SIGNAL = 0,          ///< a channel that it needs is not there
  MOREPRO_PARAMETER_NO_EXCITATION = 1,      ///< no information in the frames that may teach it (so far)
  MOREPRO_PARAMETER_CORRELATED = 2,         ///< only a combination with another parameter is determined
  MOREPRO_PARAMETER_MODEL_MISMATCH = 3,     ///< the model does not fit, so its parameters mean nothing
  MOREPRO_PARAMETER_SAMPLING_TOO_SLOW = 4,  ///< fewer than one sample within L/R
  MOREPRO_PARAMETER_IDENTIFIABLE = 5
};

/// morepro_parameter::partner: the index of a parameter, or one of these.
enum {
  MOREPRO_PARTNER_CONTACT_OFFSET_N =
      MOREPRO_PARAMETERS,  ///< contact_offset_n of the machine, never identified
  MOREPRO_PARTNER_NONE = 255
};

/// value +- standard_error where is_identifiable, else the last value with its (large) standard error.
typedef struct morepro_parameter {
  float value;
  float standard_error;
  uint8_t status;           ///< MOREPRO_PARAMETER_...
  uint8_t is_identifiable;  ///< 1 or 0
  uint8_t partner;          ///< only a combination with it is determined; read with CORRELATED, IDENTIFIABLE
} morepro_parameter;

/// morepro_gap::verdict.
enum {
  MOREPRO_GAP_NOT_ENOUGH_DATA = 0,
  MOREPRO_GAP_NONE = 1,
  MOREPRO_GAP_INSUFFICIENT_EXCITATION = 2,
  MOREPRO_GAP_PARAMETER_ERROR = 3,  ///< other values of the machine's parameters explain it
  MOREPRO_GAP_UNEXPLAINED = 4,
  MOREPRO_GAP_EFFECT = 5
};

/// morepro_gap::where.
enum {
  MOREPRO_SPINDLE_TORQUE = 0,
  MOREPRO_FEED_FORCE = 1,
  MOREPRO_ARMATURE_VOLTAGE = 2,
  MOREPRO_SENSOR = 3,
  MOREPRO_SAMPLING = 4
};

#define MOREPRO_MOST_ALIASES 2

/// Between machine and model, from all that was seen so far.
typedef struct morepro_gap {
  uint8_t verdict;                      ///< MOREPRO_GAP_...
  uint8_t where;                        ///< meaningful for MOREPRO_GAP_EFFECT, as the following ones
  uint8_t effect;                       ///< morepro_effect_name()
  uint8_t alias_count;                  ///< 0 .. MOREPRO_MOST_ALIASES
  uint8_t alias[MOREPRO_MOST_ALIASES];  ///< effects that explain it nearly as well
  float confidence;                     ///< 0 .. 1, that it is this effect or an alias of it
  float evidence;                       ///< n ln(RSS without / RSS with) - dof ln n; of any verdict
} morepro_gap;

/// What the monitor says after one frame.
typedef struct morepro_health {
  uint32_t sequence;  ///< of the frame that this answers
  uint32_t time_us;
  uint8_t state;               ///< MOREPRO_NOT_ENOUGH_DATA .. MOREPRO_MODEL_GAP
  uint16_t reason;             ///< morepro_reason_of()
  uint16_t frame_flags;        ///< MOREPRO_FRAME_... bits
  uint16_t rejected_channels;  ///< bit 1 << channel: a value of this frame that was not used
  uint32_t frames_accepted;
  uint32_t frames_rejected;
  uint32_t frames_missing;
  uint8_t chip_load_is_valid;  ///< 1, or 0 = undetermined: the following two mean nothing
  float chip_load_mm;
  float chip_load_standard_error_mm;
  uint8_t hypothesis_count;
  uint8_t selected_hypothesis;  ///< meaningful where chip_load_is_valid
  float selected_probability;
  float probability[MOREPRO_HYPOTHESES];  ///< of each hypothesis, 0 .. 1; 0 behind hypothesis_count
  float spindle_speed_rad_s;
  float feed_speed_m_s;
  float armature_current_a;
  float innovation_ratio;  ///< windowed mean normalised innovation squared, 1 = as the model expects
  morepro_parameter parameters[MOREPRO_PARAMETERS];
  morepro_gap gap;
} morepro_health;

/// What a reason code means to whoever reads it on a screen. The strings are never NULL and never freed.
typedef struct morepro_reason {
  const char* name;       ///< for example SENSOR_STUCK
  const char* sentence;   ///< what was seen
  const char* cause;      ///< the likely cause
  const char* next_step;  ///< what to do first
} morepro_reason;

/// The texts of morepro_health::reason; of "NONE" for a number that is no reason's.
morepro_reason morepro_reason_of(uint16_t reason);

#ifdef __cplusplus
}
#endif

#endif
