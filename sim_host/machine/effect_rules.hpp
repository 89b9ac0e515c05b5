#pragma once
#include <string>

#include "lib/gap/applied_effect.hpp"

namespace morepro::host {

/// Empty, or why an effect cannot have this size.
std::string objection_to_size(gap::Effect effect, double size);

/// Empty, or why an effect has no such form: a kind, a shape or a number of parts that its law does not know.
std::string objection_to_form(const gap::EffectForm& form);

}  // namespace morepro::host
