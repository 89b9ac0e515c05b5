#pragma once
#include <optional>

#include "lib/gap/gap_frame.hpp"
#include "lib/identification/derivative_rows.hpp"
#include "lib/plant/contact_law.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// A derivative, and what its balance is evaluated with at the same time.
struct DerivativeSample {
  DerivativeInput<double> input;
  double derivative = 0.0;
};

/// Is the derivative of a balance recorded? If not it is a difference over one sampling period, and the
/// balance is taken in its mean over that period.
bool is_measured(DerivativeBalance balance, const RecordingSignals& signals);

/// What the mean of a current over a period of so many L/R leaves in the inductance, relative.
double mean_current_error(double period);

/// A recording as the three balances see it, row by row.
class DerivativeSource {
 public:
  /// `machine`: what the contact torque and the means over a period are made with.
  DerivativeSource(const RecordingSignals& signals, const MachineParameters& machine,
                   DerivativeBalance balance);

  /// To the next row; false behind the last.
  bool next();
  /// Of this row. Without a value where a sample is missing.
  [[nodiscard]] std::optional<DerivativeSample> sample() const;
  /// Of the row before: its noise is not in sample().
  [[nodiscard]] std::optional<DerivativeInput<double>> before() const;

 private:
  struct Instant {
    DerivativeInput<double> input;
    double chip_load_mm = 0.0, tool_temperature_degc = 0.0;
    double acceleration = 0.0;  ///< the one of the balance's axis; NaN where there is no sample
    bool is_complete = false;
  };
  Instant read();
  [[nodiscard]] double contact_torque(const Instant& inputs, double speed_rad_s) const;
  [[nodiscard]] bool is_complete(const gap::GapFrame<double>& frame) const;
  [[nodiscard]] double difference() const;
  [[nodiscard]] DerivativeInput<double> mean() const;

  const RecordingSignals& signals_;
  const MachineParameters& machine_;
  DerivativeBalance balance_;
  bool is_measured_;
  ContactLaw<double> law_;
  FrameSource frames_;
  std::size_t row_ = 0;
  Instant before_, now_, after_;
};

}  // namespace morepro::host
