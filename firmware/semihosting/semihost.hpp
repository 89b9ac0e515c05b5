#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

/// Requests to the debugger or emulator that the board hangs on. Test images only.
namespace morepro::firmware::semihost {

enum class OpenMode : std::uint32_t { kRead = 1, kWrite = 5 };

/// A handle >= 0, -1: cannot be opened.
int open(const char* path, OpenMode mode);
void close(int handle);
/// Number of bytes that were read, 0 at the end.
std::size_t read(int handle, std::span<std::uint8_t> buffer);
/// True when every byte was written.
bool write(int handle, std::span<const std::uint8_t> bytes);
void print(const char* text);
void print(std::uint32_t number);
/// The arguments of the image, without its name, each ended by '\0', in `buffer`; false: none or too long.
bool command_line(std::span<char> buffer);
[[noreturn]] void exit(int status);

}  // namespace morepro::firmware::semihost
