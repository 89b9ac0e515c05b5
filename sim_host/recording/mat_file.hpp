#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "sim_host/recording/recording_info.hpp"

struct _mat_t;

namespace morepro::host {

/// Name of the struct variable that holds what a recording says about itself.
inline constexpr const char* kMatInfo = "morepro_info";
/// Its field: a cell array with one row {key, value} per line of metadata.
inline constexpr const char* kMatMetadata = "metadata";

/// A MATLAB file, version 4 to 7.3, through libmatio.
class MatFile {
 public:
  struct Variable {
    std::string name;
    std::size_t length = 0;  ///< of a row or column of numbers; 0: it is something else
  };

  /// Throws UserError where the file cannot be read or is no MATLAB file.
  explicit MatFile(const std::string& path);

  /// In the order of the file.
  [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }
  /// "t, qm, vir": the names, for sentences.
  [[nodiscard]] std::string names() const;
  [[nodiscard]] bool has(const std::string& name) const;

  /// A row or column of real numbers, of any numeric type. Throws UserError where the variable is none, is
  /// complex, or cannot be read.
  [[nodiscard]] std::vector<double> vector(const std::string& name) const;
  /// The metadata of a recording that morepro wrote; otherwise none.
  [[nodiscard]] Metadata metadata() const;

 private:
  struct Close {
    void operator()(_mat_t* file) const;
  };

  std::string path_;
  std::unique_ptr<_mat_t, Close> file_;
  std::vector<Variable> variables_;
};

}  // namespace morepro::host
