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

/// {"schema": "morepro.thesis/1", "figures": [..], "bank": [..]}
std::string thesis_json(const std::vector<Figure>& figures, const std::vector<BankTrialRow>& bank);
/// The page, one HTML file: the same with the curves, and the machine of figure 18. The program must have its
/// pages (why_no_page).
std::string thesis_page(const std::vector<Figure>& figures, const std::vector<BankTrialRow>& bank);

}  // namespace morepro::host::thesis
