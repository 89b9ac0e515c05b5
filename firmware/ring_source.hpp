#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/wire/decoder.hpp"

namespace morepro::firmware {

/// What a UartLink has received, as a ByteSource.
template <class Link>
class RingSource {
 public:
  explicit RingSource(Link& link) : link_(link) {}

  wire::DecodeEvent feed(wire::Decoder& decoder) {
    for (std::span<const std::uint8_t> bytes = link_.received(); !bytes.empty(); bytes = link_.received()) {
      const std::size_t available = bytes.size();
      const wire::DecodeEvent event = decoder.next(bytes);
      link_.drop(available - bytes.size());
      if (event != wire::DecodeEvent::kNothing) return event;
    }
    return wire::DecodeEvent::kNothing;
  }

  [[nodiscard]] bool ended() const { return false; }

 private:
  Link& link_;
};

}  // namespace morepro::firmware
