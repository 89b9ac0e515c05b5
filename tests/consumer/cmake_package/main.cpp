// The monitor in a C++ program, straight from its headers.
#include <cstdio>

#include "answers.h"
#include "cut.h"
#include "lib/monitor/monitor.hpp"

namespace {

morepro::BoardMonitor monitor;

morepro::SensorFrame to_cpp(const morepro_frame& frame) {
  morepro::SensorFrame to{.sequence = frame.sequence, .time_us = frame.time_us, .present = frame.present};
  for (std::size_t i = 0; i < morepro::kChannelCount; ++i) to.value[i] = frame.value[i];
  return to;
}

void add(answers& a, const morepro::Health& h) {
  add_number(&a, h.sequence);
  add_number(&a, static_cast<std::uint32_t>(h.state));
  add_number(&a, h.reason);
  add_number(&a, h.frame_flags);
  add_number(&a, static_cast<std::uint32_t>(h.chip_load_state));
  add_float(&a, h.chip_load_mm);
  add_float(&a, h.chip_load_standard_error_mm);
  add_number(&a, h.selected_hypothesis);
  for (std::size_t i = 0; i < monitor.hypothesis_count(); ++i) add_float(&a, monitor.probability(i));
  add_float(&a, h.spindle_speed_rad_s);
  add_float(&a, h.feed_speed_m_s);
  add_float(&a, h.armature_current_a);
  add_float(&a, h.innovation_ratio);
  for (const auto& parameter : h.parameters) {
    add_float(&a, parameter.value);
    add_float(&a, parameter.standard_error);
    add_number(&a, static_cast<std::uint32_t>(parameter.status));
  }
  add_number(&a, static_cast<std::uint32_t>(h.gap.verdict));
  add_float(&a, h.gap.evidence);
}

}  // namespace

int main() {
  const morepro_machine reference = morepro_reference_machine();
  cut machine = cut_of(&reference);
  answers seen = no_answers();
  for (std::uint32_t k = 0; k < CUT_FRAMES; ++k) {
    const morepro::Health& health = monitor.step(to_cpp(cut_next(&machine)));
    add(seen, health);
    print_answer(&seen, health.sequence, static_cast<int>(health.state), health.chip_load_mm,
                 health.chip_load_standard_error_mm);
  }
  const auto& reason = morepro::text_of(static_cast<morepro::ReasonCode>(monitor.health().reason));
  std::printf("%s\n", reason.sentence.data());
}
