#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

namespace morepro::host {

/// A file that a command line names, and the word or option that names it.
struct NamedFile {
  std::string_view option;
  const std::string& path;  ///< empty: not asked for
};

/// Throws UsageError where an output is an input, or two outputs are one file: by path, through a link, or
/// both standard output. Devices and pipes are no files of which something could be lost.
void check_distinct(std::initializer_list<NamedFile> inputs, std::initializer_list<NamedFile> outputs);

}  // namespace morepro::host
