#pragma once
#include <string>
#include <vector>

#include "sim_host/thesis/bank_trial.hpp"
#include "sim_host/thesis/figure.hpp"

namespace morepro::host::thesis {

/// Table: figure, quantity, printed, ours, difference; the remark under each figure.
std::string figures_text(const std::vector<Figure>& figures);
/// Rules of decision beside each other, over noise and wrong datasheets.
std::string bank_text(const std::vector<BankTrialRow>& rows, int runs);

/// {"schema": "morepro.thesis/1", "figures": [..], "bank": [..]}, compact; with the curves for a page.
std::string thesis_json(const std::vector<Figure>& figures, const std::vector<BankTrialRow>& bank,
                        bool with_curves);

}  // namespace morepro::host::thesis
