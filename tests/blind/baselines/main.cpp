#include <cstdio>
#include <exception>
#include <string>

#include "methods.hpp"
#include "recording.hpp"

/// blind_baselines single_term|stlsq RECORDING MACHINE OUT
int main(int count, char** words) {
  if (count != 5) return std::fputs("blind_baselines single_term|stlsq RECORDING MACHINE OUT\n", stderr), 2;
  try {
    const auto measured = blind::read_recording(words[2]);
    const auto sheet = blind::read_machine(words[3]);
    const bool is_single = std::string(words[1]) == "single_term";
    const auto answer = is_single ? blind::best_single_term(measured, sheet)
                                  : blind::thresholded_least_squares(measured, sheet);
    blind::write_text(words[4], answer.dump(1) + "\n");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "blind_baselines: %s\n", error.what());
    return 1;
  }
}
