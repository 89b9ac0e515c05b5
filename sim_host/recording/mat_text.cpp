#include "sim_host/recording/mat_text.hpp"

#include <matio.h>

#include <array>
#include <codecvt>
#include <cstdint>
#include <locale>

namespace morepro::host {
namespace {

constexpr char kReplacement[] = "?";

using Converter = std::wstring_convert<std::codecvt_utf8_utf16<char16_t>, char16_t>;

}  // namespace

std::string mat_text(const matvar_t* variable) {
  if (variable == nullptr || variable->class_type != MAT_C_CHAR || variable->data == nullptr) return {};
  const std::size_t bytes = variable->nbytes;
  if (variable->data_size == 2) {
    const auto* units = static_cast<const char16_t*>(variable->data);
    return Converter(kReplacement).to_bytes(units, units + bytes / 2);
  }
  return variable->data_size == 1 ? std::string(static_cast<const char*>(variable->data), bytes)
                                  : std::string{};
}

matvar_t* new_mat_text(std::string_view utf8) {
  std::u16string units = Converter(kReplacement, u"?").from_bytes(utf8.data(), utf8.data() + utf8.size());
  std::array<std::size_t, 2> size{units.empty() ? 0U : 1U, units.size()};
  return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF16, 2, size.data(), units.data(), 0);
}

}  // namespace morepro::host
