#pragma once
#include <cstdint>

namespace morepro::firmware {

/// The bus that the drivers work on: registers of this processor. A test gives them a simulated one instead.
struct Mmio {
  static std::uint32_t read(std::uint32_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
  }
  static void write(std::uint32_t address, std::uint32_t value) {
    *reinterpret_cast<volatile std::uint32_t*>(address) = value;
  }
};

template <class Bus>
void set_bits(std::uint32_t address, std::uint32_t bits) {
  Bus::write(address, Bus::read(address) | bits);
}

template <class Bus>
void clear_bits(std::uint32_t address, std::uint32_t bits) {
  Bus::write(address, Bus::read(address) & ~bits);
}

template <class Bus>
void change_bits(std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
  Bus::write(address, (Bus::read(address) & ~mask) | value);
}

/// Waits until (register & mask) == wanted; false: `polls` reads did not show it.
template <class Bus>
[[nodiscard]] bool wait_for(std::uint32_t address, std::uint32_t mask, std::uint32_t wanted,
                            std::uint32_t polls) {
  for (std::uint32_t i = 0; i < polls; ++i)
    if ((Bus::read(address) & mask) == wanted) return true;
  return false;
}

}  // namespace morepro::firmware
