#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace morepro::host {

/// Where in a text file something is wrong; line and column count from 1, column in characters.
struct TextPlace {
  std::string file;
  std::size_t line = 0;    ///< 0: the file as a whole
  std::size_t column = 0;  ///< 0: the line as a whole
};

/// "run.csv, line 3, column 7"
std::string to_text(const TextPlace& place);

/// A job that cannot be done, in one sentence for the person at the keyboard: what is wrong, where, what to
/// do. The program ends with status 1.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& sentence) : std::runtime_error(sentence) {}
  UserError(const TextPlace& place, std::string_view sentence);
};

/// The command line asks for something that does not exist. The program ends with status 2.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& sentence) : std::runtime_error(sentence) {}
};

}  // namespace morepro::host
