#include "sim_host/recording/mcap_frame_json.hpp"

#include <fast_float/fast_float.h>
#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

namespace morepro::host {
namespace {

std::optional<Channel> channel_of(std::string_view column) {
  for (std::size_t i = 0; i < kChannelCount; ++i)
    if (kChannels[i].column == column) return static_cast<Channel>(i);
  return std::nullopt;
}

/// Takes numbers from their text: a double in between would round twice.
class FrameHandler final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit FrameHandler(SensorFrame& frame) : frame_(frame) {}

  bool start_object(std::size_t) override { return depth_++ == 0; }
  bool end_object() override { return true; }
  bool key(string_t& name) override {
    channel_ = channel_of(name);
    return true;
  }
  bool number_float(number_float_t, const string_t& text) override {
    float value = 0.0F;
    fast_float::from_chars(text.data(), text.data() + text.size(), value);
    return take(value);
  }
  bool number_integer(number_integer_t value) override { return take(static_cast<float>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return take(static_cast<float>(value)); }
  bool null() override { return depth_ == 1; }
  bool boolean(bool) override { return false; }
  bool string(string_t&) override { return false; }
  bool binary(binary_t&) override { return false; }
  bool start_array(std::size_t) override { return false; }
  bool end_array() override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  bool take(float value) {
    if (channel_) frame_.set(*channel_, value);
    return depth_ == 1;
  }

  SensorFrame& frame_;
  std::optional<Channel> channel_;
  int depth_ = 0;
};

}  // namespace

std::uint16_t channels_of_schema(std::string_view schema) {
  const nlohmann::json json = nlohmann::json::parse(schema, nullptr, false);
  std::uint16_t recorded = 0;
  if (!json.is_object() || !json.contains("properties")) return recorded;
  for (const auto& [column, type] : json["properties"].items())
    if (const auto channel = channel_of(column))
      recorded = static_cast<std::uint16_t>(recorded | bit_of(*channel));
  return recorded;
}

bool read_frame_json(std::string_view text, SensorFrame& frame) {
  FrameHandler handler(frame);
  return nlohmann::json::sax_parse(text, &handler);
}

std::string mcap_schema(std::uint16_t recorded) {
  nlohmann::ordered_json properties;
  for (std::size_t i = 0; i < kChannelCount; ++i)
    if (recorded & bit_of(static_cast<Channel>(i))) properties[kChannels[i].column] = {{"type", "number"}};
  return nlohmann::ordered_json{{"title", "morepro.Frame"}, {"type", "object"}, {"properties", properties}}
      .dump();
}

void append_frame_json(const SensorFrame& frame, std::string& text) {
  const auto out = std::back_inserter(text);
  char separator = '{';
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const auto channel = static_cast<Channel>(i);
    const float value = frame.get(channel);
    if (!frame.has(channel) || std::isnan(value)) continue;
    fmt::format_to(out, FMT_COMPILE("{}\"{}\":"), separator, kChannels[i].column);
    if (std::isinf(value)) {
      text += value > 0.0F ? "1e39" : "-1e39";
    } else if (value == 0.0F && std::signbit(value)) {
      text += "-0.0";  // "-0" would be an integer, which has no such zero
    } else {
      fmt::format_to(out, FMT_COMPILE("{}"), value);
    }
    separator = ',';
  }
  if (separator == '{') text += '{';
  text += '}';
}

}  // namespace morepro::host
