/* The interface for C on a board: exit status 0 where every answer is right. That the image links shows that
 * it needs no heap, no exceptions and no C mathematics library. */
#include <morepro.h>
#include <string.h>

#define FRAMES 2000U

static morepro_monitor monitor;

static uint32_t random_number = 1;

/* Within +-1. */
static float noise(void) {
  random_number = 1664525U * random_number + 1013904223U;
  return (float)(int32_t)(random_number >> 8) / 8388608.0F - 1.0F;
}

static int is_refused(void) {
  const char* key = NULL;
  morepro_health health;
  morepro_configuration configuration = morepro_reference_configuration();
  configuration.machine.spindle.inertia_kgm2 = -1.0;
  return morepro_monitor_health(&monitor, &health) == MOREPRO_ERROR_NOT_CREATED &&
         morepro_monitor_reset(NULL) == MOREPRO_ERROR_NULL_POINTER &&
         morepro_monitor_create(&monitor, &configuration, &key) == MOREPRO_ERROR_NOT_POSITIVE &&
         strcmp(key, "spindle.inertia_kgm2") == 0;
}

/* A machine at rest: nothing to know about its tool, and a speed of 0. */
static int is_watched(void) {
  const morepro_configuration configuration = morepro_reference_configuration();
  morepro_health health;
  if (morepro_monitor_create(&monitor, &configuration, NULL) != MOREPRO_OK) return 0;
  for (uint32_t k = 0; k < FRAMES; ++k) {
    morepro_frame frame = {0, 0, 0, {0}};
    frame.sequence = k;
    frame.time_us = 100U * k;
    morepro_frame_set(&frame, MOREPRO_ARMATURE_VOLTAGE_V, 0.0F);
    morepro_frame_set(&frame, MOREPRO_CONTACT, 0.0F);
    morepro_frame_set(&frame, MOREPRO_SPINDLE_SPEED_RAD_S, noise());
    morepro_frame_set(&frame, MOREPRO_ARMATURE_CURRENT_A, 0.05F * noise());
    if (morepro_monitor_step(&monitor, &frame, &health) != MOREPRO_OK) return 0;
  }
  return health.frames_accepted == FRAMES && health.frames_rejected == 0 &&
         health.state == MOREPRO_NOT_ENOUGH_DATA && !health.chip_load_is_valid &&
         strcmp(morepro_reason_of(health.reason).name, "WEAR_NO_CONTACT") == 0 &&
         health.spindle_speed_rad_s > -0.5F && health.spindle_speed_rad_s < 0.5F &&
         strcmp(morepro_effect_name(morepro_effect_named("feed_spring")), "feed_spring") == 0;
}

int main(void) {
  if (!is_refused()) return 1;
  return is_watched() ? 0 : 2;
}
