// Reading recordings, in bytes of the file per second, each beside a plain peer in the same run: CSV beside
// strtof() on every field, native beside memcpy and beside the CRC-32 of the same bytes. The recording is a
// production run of the reference machine: once with every digit of a float32, once with the four digits that
// a data logger writes, once native.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lib/wire/crc32.hpp"
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/recording/recording_reader.hpp"
#include "sim_host/recording/recording_writer.hpp"
#include "sim_host/simulate/simulation.hpp"
#include "sim_host/support/input_file.hpp"

namespace morepro::host {
namespace {

constexpr double kDurationS = 20.0;

SensorFrame with_four_digits(SensorFrame frame) {
  for (float& value : frame.value) value = std::strtof(fmt::format("{:.4g}", value).c_str(), nullptr);
  return frame;
}

/// One simulated run in three files, there as long as the program runs.
class Recordings {
 public:
  Recordings() {
    std::filesystem::create_directory(folder_);
    const MachineDescription machine = built_in_machine("reference");
    Simulation simulation(machine.configuration,
                          {.profile = ProfileKind::kProduction, .duration_s = kDurationS});
    RecordingInfo info;
    info.recorded = simulation.recorded();
    OutputFile full_file(path("full.csv")), brief_file(path("brief.csv")), native_file(path("native.mrec"));
    RecordingWriter full(full_file, info, machine.configuration);
    RecordingWriter brief(brief_file, info, machine.configuration);
    RecordingWriter native(native_file, info, machine.configuration);
    for (SensorFrame frame; simulation.next(frame);) {
      full.write(frame);
      brief.write(with_four_digits(frame));
      native.write(frame);
    }
    native.finish();
    for (OutputFile* file : {&full_file, &brief_file, &native_file}) file->commit();
  }
  ~Recordings() { std::filesystem::remove_all(folder_); }
  Recordings(const Recordings&) = delete;
  Recordings& operator=(const Recordings&) = delete;

  [[nodiscard]] std::string path(const char* name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / fmt::format("recording_bench.{}", getpid());
};

std::string path(const char* name) {
  static const Recordings recordings;
  return recordings.path(name);
}

void report(benchmark::State& state, const std::string& file) {
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file));
  state.SetBytesProcessed(state.iterations() * bytes);
}

void read(benchmark::State& state, const char* name) {
  const std::string file = path(name);
  for (auto _ : state) {
    RecordingReader reader(file);
    float sum = 0.0F;
    for (SensorFrame frame; reader.next(frame) == hal::ReadStatus::kFrame;) sum += frame.value[0];
    benchmark::DoNotOptimize(sum);
  }
  report(state, file);
}

/// What an engineer writes first, without a check of anything.
void strtof_peer(benchmark::State& state, const char* name) {
  const std::string file = path(name);
  for (auto _ : state) {
    const InputFile input(file);
    float sum = 0.0F;
    const char* end = input.text().data() + input.text().size();
    for (const char* field = std::strchr(input.text().data(), '\n') + 1; field < end;) {
      char* next = nullptr;
      sum += std::strtof(field, &next);
      field = next + 1;
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state, file);
}

void memcpy_peer(benchmark::State& state, const char* name) {
  const std::string file = path(name);
  for (auto _ : state) {
    const InputFile input(file);
    std::vector<char> copy(input.text().size());
    std::memcpy(copy.data(), input.text().data(), copy.size());
    benchmark::DoNotOptimize(copy.data());
  }
  report(state, file);
}

void crc32_peer(benchmark::State& state, const char* name) {
  const std::string file = path(name);
  for (auto _ : state) {
    const InputFile input(file);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(input.text().data());
    benchmark::DoNotOptimize(wire::crc32(std::span(bytes, input.text().size())));
  }
  report(state, file);
}

BENCHMARK_CAPTURE(read, csv_full, "full.csv");
BENCHMARK_CAPTURE(strtof_peer, csv_full, "full.csv");
BENCHMARK_CAPTURE(read, csv_four_digits, "brief.csv");
BENCHMARK_CAPTURE(strtof_peer, csv_four_digits, "brief.csv");
BENCHMARK_CAPTURE(read, native, "native.mrec");
BENCHMARK_CAPTURE(memcpy_peer, native, "native.mrec");
BENCHMARK_CAPTURE(crc32_peer, native, "native.mrec");

}  // namespace
}  // namespace morepro::host
