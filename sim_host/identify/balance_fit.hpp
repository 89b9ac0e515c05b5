#pragma once
#include "lib/identification/derivative_rows.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/identify/axis_identification.hpp"
#include "sim_host/identify/derivative_balance.hpp"

namespace morepro::host {

/// The parameters of one balance from its derivative, as the thesis's filter finds them: Gauss-Newton steps
/// over the whole recording from the values of `configuration`.
///
/// Speeds and currents carry noise. In the slopes of the sample that is being explained it would pull the
/// parameters (errors in the variables); so the slopes are those of the sample before, whose noise is
/// another (instrumental variables), and the covariance is what the residuals show in pieces of the
/// recording, whatever their colour. Combinations that the recording does not tell stay the datasheet's, and
/// as uncertain as one.
template <class Balance>
AxisEstimate fit_balance(DerivativeBalance balance, const RecordingSignals& signals,
                         const MonitorConfiguration& configuration, const OnPass& on_pass);

extern template AxisEstimate fit_balance<TorqueBalance>(DerivativeBalance, const RecordingSignals&,
                                                        const MonitorConfiguration&, const OnPass&);
extern template AxisEstimate fit_balance<ForceBalance>(DerivativeBalance, const RecordingSignals&,
                                                       const MonitorConfiguration&, const OnPass&);
extern template AxisEstimate fit_balance<VoltageBalance>(DerivativeBalance, const RecordingSignals&,
                                                         const MonitorConfiguration&, const OnPass&);

}  // namespace morepro::host
