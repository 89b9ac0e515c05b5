#ifndef MOREPRO_CONFIGURATION_H
#define MOREPRO_CONFIGURATION_H
#include <stdint.h>

#include "morepro_frame.h"
#include "morepro_machine.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Most hypotheses of the bank.
#define MOREPRO_HYPOTHESES 11
/// Most effects that a monitor takes out of its frames.
#define MOREPRO_MOST_EFFECTS 4
/// Most coefficients of one effect.
#define MOREPRO_MOST_PARTS 4
/// Most forms of effects that a monitor looks for on an axis instead of its own; together they have at most
/// MOREPRO_MOST_PARTS parts.
#define MOREPRO_MOST_FORMS 4

/// Standard deviation of a sensor's noise and size of its last bit, in the channel's unit, 0 .. 1e5. Zero
/// where a machine has no such sensor or its noise is not known.
typedef struct morepro_sensor {
  double noise;
  double lsb;
} morepro_sensor;

enum { MOREPRO_RULE_MARKOV = 0, MOREPRO_RULE_BAYESIAN = 1, MOREPRO_RULE_THESIS = 2 };

/// A form of an effect, as [[gap.forms]] of a machine file that `morepro diagnose --apply` wrote.
typedef struct morepro_form {
  uint8_t effect;  ///< morepro_effect_named()
  uint8_t kind;    ///< among the laws of one effect
  uint8_t parts;   ///< 1 .. MOREPRO_MOST_PARTS, of an unknown size each; 0: the effect is not looked for
  float shape;     ///< what the law is not linear in, >= 0
} morepro_form;

/// What a host has found by simulating the machine without an effect in the same excitation.
typedef struct morepro_gap_limits {
  double evidence;          ///< > 0, that chance does not reach
  double temperature;       ///< >= 1: how much more evidence chance makes than independent rows would
  double excitation;        ///< > 0: how many times better than its datasheet each parameter must be known
  double noise_ratio;       ///< > 0: residual power of the machine without a gap over that of expected noise
  double parameter_spread;  ///< > 0: how far the machine's values may be off, as a standard deviation;
                            ///< relative
  struct {
    morepro_form form[MOREPRO_MOST_FORMS];  ///< those behind `count` mean nothing
    uint32_t count;
  } forms;
} morepro_gap_limits;

/// An effect that the machine is known to have, as in a machine file that `morepro diagnose --apply` wrote.
typedef struct morepro_effect {
  uint8_t effect;  ///< morepro_effect_named()
  uint8_t kind;    ///< among the laws of one effect
  uint8_t parts;   ///< 1 .. MOREPRO_MOST_PARTS
  float shape;     ///< what the law is not linear in, >= 0
  double coefficient[MOREPRO_MOST_PARTS];
  double onset_s;  ///< sets in at this time after the first frame, >= 0
} morepro_effect;

/// Everything that a monitor needs to know before its first frame. Begin with one of the two below and change
/// what is different.
typedef struct morepro_configuration {
  morepro_machine machine;
  morepro_sensor sensors[MOREPRO_CHANNELS];
  double rate_hz;  ///< sampling, 100 .. 20000
  /// Chip loads that the bank holds: hypothesis j is first_mm + j step_mm.
  struct {
    double first_mm;  ///< > 0
    double step_mm;   ///< > 0
    uint32_t count;   ///< 1 .. MOREPRO_HYPOTHESES
  } grid;
  /// Standard deviations are those that one sample adds.
  struct {
    double speed_process_noise_rad_s;  ///< > 0
    double current_process_noise_a;    ///< > 0
    double feed_process_noise_m_s;     ///< > 0
    double chip_load_drift_mm;         ///< of the continuous chip load, >= 0
    double switch_probability;         ///< per sample, for the Markov rule, in (0, 1)
    double parameter_start_fraction;   ///< standard deviation of the datasheet's values, relative, > 0
  } tuning;
  /// The chip load that the torque looks like, divided by the commanded one.
  struct {
    double watch_ratio;          ///< >= 1
    double replace_ratio;        ///< >= watch_ratio
    double low_ratio;            ///< in (0, 1]: below, the tool does not cut what it should
    double hold_s;               ///< how long it must last, >= 0
    double datasheet_tolerance;  ///< of motor torque and viscous friction, relative, >= 0
  } wear;
  /// For the search of what the model lacks; standard deviations that one sample adds, >= 0.
  struct {
    double speed_process_noise_rad_s;
    double current_process_noise_a;
    double feed_process_noise_m_s;
    double lost_share;      ///< of its frames that a good link loses, 0 .. 1; 0: nobody looks
    double clock_jitter_s;  ///< standard deviation of the sampling instants, as far as it is known
    morepro_gap_limits spindle;
    morepro_gap_limits feed;
  } gap;
  struct {
    morepro_effect effect[MOREPRO_MOST_EFFECTS];  ///< those behind `count` mean nothing
    uint32_t count;                               ///< 0 .. MOREPRO_MOST_EFFECTS
  } effects;
  uint8_t rule;  ///< MOREPRO_RULE_...
} morepro_configuration;

/// The reference machine at 10 kHz with plausible sensors; hypotheses 0.02 .. 0.11 mm.
morepro_configuration morepro_reference_configuration(void);

/// The machine of the thesis at 10 kHz; hypotheses 0.1 .. 1.1 mm.
morepro_configuration morepro_thesis_configuration(void);

/// Number of the effect with that name, as `morepro effects` lists them; -1 where there is none or `name` is
/// NULL.
int morepro_effect_named(const char* name);

/// Name of an effect; "unnamed" for structure that the catalogue has no name for, and for any other number.
const char* morepro_effect_name(int effect);

#ifdef __cplusplus
}
#endif

#endif
