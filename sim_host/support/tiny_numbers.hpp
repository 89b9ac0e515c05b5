#pragma once
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace morepro::host {

/// While it lives, this thread takes numbers below 1e-308 for zero. Whatever decays in a recursion ends as
/// such a number, and an x86 core takes a hundred cycles for each; other cores take none and need nothing.
class NoTinyNumbers {
 public:
#if defined(__SSE2__)
  NoTinyNumbers() { _mm_setcsr(before_ | kFlushToZero | kTakeForZero); }
  ~NoTinyNumbers() { _mm_setcsr(before_); }

 private:
  static constexpr unsigned kFlushToZero = 0x8000;
  static constexpr unsigned kTakeForZero = 0x0040;
  unsigned before_ = _mm_getcsr();
#else
  NoTinyNumbers() {}
  ~NoTinyNumbers() {}
#endif
 public:
  NoTinyNumbers(const NoTinyNumbers&) = delete;
  NoTinyNumbers& operator=(const NoTinyNumbers&) = delete;
};

}  // namespace morepro::host
