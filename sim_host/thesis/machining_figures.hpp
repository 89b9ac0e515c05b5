#pragma once
#include "sim_host/thesis/figure.hpp"

namespace morepro::host::thesis {

/// Figure 21: measurements that the thesis cites.
Figure cited_figure();
/// Figure 22: equations 13 and 14, and their units.
Figure speeds_figure();
/// Figure 23: equation 12 on its box of speeds and feeds.
Figure equation12_figure();

}  // namespace morepro::host::thesis
