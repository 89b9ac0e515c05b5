#include "sim_host/support/input_file.hpp"

#include <sys/mman.h>

#include <array>

#include "sim_host/support/file_descriptor.hpp"

namespace morepro::host {
namespace {

std::string read_all(FileDescriptor& file) {
  std::string all;
  std::array<std::uint8_t, 65536> block{};
  std::size_t count = 0;
  do {
    count = file.read(block);
    all.append(reinterpret_cast<const char*>(block.data()), count);
  } while (count == block.size());
  return all;
}

}  // namespace

InputFile::InputFile(const std::string& path) {
  FileDescriptor file(path);
  if (file.is_regular() && file.size() > 0) {
    mapping_ = mmap(nullptr, file.size(), PROT_READ, MAP_PRIVATE, file.get(), 0);
    if (mapping_ == MAP_FAILED) file.refuse();
    madvise(mapping_, file.size(), MADV_SEQUENTIAL);
    text_ = {static_cast<const char*>(mapping_), file.size()};
  } else {
    copy_ = read_all(file);
    text_ = copy_;
  }
}

InputFile::~InputFile() {
  if (mapping_ != nullptr) munmap(mapping_, text_.size());
}

}  // namespace morepro::host
