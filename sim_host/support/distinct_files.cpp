#include "sim_host/support/distinct_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

std::filesystem::path whole_path(const std::string& path) {
  std::error_code error;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
}

bool is_same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (a == "-" || b == "-") return a == b;
  if (std::filesystem::exists(a, error) && std::filesystem::exists(b, error))
    return std::filesystem::is_regular_file(a, error) && std::filesystem::equivalent(a, b, error);
  return whole_path(a) == whole_path(b);
}

std::string shown(const std::string& path) { return path == "-" ? "standard output" : path; }

}  // namespace

void check_distinct(std::initializer_list<NamedFile> inputs, std::initializer_list<NamedFile> outputs) {
  for (const NamedFile* output = outputs.begin(); output != outputs.end(); ++output) {
    for (const NamedFile& input : inputs) {
      if (!is_same_file(input.path, output->path)) continue;
      throw UsageError(fmt::format("{} {} is the file that {} is read from; write to another one",
                                   output->option, output->path, input.option));
    }
    for (const NamedFile* other = outputs.begin(); other != output; ++other) {
      if (!is_same_file(other->path, output->path)) continue;
      throw UsageError(fmt::format("{} and {} both write to {}; give each its own", other->option,
                                   output->option, shown(output->path)));
    }
  }
}

}  // namespace morepro::host
