#ifndef MOREPRO_MONITOR_H
#define MOREPRO_MONITOR_H
#include <stdint.h>

#include "morepro_configuration.h"
#include "morepro_error.h"
#include "morepro_frame.h"
#include "morepro_health.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Room of a monitor in bytes; the library does not compile where it is too small or wastes more than 512.
#if UINTPTR_MAX > 0xFFFFFFFFU
#define MOREPRO_MONITOR_BYTES 46080
#else
#define MOREPRO_MONITOR_BYTES 45056
#endif

/// The memory of one monitor, which its user owns: static, on a stack that is large enough, or a member. It
/// holds no pointers, so a copy is a monitor too (a snapshot). Nothing in it may be read or written directly.
typedef struct morepro_monitor {
  uint64_t private_mark;
  union {
    uint64_t alignment;
    unsigned char bytes[MOREPRO_MONITOR_BYTES];
  } private_memory;
} morepro_monitor;

// The same frames give the same bits as the C++ monitor, on every machine. No call allocates, blocks, throws
// or reads a clock. One monitor may be used by one thread or interrupt at a time; several monitors share
// nothing.
//
// Every call below answers MOREPRO_ERROR_NULL_POINTER for NULL (unless it says otherwise),
// MOREPRO_ERROR_MISALIGNED for memory that cannot be a morepro_monitor's, and all but the first
// MOREPRO_ERROR_NOT_CREATED for memory that morepro_monitor_create() has not made a monitor.

/// Makes a monitor in `monitor`, or makes the one that is there forget everything and take another
/// configuration. `refused_key`, unless NULL, is set to the name of the value that was refused ("" where
/// there is none), for example "spindle.inertia_kgm2". Errors: those of the configuration (1 .. 99),
/// MOREPRO_ERROR_UNKNOWN_CHOICE. After an error `monitor` is as it was. Takes 3.1 KB of stack on a
/// Cortex-M4F and thousands of instructions: not for interrupts.
morepro_error morepro_monitor_create(morepro_monitor* monitor, const morepro_configuration* configuration,
                                     const char** refused_key);

/// One frame in, one answer out. A frame that is late, double or wrong is no error: frame_flags and
/// rejected_channels of the answer say what was not used. Bounded time, 976 B of stack on a Cortex-M4F; may
/// run in an interrupt.
morepro_error morepro_monitor_step(morepro_monitor* monitor, const morepro_frame* frame,
                                   morepro_health* health);

/// The last answer again; zeros before the first frame.
morepro_error morepro_monitor_health(const morepro_monitor* monitor, morepro_health* health);

/// Forgets everything measured so far and keeps the configuration. As long as creating one; not for
/// interrupts.
morepro_error morepro_monitor_reset(morepro_monitor* monitor);

/// Somebody changed the tool: its wear starts anew.
morepro_error morepro_monitor_tool_changed(morepro_monitor* monitor);

/// The link dropped something that was no frame: counts it as rejected.
morepro_error morepro_monitor_count_corrupt(morepro_monitor* monitor);

#ifdef __cplusplus
}
#endif

#endif
