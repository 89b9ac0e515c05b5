#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace morepro::host {

/// One part of what runs on the board, with input of its own.
struct BenchUnit {
  std::string_view name;
  std::string_view what;
  std::size_t bytes;                             ///< of memory that it keeps from call to call
  std::function<void(std::uint32_t calls)> run;  ///< so many calls, one after the other
};

/// The whole monitor first, then its parts. They keep their state from call to call.
std::vector<BenchUnit> bench_units();

}  // namespace morepro::host
