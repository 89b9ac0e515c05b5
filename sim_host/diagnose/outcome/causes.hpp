#pragma once
#include <cstddef>
#include <optional>
#include <span>

#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// Independent causes among the effects of an axis: the parts of friction are one, and what only gives
/// another one its shape is none.
std::size_t causes_of(std::span<const Finding> found);

/// Are there two names, of slow laws, and is the weaker one worth so little of the stronger that it may be
/// what the stronger one's shape leaves, or both what a cause without a name looks like? Not where one of
/// them brakes a spindle and the other one does not: what either leaves is elsewhere.
bool may_be_one_cause(std::span<const Finding> found);

/// Is this one of them, without other parts?
bool is_cause_of_its_own(std::span<const Finding> found, std::size_t index);

/// Are both, of one axis, parts of its friction?
bool are_of_one_friction(const Finding& one, const Finding& other);

/// The larger one whose shape this one is: a delay beside the lag of the same signal, which has more than one
/// pole then; beside a drive's lag one that both sensors have; friction that is a little stronger at rest, or
/// lasts a little longer at speed; a little force beside friction that depends on the direction, which goes
/// with another power of the speed then, or any of its sense without a dry friction, which is the dry part of
/// it. Nothing where it stands for itself.
std::optional<std::size_t> shaped_by(std::span<const Finding> found, std::size_t index);

}  // namespace morepro::host
