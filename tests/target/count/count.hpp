#pragma once
#include <cstdint>

namespace morepro::count {

/// One function whose instructions are counted; a static object of this class enters it into the table of the
/// count image. `body` is called many times, `prepare` before each of them, uncounted. The count is divided
/// by `per_call`. The names are those of tests/budget/budget.json.
struct Entry {
  Entry(const char* entry_name, std::uint32_t units_per_call, void (*prepare_call)(), void (*counted_call)())
      : name(entry_name), per_call(units_per_call), prepare(prepare_call), body(counted_call), next(first) {
    first = this;
  }
  const char* name;
  std::uint32_t per_call;
  void (*prepare)();
  void (*body)();
  Entry* next;
  static inline constinit Entry* first = nullptr;
};

/// Keeps the compiler from leaving out what computes `value`.
template <class T>
void keep(const T& value) {
  __asm volatile("" : : "g"(&value) : "memory");
}

/// The recording that the image was started with, for entries that need real frames; nullptr: none was given.
const char* recording();

}  // namespace morepro::count
