#include "lib/monitor/reason.hpp"

#include <array>

#include "lib/monitor/configuration_error.hpp"

namespace morepro {
namespace {

constexpr std::array<ReasonText, 1> kTexts{{{ReasonCode::kNone, "NONE", "", "", ""}}};

}  // namespace

const ReasonText& text_of(ReasonCode) { return kTexts[0]; }
std::string_view text_of(ConfigurationError) { return ""; }

}  // namespace morepro
