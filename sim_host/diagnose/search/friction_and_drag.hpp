#pragma once
#include <cstddef>
#include <optional>

#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// Dry friction and the drag of the air, which every spindle has, bend together like one Stribeck curve of a
/// wide range beside another viscous friction, and a curve with its range and its bend wins what is looked
/// for one after the other. The fit with both instead of the finding `index`, such a curve, or with friction
/// alone where the drag has no size: they are the last of its effects, friction behind drag. Nothing where
/// they are not nearly as likely.
std::optional<AxisFit> friction_and_drag_instead(const AxisDiagnosis& diagnosis, std::size_t index,
                                                 bool may_drag);

}  // namespace morepro::host
