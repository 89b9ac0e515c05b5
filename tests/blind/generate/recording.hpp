#pragma once
#include <string>

#include "simulate.hpp"

namespace blind {

/// Writes the rows as the recording CSV of the program's contract. Errors: std::runtime_error.
void write_recording(const std::string& path, const Run& run, bool has_position, bool has_angle);

/// Writes a small text file. Errors: std::runtime_error.
void write_text(const std::string& path, const std::string& text);

}  // namespace blind
