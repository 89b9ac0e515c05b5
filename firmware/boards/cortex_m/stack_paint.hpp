#pragma once
#include <cstdint>

extern "C" std::uint32_t __stack[];
extern "C" std::uint32_t __heap_end[];

namespace morepro::firmware {

inline constexpr std::uint32_t kStackPaint = 0xA5A55A5AU;

/// Fills the unused part of the stack; call it first thing in main().
inline void paint_stack() {
  std::uint32_t* end;
  __asm volatile("mov %0, sp" : "=r"(end));
  for (volatile std::uint32_t* p = __heap_end; p < end - 16; ++p) *p = kStackPaint;
}

/// Bytes of stack that have been used since paint_stack(), and by its callers before.
inline std::uint32_t painted_stack_used() {
  const std::uint32_t* p = __heap_end;
  while (p < __stack && *p == kStackPaint) ++p;
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(__stack) -
                                    reinterpret_cast<std::uintptr_t>(p));
}

}  // namespace morepro::firmware
