#pragma once
#include "recording_file.hpp"

namespace blind {

/// One column beyond the nominal model; `effect` is the catalogue name that it stands for, empty for none.
struct Term {
  std::string text;
  std::string effect;
  std::vector<double> integrated;
};

/// Constant, signs, magnitudes, products up to the third degree, sines of angle and place.
std::vector<Term> term_library(const Measured& measured, const Machine& machine, Balance balance);

}  // namespace blind
