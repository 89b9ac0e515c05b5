#include "sim_host/diagnose/signals/sound_samples.hpp"

#include <fmt/format.h>

#include "sim_host/diagnose/signals/current_drive.hpp"
#include "sim_host/diagnose/signals/differenced_speed.hpp"
#include "sim_host/diagnose/signals/lone_samples.hpp"
#include "sim_host/diagnose/signals/speed_of_angle.hpp"
#include "sim_host/diagnose/signals/written_digits.hpp"

namespace morepro::host {

void complete(RecordingSignals& signals, Sensors& sensors, bool has_spindle,
              std::vector<std::string>& notices) {
  for (const Channel channel : leave_out_dead_sensors(signals, sensors))
    notices.push_back(fmt::format("{} never changes although its sensor has noise; it is left out",
                                  kChannels[index_of(channel)].column));
  if (!has_spindle) return;
  if (take_speed_from_angle(signals, sensors))
    notices.push_back("spindle_speed_rad_s is not recorded: it is taken from spindle_angle_rad");
  drive_by_current(signals);
}

std::vector<SamplingFault> make_sound(RecordingSignals& signals, Sensors& sensors, std::uint16_t assumed,
                                      std::vector<std::string>& notices) {
  if (leave_out_derived_speed(signals))
    notices.push_back("feed_speed_m_s is the difference of feed_position_m and says nothing more: left out");
  std::uint16_t of_their_own = signals.has_speed_of_angle ? bit_of(Channel::kSpindleSpeed) : std::uint16_t{0};
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
  for (const LoneSamples& lone : leave_out_lone_samples(signals, sensors))
    notices.push_back(sentence_of(lone, signals));
  calm_temperatures(signals);
  follow_motion(signals);
  return faults;
}

}  // namespace morepro::host
