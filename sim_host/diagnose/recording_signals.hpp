#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/frame/channel.hpp"
#include "lib/gap/gap_frame.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::host {

/// A recording in memory, on its sampling grid: rows that are missing are there, without samples.
struct RecordingSignals {
  double rate_hz = 0.0;
  double start_s = 0.0;
  std::size_t rows = 0;          ///< of the grid
  std::size_t missing_rows = 0;  ///< of the grid, without a frame
  bool is_thinned = false;     ///< neighbouring samples are farther apart than what shakes the machine lasts
  std::uint16_t recorded = 0;  ///< bit_of(channel) of what was sampled at least once
  std::array<std::vector<float>, kChannelCount> value;  ///< NaN where there is no sample; empty where never

  [[nodiscard]] bool has(Channel channel) const { return (recorded & bit_of(channel)) != 0; }
  [[nodiscard]] double duration_s() const { return static_cast<double>(rows) / rate_hz; }
  [[nodiscard]] double time_s(std::size_t row) const { return static_cast<double>(row) / rate_hz; }
};

/// Every `factor`-th sample; inputs become their means over the longer intervals.
RecordingSignals thinned(const RecordingSignals& signals, std::size_t factor);

/// Turns the rows of a recording into what the observers take: held inputs stay where they are missing,
/// quantities that were never recorded get the machine's own value.
class FrameSource {
  /// A temperature, freed of most of its sensor's noise: as a factor of a torque that would be taken for
  /// something that follows the temperature.
  struct SlowSignal {
    double value = 0.0;
    bool is_measured = false;
  };

 public:
  /// Begins at row `first`.
  FrameSource(const RecordingSignals& signals, const MachineParameters& machine, std::size_t first);

  /// Row by row.
  gap::GapFrame<double> next();
  [[nodiscard]] std::size_t row() const { return row_; }

 private:
  double held(Channel channel, double& value) const;
  bool sampled(Channel channel, double& value) const;
  void follow(Channel channel, SlowSignal& signal) const;

  const RecordingSignals& signals_;
  std::size_t row_ = 0;
  double cutting_time_s_ = 0.0;
  PlantInput<double> input_;
  SlowSignal tool_;
  SlowSignal winding_;
};

}  // namespace morepro::host
