#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "lib/frame/sensor_frame.hpp"

namespace morepro::host {

/// The JSON schema of the messages: an object of numbers, one per recorded channel, none of them required.
std::string mcap_schema(std::uint16_t recorded);

/// A frame's samples as a JSON object on one line, with the shortest digits that give the same float32 back.
/// What was not measured is not there. JSON knows no infinity: 1e39, which is none of a float32 but the
/// infinity.
void append_frame_json(const SensorFrame& frame, std::string& text);

/// The recorded channels of a schema; 0 where it is none of ours.
std::uint16_t channels_of_schema(std::string_view schema);

/// Inverse of append_frame_json(); false where the text is no object of numbers. Other keys are ignored.
bool read_frame_json(std::string_view text, SensorFrame& frame);

}  // namespace morepro::host
