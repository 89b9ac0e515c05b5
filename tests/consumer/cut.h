#ifndef CUT_H
#define CUT_H
/// What a board would measure of a cut: 0.2 s in air, then in contact at the commanded chip load. Plain
/// arithmetic in one order, so that every program here sees the same bits.
#include <morepro_frame.h>
#include <morepro_plant.h>

#define CUT_FRAMES 6000U
#define CUT_CONTACT_FRAME 2000U
#define CUT_CHIP_LOAD_MM 0.05
#define CUT_STEP_S 1.0e-4

typedef struct cut {
  morepro_machine machine;
  double state[MOREPRO_STATES];
  uint32_t frames;
  uint32_t random;
} cut;

static inline cut cut_of(const morepro_machine* machine) {
  cut c = {*machine, {0.0, 0.0, 0.0}, 0, 1};
  return c;
}

/// Nearly normal, standard deviation 1.
static inline double cut_noise(cut* c) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) {
    c->random = 1664525U * c->random + 1013904223U;
    sum += (double)(c->random >> 8) / 16777216.0;
  }
  return sum;
}

/// The next frame; moves the machine on by one sampling interval.
static inline morepro_frame cut_next(cut* c) {
  const double contact = c->frames >= CUT_CONTACT_FRAME ? 1.0 : 0.0;
  const double input[MOREPRO_INPUTS] = {48.0, 26.0, contact, 1.0, CUT_CHIP_LOAD_MM, 500.0};
  morepro_frame frame = {0, 0, 0, {0}};
  frame.sequence = c->frames;
  frame.time_us = 100U * c->frames;
  morepro_frame_set(&frame, MOREPRO_ARMATURE_VOLTAGE_V, 48.0F);
  morepro_frame_set(&frame, MOREPRO_FEED_FORCE_N, 26.0F);
  morepro_frame_set(&frame, MOREPRO_CONTACT, (float)contact);
  morepro_frame_set(&frame, MOREPRO_ENGAGEMENT, 1.0F);
  morepro_frame_set(&frame, MOREPRO_SPINDLE_SPEED_RAD_S,
                    (float)(c->state[MOREPRO_STATE_SPEED_RAD_S] + cut_noise(c)));
  morepro_frame_set(&frame, MOREPRO_ARMATURE_CURRENT_A,
                    (float)(c->state[MOREPRO_STATE_CURRENT_A] + 0.05 * cut_noise(c)));
  morepro_frame_set(&frame, MOREPRO_FEED_SPEED_M_S,
                    (float)(c->state[MOREPRO_STATE_FEED_SPEED_M_S] + 0.002 * cut_noise(c)));
  morepro_frame_set(&frame, MOREPRO_TOOL_TEMPERATURE_DEGC, 500.0F);
  morepro_frame_set(&frame, MOREPRO_CHIP_LOAD_MM, (float)CUT_CHIP_LOAD_MM);

  double next[MOREPRO_STATES] = {0.0, 0.0, 0.0};
  morepro_plant_step(&c->machine, CUT_STEP_S, c->state, input, next);
  for (int i = 0; i < MOREPRO_STATES; ++i) c->state[i] = next[i];
  ++c->frames;
  return frame;
}

#endif
