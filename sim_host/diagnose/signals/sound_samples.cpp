#include "sim_host/diagnose/signals/sound_samples.hpp"

#include <fmt/format.h>

#include "sim_host/diagnose/signals/differenced_speed.hpp"
#include "sim_host/diagnose/signals/lone_samples.hpp"
#include "sim_host/diagnose/signals/stuck_samples.hpp"
#include "sim_host/diagnose/signals/written_digits.hpp"

namespace morepro::host {

std::vector<SamplingFault> make_sound(RecordingSignals& signals, Sensors& sensors, std::uint16_t assumed,
                                      std::vector<std::string>& notices) {
  if (leave_out_derived_speed(signals))
    notices.push_back("feed_speed_m_s is the difference of feed_position_m and says nothing more: left out");
  std::uint16_t of_their_own = 0;
  for (const WrittenDigits& written : allow_for_digits(signals, sensors)) {
    notices.push_back(sentence_of(written));
    of_their_own = static_cast<std::uint16_t>(of_their_own | bit_of(written.channel));
  }
  std::vector<SamplingFault> faults = find_quantization(signals, sensors, assumed, of_their_own);
  for (const Channel channel : allow_for_differences(signals, sensors))
    notices.push_back(fmt::format(
        "{} is the difference of a rounded position: twice the variance of its steps is taken for noise",
        kChannels[index_of(channel)].column));
  if (auto dropout = find_dropout(signals)) faults.push_back(*dropout);
  if (signals.missing_rows > 0) doubt_lost_inputs(signals);
  leave_out_stuck_samples(signals, sensors);
  for (const StuckSensor& stuck : signals.stuck) notices.push_back(sentence_of(stuck, signals));
  for (const LoneSamples& lone : leave_out_lone_samples(signals, sensors))
    notices.push_back(sentence_of(lone, signals));
  calm_temperatures(signals);
  follow_motion(signals);
  return faults;
}

}  // namespace morepro::host
