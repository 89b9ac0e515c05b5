#ifndef MOREPRO_ERROR_H
#define MOREPRO_ERROR_H

#ifdef __cplusplus
extern "C" {
#endif

/// What a call answers: 0 is success, and after anything else nothing has been changed or written.
typedef int morepro_error;

enum {
  MOREPRO_OK = 0,
  // 1 .. 99: a machine or a configuration was refused.
  MOREPRO_ERROR_NOT_FINITE = 1,
  MOREPRO_ERROR_NOT_POSITIVE = 2,
  MOREPRO_ERROR_NEGATIVE = 3,
  MOREPRO_ERROR_SAMPLING_RATE = 4,
  MOREPRO_ERROR_HYPOTHESIS_COUNT = 5,
  MOREPRO_ERROR_HYPOTHESIS_OUTSIDE_LAW = 6,
  MOREPRO_ERROR_THERMAL_RANGE = 7,
  MOREPRO_ERROR_NOT_A_PROBABILITY = 8,
  MOREPRO_ERROR_MAGNITUDE = 9,
  MOREPRO_ERROR_EFFECT_COUNT = 10,
  MOREPRO_ERROR_EFFECT_UNKNOWN = 11,
  MOREPRO_ERROR_EFFECT_PARTS = 12,
  MOREPRO_ERROR_EFFECT_SHAPE = 13,
  MOREPRO_ERROR_EFFECT_DELAY = 14,
  // From 100 on: the call itself.
  MOREPRO_ERROR_NULL_POINTER = 100,
  MOREPRO_ERROR_NOT_CREATED = 101,     ///< the memory does not hold a monitor
  MOREPRO_ERROR_MISALIGNED = 102,      ///< the memory begins at an address that no morepro_monitor can have
  MOREPRO_ERROR_UNKNOWN_CHOICE = 103,  ///< contact.form or rule is none of its constants
  MOREPRO_ERROR_STEP = 104             ///< a step is not between 0 and 1 s
};

/// One sentence: what is wrong and what to do; of a number that is no error's too. Never NULL, never freed.
const char* morepro_error_text(morepro_error error);

#ifdef __cplusplus
}
#endif

#endif
