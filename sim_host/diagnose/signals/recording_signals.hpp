#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/frame/channel.hpp"
#include "lib/gap/effect.hpp"
#include "lib/gap/gap_frame.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::host {

/// Where it is not measured: that of the datasheet.
inline constexpr double kUnmeasuredWindingDegc = 25.0;

/// How the square of the current warms a winding whose temperature was not recorded.
struct WindingHeat {
  double time_s = 0.0;     ///< > 0; 0: it is not warmed
  double rise_k_a2 = 0.0;  ///< of a current that lasts
  bool is_stated = false;  ///< by the machine file; else its course is known, and no size
};

/// A sensor that has shown one value for long, while its axis moved.
struct StuckSensor {
  Channel channel = Channel::kSpindleSpeed;
  std::size_t times = 0;
  std::size_t rows = 0;       ///< of all of them
  std::size_t first_row = 0;  ///< that repeats
};

/// A recording in memory, on its sampling grid: rows that are missing are there, without samples.
struct RecordingSignals {
  double rate_hz = 0.0;
  double start_s = 0.0;
  std::size_t rows = 0;          ///< of the grid
  std::size_t missing_rows = 0;  ///< of the grid, without a frame
  bool is_thinned = false;  ///< neighbouring samples are farther apart than what shakes the machine lasts
  bool is_current_driven = false;  ///< the spindle's voltage is not recorded, it follows from the current
  std::uint16_t recorded = 0;      ///< bit_of(channel) of what was sampled at least once
  std::array<std::vector<float>, kChannelCount> value;  ///< NaN where there is no sample; empty where never
  std::array<std::size_t, kChannelCount>
      impossible{};                  ///< samples that no sensor of that kind gives: not taken
  std::vector<StuckSensor> stuck{};  ///< whose samples were not taken either

  /// Temperatures freed of their sensors' noise; empty: as recorded. A winding's that was not recorded may
  /// follow from its current.
  std::vector<float> calm_tool_degc;
  std::vector<float> calm_winding_degc;
  WindingHeat winding_heat;

  /// Mean square of what an input changes by from row to row: what is not known of one that was lost.
  double lost_voltage_v2 = 0.0;
  double lost_force_n2 = 0.0;

  /// Deviance, by channel, that coarse steps may be worth to a cause: where a signal rests, rounding takes
  /// the same away from all of its samples.
  std::array<double, kChannelCount> rounding_deviance{};
  /// Steps that samples come in, as the machine file has them or as they show; 0: none that is known. Where
  /// hardly a value comes twice nothing shows them.
  std::array<double, kChannelCount> step{};

  std::vector<double> cutting_time_s;  ///< before each row; empty without contact
  /// Way and angle before each row, by the speeds; empty where a sensor shows them, or not followed.
  std::vector<double> travelled_m;
  std::vector<double> turned_rad;

  [[nodiscard]] bool has(Channel channel) const { return (recorded & bit_of(channel)) != 0; }
  /// Is there a current to be predicted from the voltage?
  [[nodiscard]] bool has_electrics() const { return has(Channel::kArmatureCurrent) && !is_current_driven; }
  /// The balance that shows what acts on one: without a current, all that acts on the spindle shows in that
  /// of its torque.
  [[nodiscard]] gap::Balance balance_that_shows(gap::Balance acted_on) const {
    const bool is_hidden = acted_on == gap::Balance::kArmatureVoltage && !has_electrics();
    return is_hidden ? gap::Balance::kSpindleTorque : acted_on;
  }
  [[nodiscard]] double duration_s() const { return static_cast<double>(rows) / rate_hz; }
  [[nodiscard]] double time_s(std::size_t row) const { return static_cast<double>(row) / rate_hz; }
  [[nodiscard]] double cutting_time_at(double time_s) const;
  [[nodiscard]] bool has_been_in_contact() const {
    return !cutting_time_s.empty() && cutting_time_s.back() > 0.0;
  }
  /// The first position that was recorded; 0 without any.
  [[nodiscard]] double first_position_m() const;
  /// The largest magnitude of a channel; 0 where it was not recorded.
  [[nodiscard]] double largest(Channel channel) const;
};

/// Rows that inputs and balances are bridged over; over a longer hole nobody knows what drove the machine.
inline constexpr std::size_t kLongestBridge = 8;

/// Is there nothing in a row of the grid?
bool is_missing(const RecordingSignals& signals, std::size_t row);

/// Rows [first, last) of a recording.
struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The whole recording as one stretch.
inline std::vector<Stretch> all_of(const RecordingSignals& signals) { return {{0, signals.rows}}; }

/// Stretches from everywhere that make up a quarter of a long recording: enough to come near to what all of
/// it says. All of a short one.
std::vector<Stretch> quarter_of(const RecordingSignals& signals);

/// What comes after a time, all of it for one before the start.
Stretch after(const RecordingSignals& signals, double from_s);

/// The first rows of a recording, by themselves.
RecordingSignals beginning_of(const RecordingSignals& signals, std::size_t rows);

/// Fills in what lost inputs may have been.
void doubt_lost_inputs(RecordingSignals& signals);

/// Fills in the cutting time.
void count_cutting_time(RecordingSignals& signals);

/// Fills in way and angle, which nothing but the speeds tells: a run that begins within the recording needs
/// them.
void follow_motion(RecordingSignals& signals);

/// Every `factor`-th sample; inputs become their means over the longer intervals.
RecordingSignals thinned(const RecordingSignals& signals, std::size_t factor);

/// Fills in the calm temperatures: as factors of a torque their noise would be taken for something that
/// follows the temperature. Means over as many samples before as after, so that nothing lags behind, from
/// 4 ms up to a second where the temperature rests.
void calm_temperatures(RecordingSignals& signals);

/// Turns the rows of a recording into what the observers take: held inputs stay where they are missing,
/// quantities that were never recorded get the machine's own value.
class FrameSource {
 public:
  enum class Temperatures : std::uint8_t { kCalm, kAsRecorded };
  /// Begins at row `first`. Calm temperatures where the signals have them.
  FrameSource(const RecordingSignals& signals, const MachineParameters& machine, std::size_t first,
              Temperatures temperatures = Temperatures::kCalm);

  /// Row by row.
  gap::GapFrame<double> next();
  [[nodiscard]] std::size_t row() const { return row_; }
  /// Are the inputs of the last frame those of a row before, because its own was lost?
  [[nodiscard]] bool has_lost_inputs() const { return missing_ > 0; }
  /// Have more rows been missing, up to the last frame, than inputs are held over?
  [[nodiscard]] bool has_lost_track() const { return missing_ > kLongestBridge; }

 private:
  bool sampled(Channel channel, double& value) const;

  const RecordingSignals& signals_;
  std::array<const float*, kChannelCount>
      column_{};  ///< none: nothing is recorded; of temperatures the calm ones
  std::size_t row_ = 0;
  std::size_t missing_ = 0;  ///< rows in a row
  double cutting_time_s_ = 0.0;
  PlantInput<double> input_;
  double winding_degc_;
};

}  // namespace morepro::host
