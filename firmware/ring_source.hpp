#pragma once
#include <cstdint>

#include "lib/wire/decoder.hpp"

namespace morepro::firmware {

/// What a UartLink has received, as a ByteSource.
template <class Link>
class RingSource {
 public:
  explicit RingSource(Link& link) : link_(link) {}

  wire::DecodeEvent feed(wire::Decoder& decoder) {
    std::uint8_t byte = 0;
    while (link_.read(byte)) {
      const wire::DecodeEvent event = decoder.push(byte);
      if (event != wire::DecodeEvent::kNothing) return event;
    }
    return wire::DecodeEvent::kNothing;
  }

  [[nodiscard]] bool ended() const { return false; }

 private:
  Link& link_;
};

}  // namespace morepro::firmware
