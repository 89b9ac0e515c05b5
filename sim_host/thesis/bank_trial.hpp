#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace morepro::host::thesis {

/// One rule of decision under one condition. The machine cuts from 50 ms on, changes its chip load 200 ms
/// later, with more noise 300 ms later, and stops 250 ms after that.
struct BankTrialRow {
  std::string machine;   ///< built-in machine
  double noise = 1.0;    ///< of the sensors, times their nominal noise
  std::string mismatch;  ///< what of the real machine is not as stated; empty: nothing
  std::string rule;
  double contact_ms = 0.0;     ///< after contact, from which 95 % of the runs stay right; infinite: never
  double switch_ms = 0.0;      ///< the same after the change
  double right_share = 0.0;    ///< of the samples of the last 50 ms
  double mean_error_mm = 0.0;  ///< of the chosen chip load there
};

struct BankTrialOptions {
  int runs = 20;
  std::uint64_t seed = 1;
  bool with_mismatch = true;                                  ///< also machines that are not as stated
  std::function<void(std::string_view, double)> on_progress;  ///< condition, share of all of them
};

/// The thesis's bank (section 4.4: outputs angular acceleration and current, minimum integral of the error)
/// beside the likelihood rules and the continuous chip load, over noise and over machines that are not as
/// stated.
std::vector<BankTrialRow> run_bank_trial(const BankTrialOptions& options);

}  // namespace morepro::host::thesis
