#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "lib/wire/decoder.hpp"

namespace {

using namespace morepro;

constexpr std::size_t kFrames = 20000;

/// A recording of the reference machine's size: eight channels, with the zeros that real signals have.
SensorFrame typical_frame(std::uint32_t sequence) {
  const float t = 1.0e-4F * static_cast<float>(sequence);
  SensorFrame frame{.sequence = sequence, .time_us = 100 * sequence};
  frame.set(Channel::kArmatureVoltage, 40.0F);
  frame.set(Channel::kFeedForce, 25.0F + 3.0F * std::sin(30.0F * t));
  frame.set(Channel::kContact, sequence % 5000 > 2000 ? 1.0F : 0.0F);
  frame.set(Channel::kEngagement, 1.0F);
  frame.set(Channel::kSpindleSpeed, 450.0F + 11.0F * std::sin(50.0F * t));
  frame.set(Channel::kFeedSpeed, 0.02F + 0.003F * std::sin(70.0F * t));
  frame.set(Channel::kArmatureCurrent, 5.0F + 1.7F * std::sin(90.0F * t));
  frame.set(Channel::kToolTemperature, 500.0F);
  return frame;
}

SensorFrame full_frame(std::uint32_t sequence) {
  SensorFrame frame = typical_frame(sequence);
  for (std::size_t k = 0; k < kChannelCount; ++k)
    if (!frame.has(static_cast<Channel>(k)))
      frame.set(static_cast<Channel>(k), std::sin(static_cast<float>(sequence + k)));
  return frame;
}

std::vector<std::uint8_t> recording(SensorFrame (*make)(std::uint32_t)) {
  std::vector<std::uint8_t> bytes(kFrames * wire::kMaxEncodedSize<SensorFrame>);
  std::size_t size = 0;
  for (std::uint32_t k = 0; k < kFrames; ++k) size += wire::encode(make(k), std::span(bytes).subspan(size));
  bytes.resize(size);
  return bytes;
}

void report(benchmark::State& state, std::size_t bytes) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kFrames));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes));
}

void decode_spans(benchmark::State& state, SensorFrame (*make)(std::uint32_t)) {
  const auto bytes = recording(make);
  wire::Decoder decoder;
  for (auto _ : state) {
    float sum = 0.0F;
    std::span<const std::uint8_t> rest(bytes);
    while (decoder.next(rest) == wire::DecodeEvent::kRecord)
      if (const auto* frame = std::get_if<SensorFrame>(&decoder.record())) sum += frame->value[0];
    benchmark::DoNotOptimize(sum);
  }
  report(state, bytes.size());
}
BENCHMARK_CAPTURE(decode_spans, 8_channels, typical_frame);
BENCHMARK_CAPTURE(decode_spans, 14_channels, full_frame);

void decode_bytes(benchmark::State& state, SensorFrame (*make)(std::uint32_t)) {
  const auto bytes = recording(make);
  wire::Decoder decoder;
  for (auto _ : state) {
    std::size_t records = 0;
    for (const std::uint8_t byte : bytes) records += decoder.push(byte) == wire::DecodeEvent::kRecord ? 1 : 0;
    benchmark::DoNotOptimize(records);
  }
  report(state, bytes.size());
}
BENCHMARK_CAPTURE(decode_bytes, 8_channels, typical_frame);

void encode_frames(benchmark::State& state, SensorFrame (*make)(std::uint32_t)) {
  std::vector<SensorFrame> frames;
  for (std::uint32_t k = 0; k < kFrames; ++k) frames.push_back(make(k));
  std::vector<std::uint8_t> out(wire::kMaxEncodedSize<SensorFrame>);
  std::size_t bytes = 0;
  for (auto _ : state) {
    bytes = 0;
    for (const auto& frame : frames) bytes += wire::encode(frame, out);
    benchmark::DoNotOptimize(bytes);
  }
  report(state, bytes);
}
BENCHMARK_CAPTURE(encode_frames, 8_channels, typical_frame);

template <std::size_t kSlices>
void crc32(benchmark::State& state) {
  const std::vector<std::uint8_t> bytes(kFrames, 0x5A);
  for (auto _ : state) benchmark::DoNotOptimize(wire::crc32<kSlices>(bytes));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes.size()));
}
BENCHMARK(crc32<1>);
BENCHMARK(crc32<8>);

void encode_health(benchmark::State& state) {
  std::vector<std::uint8_t> out(wire::kMaxEncodedSize<Health>);
  Health health;
  for (auto _ : state) {
    ++health.sequence;
    benchmark::DoNotOptimize(wire::encode(health, out));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(encode_health);

}  // namespace

BENCHMARK_MAIN();
