#pragma once
#include <cstdint>

namespace morepro {

/// What was unusual about one frame; bits of Health::frame_flags.
enum class FrameFlag : std::uint16_t {
  kDuplicate = 1U << 0,       ///< same sequence number again: ignored
  kOld = 1U << 1,             ///< sequence number or time runs backwards: ignored
  kMissingBefore = 1U << 2,   ///< frames are missing before this one: the gap was predicted
  kTimeJump = 1U << 3,        ///< the gap is too long to predict: the estimators start again
  kNotFinite = 1U << 4,       ///< a NaN or an infinity: that channel was not used
  kOutOfRange = 1U << 5,      ///< a value no sensor of this kind gives: that channel was not used
  kInnovationGate = 1U << 6,  ///< a measurement too far from its prediction: that channel was not used
  kStuck = 1U << 7,           ///< a channel has repeated one value for too long: it is not used
  kEstimatorReset = 1U << 8,  ///< an estimator was re-initialised
  kSpeedLow = 1U << 9,        ///< cutting speed below the contact law's range
  kSpeedHigh = 1U << 10,      ///< cutting speed above the contact law's range
  kNoInput = 1U << 11,        ///< an input that the plant needs was never seen: nothing to predict with
  kSequenceReset = 1U << 12,  ///< the sender started again from another sequence number
  kJump = 1U << 13,           ///< a slow quantity jumped: that channel was not used
};

constexpr std::uint16_t bits_of(FrameFlag flag) { return static_cast<std::uint16_t>(flag); }

}  // namespace morepro
