#pragma once
#include <optional>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// What a speed sensor shows beyond what the recorded angle turns by.
struct ToldBias {
  double bias_rad_s = 0.0;
  double standard_error_rad_s = 0.0;
};

/// By pieces of the recording, of which a sensor's wrong scale and its lag are told apart; absent without an
/// angle, or where the speeds do not tell these. `onset_s`: when the bias sets in, 0 for one from the start.
std::optional<ToldBias> bias_told_by_angle(const RecordingSignals& signals, double onset_s);

/// Deviance by which the recorded angle speaks for the newest effect of a fit, or against it: a bias of the
/// spindle's speed, which voltages and currents hardly tell from an offset of the supply. Zero for all
/// others. At most twice `evidence`, the effect's own, which is enough to be sure.
double angle_evidence(const AxisFit& fit, double evidence);

}  // namespace morepro::host
