#pragma once
#include <Eigen/Dense>
#include <array>
#include <functional>
#include <vector>

#include "effect.hpp"

namespace blind {

inline constexpr int kWindow = 256;
inline constexpr int kGroups = 10;  ///< five bands, each free and in contact

/// One sampled recording as plain columns, for the rows.
struct Columns {
  std::vector<double> voltage, force, contact, engagement, chip_load, w, v, i, tool_c;
  double sample_s = 1e-4;
  std::size_t size() const { return voltage.size(); }
};

/// Windowed rows y = X theta of one balance, one group per band and contact state.
struct BalanceRows {
  Eigen::MatrixXd x;
  Eigen::VectorXd y;
  std::vector<int> group;
};

/// Per-sample regressors and increments: `increment[k]` belongs to the interval from k to k+1.
struct SampleColumns {
  std::vector<double> increment;
  std::vector<std::vector<double>> regressors;
};

/// The nominal balance: increments over one interval against integrated regressors.
SampleColumns nominal_columns(const Columns& columns, const Machine& machine, Balance balance);

/// Weights the intervals with sin^4 windows times cos and sin of five frequencies.
BalanceRows windowed(const SampleColumns& samples, const std::vector<double>& contact);

/// The nine test functions, each of kWindow values; `band` gives 0..4.
struct TestFunctions {
  std::array<std::array<double, kWindow>, 9> phi;
  std::array<int, 9> band;
};
const TestFunctions& test_functions();

}  // namespace blind
