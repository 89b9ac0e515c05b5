#include "sim_host/recording/mat_file.hpp"

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <cstdint>

#include "lib/wire/byte_order.hpp"
#include "sim_host/recording/mat_text.hpp"
#include "sim_host/support/input_file.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

struct Free {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Owned = std::unique_ptr<matvar_t, Free>;

std::size_t elements(const matvar_t& variable) {
  std::size_t count = variable.rank > 0 ? 1 : 0;
  for (int i = 0; i < variable.rank; ++i) count *= variable.dims[i];
  return count;
}

bool is_numeric(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64;
}

/// Of a row or a column; 0 for a matrix and for what is no array of numbers.
std::size_t vector_length(const matvar_t& variable) {
  if (!is_numeric(variable)) return 0;
  const std::size_t count = elements(variable);
  return std::find(variable.dims, variable.dims + variable.rank, count) == variable.dims + variable.rank
             ? 0
             : count;
}

template <class T>
std::vector<double> converted(const matvar_t& variable) {
  const T* first = static_cast<const T*>(variable.data);
  return std::vector<double>(first, first + elements(variable));
}

std::vector<double> numbers(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_SINGLE:
      return converted<float>(variable);
    case MAT_C_INT8:
      return converted<std::int8_t>(variable);
    case MAT_C_UINT8:
      return converted<std::uint8_t>(variable);
    case MAT_C_INT16:
      return converted<std::int16_t>(variable);
    case MAT_C_UINT16:
      return converted<std::uint16_t>(variable);
    case MAT_C_INT32:
      return converted<std::int32_t>(variable);
    case MAT_C_UINT32:
      return converted<std::uint32_t>(variable);
    case MAT_C_INT64:
      return converted<std::int64_t>(variable);
    case MAT_C_UINT64:
      return converted<std::uint64_t>(variable);
    default:
      return converted<double>(variable);
  }
}

void be_silent(int, char*) {}

/// Does a file of version 5 end inside a variable? libmatio does not ask. The head ends with the version and
/// the order of bytes; behind it every variable begins with its type and its size.
bool is_cut(std::string_view file) {
  constexpr std::size_t kHead = 128;
  constexpr std::size_t kTag = 8;
  if (file.size() < kHead) return false;
  const std::string_view version = file.substr(kHead - 4, 4);
  const bool is_little = version == std::string_view("\0\1IM", 4);
  if (!is_little && version != std::string_view("\1\0MI", 4)) return false;
  std::uint64_t offset = kHead;
  while (offset + kTag <= file.size()) {
    const auto* size = reinterpret_cast<const std::uint8_t*>(file.data()) + offset + 4;
    const auto little = wire::load_little_endian<std::uint32_t>(size);
    offset += kTag + (is_little ? little : wire::reversed_bytes(little));
  }
  return offset != file.size();
}

}  // namespace

void MatFile::Close::operator()(_mat_t* file) const { Mat_Close(file); }

MatFile::MatFile(const std::string& path) : path_(path) {
  const InputFile input(path);
  Mat_LogInitFunc("morepro", be_silent);
  if (is_cut(input.text()))
    throw UserError(fmt::format("{}: the file is cut off or damaged; copy or save it again", path));
  if (!input.text().empty()) file_.reset(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  while (file_) {
    const Owned variable(Mat_VarReadNextInfo(file_.get()));
    if (!variable) break;
    if (variable->name == nullptr) continue;
    variables_.push_back({variable->name, vector_length(*variable)});
  }
  if (variables_.empty())
    throw UserError(fmt::format(
        "{}: no MATLAB file, an empty or a damaged one; save it with save('run.mat', ..., '-v7')", path));
}

std::string MatFile::names() const {
  std::vector<std::string> all;
  for (const Variable& variable : variables_) all.push_back(variable.name);
  return fmt::format("{}", fmt::join(all, ", "));
}

bool MatFile::has(const std::string& name) const {
  return std::any_of(variables_.begin(), variables_.end(),
                     [&](const Variable& variable) { return variable.name == name; });
}

std::vector<double> MatFile::vector(const std::string& name) const {
  const Owned variable(Mat_VarRead(file_.get(), name.c_str()));
  if (!variable)
    throw UserError(fmt::format("{}: variable '{}' cannot be read; the file is damaged", path_, name));
  if (variable->isComplex)
    throw UserError(fmt::format("{}: variable '{}' is complex; save its real part", path_, name));
  if (vector_length(*variable) == 0)
    throw UserError(
        fmt::format("{}: variable '{}' is no row or column of numbers; save it as one", path_, name));
  if (variable->data == nullptr)
    throw UserError(fmt::format("{}: variable '{}' is cut off; save the file again", path_, name));
  return numbers(*variable);
}

Metadata MatFile::metadata() const {
  Metadata metadata;
  if (!has(kMatInfo)) return metadata;
  const Owned info(Mat_VarRead(file_.get(), kMatInfo));
  if (!info || info->class_type != MAT_C_STRUCT) return metadata;
  const matvar_t* cells = Mat_VarGetStructFieldByName(info.get(), kMatMetadata, 0);
  if (cells == nullptr || cells->class_type != MAT_C_CELL || cells->rank != 2 || cells->dims[1] != 2 ||
      cells->data == nullptr)
    return metadata;
  auto* const* cell = static_cast<matvar_t* const*>(cells->data);
  for (std::size_t row = 0; row < cells->dims[0]; ++row)
    metadata.emplace_back(mat_text(cell[row]), mat_text(cell[row + cells->dims[0]]));
  return metadata;
}

}  // namespace morepro::host
