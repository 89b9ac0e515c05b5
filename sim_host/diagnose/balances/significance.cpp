#include "sim_host/diagnose/balances/significance.hpp"

#include <algorithm>
#include <cmath>

namespace morepro::host {

double p_value_of(double ratio, double rows) {
  return rows > 0.0 ? 0.5 * std::erfc((ratio - 1.0) * std::sqrt(rows / 2.0) / std::sqrt(2.0)) : 1.0;
}

void correct_for_number(std::vector<GapCell>& cells) {
  std::vector<GapCell*> ordered;
  for (GapCell& cell : cells) ordered.push_back(&cell);
  std::sort(ordered.begin(), ordered.end(),
            [](const GapCell* a, const GapCell* b) { return a->p_value < b->p_value; });
  double largest = 0.0;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    largest = std::max(largest, ordered[i]->p_value * static_cast<double>(ordered.size() - i));
    ordered[i]->p_value = std::min(largest, 1.0);
  }
}

}  // namespace morepro::host
