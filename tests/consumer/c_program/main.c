/* A monitor in a C program: its memory, its configuration, one call per frame. */
#include <morepro.h>
#include <stdio.h>

#include "answers.h"
#include "cut.h"

static morepro_monitor monitor;

static void add(answers* a, const morepro_health* h) {
  add_number(a, h->sequence);
  add_number(a, h->state);
  add_number(a, h->reason);
  add_number(a, h->frame_flags);
  add_number(a, h->chip_load_is_valid);
  add_float(a, h->chip_load_mm);
  add_float(a, h->chip_load_standard_error_mm);
  add_number(a, h->selected_hypothesis);
  for (int i = 0; i < h->hypothesis_count; ++i) add_float(a, h->probability[i]);
  add_float(a, h->spindle_speed_rad_s);
  add_float(a, h->feed_speed_m_s);
  add_float(a, h->armature_current_a);
  add_float(a, h->innovation_ratio);
  for (int i = 0; i < MOREPRO_PARAMETERS; ++i) {
    add_float(a, h->parameters[i].value);
    add_float(a, h->parameters[i].standard_error);
    add_number(a, h->parameters[i].status);
  }
  add_number(a, h->gap.verdict);
  add_float(a, h->gap.evidence);
}

static int refused(morepro_error error, const char* key) {
  fprintf(stderr, "%s: %s\n", key, morepro_error_text(error));
  return 1;
}

int main(void) {
  const morepro_configuration configuration = morepro_reference_configuration();
  const char* key = "";
  morepro_error error = morepro_monitor_create(&monitor, &configuration, &key);
  if (error != MOREPRO_OK) return refused(error, key);

  cut machine = cut_of(&configuration.machine);
  answers seen = no_answers();
  morepro_health health;
  for (uint32_t k = 0; k < CUT_FRAMES; ++k) {
    const morepro_frame frame = cut_next(&machine);
    error = morepro_monitor_step(&monitor, &frame, &health);
    if (error != MOREPRO_OK) return refused(error, "frame");
    add(&seen, &health);
    print_answer(&seen, health.sequence, health.state, health.chip_load_mm,
                 health.chip_load_standard_error_mm);
  }
  printf("%s\n", morepro_reason_of(health.reason).sentence);
  return 0;
}
