#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace morepro::host {

/// Windows over a balance: smooth test functions, sin^4, times cosine and sine of a few whole periods, half
/// overlapping. A row is the sum of a test function times the increments; each band of frequencies has its
/// own.
inline constexpr std::size_t kWindowLength = 256;
inline constexpr std::size_t kBands = 5;
inline constexpr std::array<int, kBands> kBandPeriods{0, 3, 6, 9, 12};
inline constexpr std::size_t kRowsPerWindow = 2 * kBands - 1;
/// Rows of half overlapping sin^4 windows correlate: so much less are they worth.
inline constexpr double kOverlap = 0.85;

struct WindowPower {
  std::size_t first = 0;               ///< interval at which the window begins
  std::array<double, kBands> power{};  ///< mean square of the band's rows, in units of the noise
};

/// Rows in a band: one without periods, else cosine and sine.
constexpr double rows_of_band(std::size_t band) { return band == 0 ? 1.0 : 2.0; }
constexpr std::size_t band_of_row(std::size_t row) { return (row + 1) / 2; }

/// Over all rows of all windows; 1 without any.
double mean_power(const std::vector<WindowPower>& windows);

/// kRowsPerWindow x kWindowLength, of unit length each.
const Eigen::MatrixXf& test_functions();

}  // namespace morepro::host
