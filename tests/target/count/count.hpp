#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

namespace morepro::count {

/// Calls before anything counts: filters settle.
inline constexpr std::uint32_t kWarmUpCalls = 500;

/// One function whose instructions are counted; a static object of this class enters it into the table of the
/// count image. `body` is called kWarmUpCalls + `counted_calls` times, `prepare` before each of them,
/// uncounted. The count is divided by `per_call`. The names are those of tests/budget/budget.json.
struct Entry {
  Entry(const char* entry_name, std::uint32_t units_per_call, void (*prepare_call)(), void (*counted_call)(),
        std::uint32_t counted_calls = 2000)
      : name(entry_name),
        per_call(units_per_call),
        prepare(prepare_call),
        body(counted_call),
        calls(counted_calls),
        next(first) {
    first = this;
  }
  const char* name;
  std::uint32_t per_call;
  void (*prepare)();
  void (*body)();
  std::uint32_t calls;
  Entry* next;
  static inline constinit Entry* first = nullptr;
};

/// Keeps the compiler from leaving out what computes `value`.
template <class T>
void keep(const T& value) {
  __asm volatile("" : : "g"(&value) : "memory");
}

namespace in_turn {
alignas(8) inline constinit std::array<std::byte, 62 * 1024> memory{};
inline constinit const void* holder = nullptr;
}  // namespace in_turn

/// Memory for what is too large to stand beside its like in a board's RAM: an object lives until an entry
/// asks for one of another type. To be asked for in `prepare`, uncounted.
template <class T>
class InTurn {
 public:
  template <class... Args>
  static T* get(const Args&... args) {
    static_assert(sizeof(T) <= sizeof(in_turn::memory) && alignof(T) <= 8 &&
                  std::is_trivially_destructible_v<T>);
    if (in_turn::holder != &mark) ::new (in_turn::memory.data()) T(args...);
    in_turn::holder = &mark;
    return std::launder(reinterpret_cast<T*>(in_turn::memory.data()));
  }

 private:
  static inline const char mark = 0;
};

/// The recording that the image was started with, for entries that need real frames; nullptr: none was given.
const char* recording();

}  // namespace morepro::count
