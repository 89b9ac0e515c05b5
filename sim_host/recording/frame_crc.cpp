#include "sim_host/recording/frame_crc.hpp"

#include "lib/wire/crc32.hpp"

#if defined(__PCLMUL__)
#include <immintrin.h>
#endif

namespace morepro::host {

#if defined(__PCLMUL__)
namespace {

// Gopal et al., "Fast CRC Computation for Generic Polynomials Using PCLMULQDQ Instruction" (2009), with the
// reflected polynomial of IEEE 802.3: 128 bits are carried 128 bits on by the remainders of x^(128+32) and
// x^(128-32); what is left is folded to 64 bits (x^64) and reduced after Barrett.
constexpr std::int64_t kFold160 = 0x1751997D0;
constexpr std::int64_t kFold96 = 0x0CCAA009E;
constexpr std::int64_t kFold64 = 0x163CD6124;
constexpr std::int64_t kPolynomial = 0x1DB710641;
constexpr std::int64_t kQuotient = 0x1F7011641;
constexpr std::size_t kBlock = 16;
static_assert(kCrcLead >= kBlock);

/// What the register's first value, all ones, has become behind so many bytes. The rest of the CRC is linear:
/// it begins with zero, and zeros in front of the bytes, which fill the first block, change nothing.
constexpr auto kOnesAfter = [] {
  std::array<std::uint32_t, kCrcLongest + 1> after{};
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::uint32_t& value : after) {
    value = crc;
    crc = (crc >> 8) ^ wire::kCrc32Tables<1>[0][crc & 0xFFU];
  }
  return after;
}();

__m128i load(const std::uint8_t* bytes) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes)); }

std::uint32_t reduced(__m128i x) {
  const __m128i low = _mm_set_epi32(0, 0, 0, -1);
  const __m128i fold = _mm_set_epi64x(kFold64, kFold96);
  x = _mm_xor_si128(_mm_srli_si128(x, 8), _mm_clmulepi64_si128(x, fold, 0x00));
  x = _mm_xor_si128(_mm_srli_si128(x, 4), _mm_clmulepi64_si128(_mm_and_si128(x, low), fold, 0x10));
  const __m128i barrett = _mm_set_epi64x(kQuotient, kPolynomial);
  const __m128i quotient = _mm_clmulepi64_si128(_mm_and_si128(x, low), barrett, 0x10);
  const __m128i product = _mm_clmulepi64_si128(_mm_and_si128(quotient, low), barrett, 0x00);
  return static_cast<std::uint32_t>(_mm_extract_epi32(_mm_xor_si128(x, product), 1));
}

}  // namespace

std::uint32_t frame_crc32(const std::uint8_t* bytes, std::size_t size) {
  const __m128i fold = _mm_set_epi64x(kFold96, kFold160);
  const std::uint8_t* const end = bytes + size;
  const std::uint8_t* block = end - (size + kBlock - 1) / kBlock * kBlock;
  __m128i x = _mm_setzero_si128();
  for (; block < end; block += kBlock) {
    const __m128i carried =
        _mm_xor_si128(_mm_clmulepi64_si128(x, fold, 0x00), _mm_clmulepi64_si128(x, fold, 0x11));
    x = _mm_xor_si128(carried, load(block));
  }
  return ~(reduced(x) ^ kOnesAfter[size]);
}
#else
std::uint32_t frame_crc32(const std::uint8_t* bytes, std::size_t size) { return wire::crc32({bytes, size}); }
#endif

}  // namespace morepro::host
