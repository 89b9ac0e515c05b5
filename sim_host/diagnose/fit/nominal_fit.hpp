#pragma once
#include <optional>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// Are the innovations what the observer expects of them, new and of their size?
bool leaves_noise(const AxisFit& fit);

/// Does it believe in more than three times the process noise that is usual? And of what moves it?
bool needs_noise(const AxisFit& fit);
bool needs_random_forces(const AxisFit& fit);

/// Fits of the model without effects that a search may begin with, one or two, the likelier one first.
/// `start` has the datasheet's parameters. Two ways lead there: process noise that is fitted to a datasheet
/// far off leaves the parameters where they are, and parameters that are fitted without any bend to what it
/// does. Where neither end leaves noise only, an observer that looks one step ahead may still find one.
std::vector<AxisFit> nominal_fits(const AxisFit& start);

/// A further beginning where a search came to no good end: what fits the first third of the recording alone,
/// before something may have set in. None where the model `fitted` to everything is as good there.
std::optional<AxisFit> fit_of_beginning(const AxisFit& fitted);

}  // namespace morepro::host
