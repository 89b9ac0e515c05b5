#include "sim_host/recording/native_writer.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

#include "lib/wire/record_codec.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

wire::Text text_record(const std::string& key, const std::string& value) {
  wire::Text text;
  if (!text.assign(fmt::format("{}: {}", key, value)))
    throw UserError(
        fmt::format("metadata '{}' does not fit into a native recording: at most {} bytes, no control "
                    "characters; shorten it",
                    key, wire::Text::kMaxSize));
  return text;
}

}  // namespace

NativeWriter::NativeWriter(OutputFile& file, const std::vector<std::pair<std::string, std::string>>& metadata)
    : file_(file) {
  for (const auto& [key, value] : metadata) append(text_record(key, value));
}

template <class T>
void NativeWriter::append(const T& record) {
  std::array<std::uint8_t, wire::kMaxEncodedSize<T>> bytes;
  const std::size_t size = wire::encode(record, bytes);
  if (size == 0)
    throw UserError(
        fmt::format("cannot write {}: a frame names a channel that does not exist", file_.path()));
  file_.write(std::span<const std::uint8_t>(bytes).first(size));
}

void NativeWriter::write(const MonitorConfiguration& configuration) { append(configuration); }

void NativeWriter::write(const SensorFrame& frame) {
  append(frame);
  ++frames_;
}

void NativeWriter::finish() { append(wire::End{.frames = frames_}); }

}  // namespace morepro::host
