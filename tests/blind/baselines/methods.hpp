#pragma once
#include <nlohmann/json.hpp>

#include "library.hpp"

namespace blind {

/// The best single term of the library on the residuals of the datasheet's model; nothing is refitted.
nlohmann::json best_single_term(const Measured& measured, const Machine& datasheet);

/// Sequentially thresholded least squares over the nominal columns and the whole library.
nlohmann::json thresholded_least_squares(const Measured& measured, const Machine& datasheet);

}  // namespace blind
