#include "firmware/semihosting/semihost.hpp"

#include <array>
#include <cstring>

namespace morepro::firmware::semihost {
namespace {

constexpr std::uint32_t kOpen = 0x01, kClose = 0x02, kWrite0 = 0x04, kWrite = 0x05, kRead = 0x06;
constexpr std::uint32_t kGetCommandLine = 0x15, kExitExtended = 0x20;
constexpr std::uint32_t kApplicationExit = 0x20026;

std::uint32_t word(const void* pointer) { return reinterpret_cast<std::uint32_t>(pointer); }

std::uint32_t request(std::uint32_t operation, const void* block) {
  register std::uint32_t r0 __asm("r0") = operation;
  register const void* r1 __asm("r1") = block;
  __asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

}  // namespace

int open(const char* path, OpenMode mode) {
  const std::array<std::uint32_t, 3> block{word(path), static_cast<std::uint32_t>(mode),
                                           static_cast<std::uint32_t>(std::strlen(path))};
  return static_cast<int>(request(kOpen, block.data()));
}

void close(int handle) {
  const std::array<std::uint32_t, 1> block{static_cast<std::uint32_t>(handle)};
  request(kClose, block.data());
}

std::size_t read(int handle, std::span<std::uint8_t> buffer) {
  const std::array<std::uint32_t, 3> block{static_cast<std::uint32_t>(handle), word(buffer.data()),
                                           buffer.size()};
  const std::uint32_t not_read = request(kRead, block.data());
  return not_read > buffer.size() ? 0 : buffer.size() - not_read;
}

bool write(int handle, std::span<const std::uint8_t> bytes) {
  const std::array<std::uint32_t, 3> block{static_cast<std::uint32_t>(handle), word(bytes.data()),
                                           bytes.size()};
  return request(kWrite, block.data()) == 0;
}

void print(const char* text) { request(kWrite0, text); }

void print(std::uint32_t number) {
  std::array<char, 11> text{};
  std::size_t at = text.size() - 1;
  do {
    text[--at] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0);
  print(&text[at]);
}

bool command_line(std::span<char> buffer) {
  const std::array<std::uint32_t, 2> block{word(buffer.data()), buffer.size()};
  if (request(kGetCommandLine, block.data()) != 0) return false;
  char* const arguments = std::strchr(buffer.data(), ' ');
  if (arguments == nullptr) return false;
  std::memmove(buffer.data(), arguments + 1, std::strlen(arguments + 1) + 1);
  for (char& c : buffer)
    if (c == ' ') c = '\0';
  return true;
}

void exit(int status) {
  const std::array<std::uint32_t, 2> block{kApplicationExit, static_cast<std::uint32_t>(status)};
  while (true) request(kExitExtended, block.data());
}

}  // namespace morepro::firmware::semihost
