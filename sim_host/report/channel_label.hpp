#pragma once
#include <array>
#include <string_view>

#include "lib/frame/channel.hpp"

namespace morepro::host {

/// What a page calls a signal, and its unit; "1" where it has none.
struct ChannelLabel {
  std::string_view name;
  std::string_view unit;
};

/// In the order of Channel.
inline constexpr std::array<ChannelLabel, kChannelCount> kChannelLabels{{{"Armature voltage", "V"},
                                                                         {"Feed force", "N"},
                                                                         {"Contact", "1"},
                                                                         {"Engagement", "1"},
                                                                         {"Spindle speed", "rad/s"},
                                                                         {"Spindle angle", "rad"},
                                                                         {"Feed speed", "m/s"},
                                                                         {"Feed position", "m"},
                                                                         {"Armature current", "A"},
                                                                         {"Tool temperature", "degC"},
                                                                         {"Winding temperature", "degC"},
                                                                         {"Commanded chip load", "mm"},
                                                                         {"Spindle acceleration", "rad/s2"},
                                                                         {"Feed acceleration", "m/s2"}}};

}  // namespace morepro::host
