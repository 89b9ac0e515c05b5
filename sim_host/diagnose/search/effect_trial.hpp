#pragma once
#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/search/effect_search.hpp"

namespace morepro::host {

/// What a settled model needs to settle with one effect more or less.
inline constexpr int kDuelRounds = 2;

/// A candidate in the model, with everything refitted.
struct EffectTrial {
  Candidate candidate;
  AxisFit fit;
};

/// Puts a candidate into the model of `fit`, searches for its shape and onset and refits everything: first to
/// a part of the recording, and to all of it unless that has shown it to be hopeless beside `without`, the
/// model as it is. `is_astray`: that is a bad beginning; then from the datasheet, too. A shaft that seems to
/// set in late is tried from the start as well.
EffectTrial try_effect(const AxisFit& fit, const Candidate& candidate, const AxisFit::Rival& without,
                       bool is_astray);

/// Deviance that an effect gains by chance: its coefficients', one for the shape that was looked for, and one
/// for the onset.
double freedom_cost(const AxisFit& fit, const gap::AppliedEffect& effect);

/// What models of one recording are compared by: how unlikely they make it, and what the freedom of their
/// effects gains by chance. Smaller is better.
double cost_of(const AxisFit& fit);

/// Has the recording driven a parameter farther than a datasheet can be wrong? One that it does not tell may
/// be anywhere.
bool is_bent(const AxisFit& fit);

/// A size of the sign that no machine has, where it acts most, or a saturation until what saturates pushes
/// back: what a fit makes of another effect's shape.
/// Less friction at rest than in motion, or a drag that falls behind the speed, is a shape; beside one of its
/// kind that the machine file states, what is missing may have either sign, unless that is no size at all.
bool acts_the_wrong_way(const gap::AppliedEffect& effect, const AxisFit& fit);

/// The model's effects beside the datasheet's parameters.
AxisFit at_datasheet(const AxisFit& fit);

}  // namespace morepro::host
