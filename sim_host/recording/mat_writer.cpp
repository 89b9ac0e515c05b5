#include "sim_host/recording/mat_writer.hpp"

#include <fmt/format.h>
#include <matio.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "sim_host/recording/mat_file.hpp"
#include "sim_host/recording/mat_text.hpp"
#include "sim_host/support/input_file.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr const char* kHead = "MATLAB 5.0 MAT-file, recording of morepro";
// The format counts the bytes of a variable in 31 bits; a double per row.
constexpr std::size_t kMostMatRows = (std::size_t{1} << 31) / sizeof(double) - 64;

/// libmatio writes to a path only: a file of its own, gone at the end.
class ScratchFile {
 public:
  ScratchFile() : path_((std::filesystem::temp_directory_path() / "morepro-XXXXXX").string()) {
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0)
      throw UserError(
          fmt::format("cannot write {}; make room in that folder or name another in TMPDIR", path_));
    close(descriptor);
  }
  ~ScratchFile() { unlink(path_.c_str()); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct Close {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
using File = std::unique_ptr<mat_t, Close>;

void put(mat_t* file, matvar_t* variable) {
  const bool is_written = variable != nullptr && Mat_VarWrite(file, variable, MAT_COMPRESSION_NONE) == 0;
  Mat_VarFree(variable);
  if (!is_written) throw UserError("cannot write the MATLAB file; is the disk of the temporary folder full?");
}

template <class T>
matvar_t* column(std::string_view name, std::vector<T>& values) {
  constexpr bool kIsDouble = sizeof(T) == sizeof(double);
  std::array<std::size_t, 2> size{values.size(), 1};
  return Mat_VarCreate(std::string(name).c_str(), kIsDouble ? MAT_C_DOUBLE : MAT_C_SINGLE,
                       kIsDouble ? MAT_T_DOUBLE : MAT_T_SINGLE, 2, size.data(), values.data(),
                       MAT_F_DONT_COPY_DATA);
}

/// A struct with one field: a cell array {key, value; ...}.
matvar_t* info_struct(const Metadata& metadata) {
  std::array<std::size_t, 2> size{metadata.size(), 2};
  std::vector<matvar_t*> cells;
  for (const auto& [key, value] : metadata) cells.push_back(new_mat_text(key));
  for (const auto& [key, value] : metadata) cells.push_back(new_mat_text(value));
  matvar_t* table = Mat_VarCreate(kMatMetadata, MAT_C_CELL, MAT_T_CELL, 2, size.data(), cells.data(), 0);
  std::array<const char*, 1> fields{kMatMetadata};
  std::array<std::size_t, 2> one{1, 1};
  matvar_t* info = Mat_VarCreateStruct(kMatInfo, 2, one.data(), fields.data(), 1);
  if (info != nullptr) Mat_VarSetStructFieldByName(info, kMatMetadata, 0, table);
  return info;
}

}  // namespace

MatWriter::MatWriter(OutputFile& file, Metadata metadata, std::uint16_t recorded, std::int64_t start_us)
    : file_(file), metadata_(std::move(metadata)), recorded_(recorded), time_(start_us) {}

bool MatWriter::write(const SensorFrame& frame) {
  if (!time_.advance(frame.time_us)) return false;
  time_s_.push_back(seconds(time_.us()));
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const auto channel = static_cast<Channel>(i);
    if (!(recorded_ & bit_of(channel))) continue;
    value_[i].push_back(frame.has(channel) ? frame.get(channel) : std::numeric_limits<float>::quiet_NaN());
  }
  return true;
}

void MatWriter::finish() {
  if (time_s_.size() > kMostMatRows)
    throw UserError(
        fmt::format("{}: {} rows are too many for a MATLAB file of version 5 (at most {}); cut it",
                    file_.path(), time_s_.size(), kMostMatRows));
  const ScratchFile scratch;
  {
    const File mat(Mat_CreateVer(scratch.path().c_str(), kHead, MAT_FT_MAT5));
    if (!mat) throw UserError(fmt::format("cannot write {}", scratch.path()));
    put(mat.get(), column("time_s", time_s_));
    for (std::size_t i = 0; i < kChannelCount; ++i)
      if (recorded_ & bit_of(static_cast<Channel>(i))) put(mat.get(), column(kChannels[i].column, value_[i]));
    if (!metadata_.empty()) put(mat.get(), info_struct(metadata_));
  }
  file_.write(InputFile(scratch.path()).text());
}

}  // namespace morepro::host
