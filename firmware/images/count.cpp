#include "tests/target/count/count.hpp"

#include <array>

#include "firmware/semihosting/semihost.hpp"
#include "instruction_counter.hpp"

namespace morepro::count {
namespace {

using namespace firmware;

std::array<char, 1024> arguments{};

/// One copy, so that what it adds is the same for every function.
[[gnu::noipa]] std::uint32_t count_call(void (*body)()) {
  const std::uint32_t start = InstructionCounter::ticks();
  body();
  return InstructionCounter::instructions(start, InstructionCounter::ticks());
}

void do_nothing() {}

struct Figures {
  std::uint32_t total = 0;
  std::uint32_t most = 0;
};

Figures count_calls(const Entry& entry, std::uint32_t overhead) {
  Figures figures;
  for (std::uint32_t call = 0; call < kWarmUpCalls + entry.calls; ++call) {
    entry.prepare();
    const std::uint32_t counted = count_call(entry.body) - overhead;
    if (call < kWarmUpCalls) continue;
    figures.total += counted;
    if (counted > figures.most) figures.most = counted;
  }
  return figures;
}

void report(const Entry& entry, std::uint32_t overhead) {
  const Figures figures = count_calls(entry, overhead);
  semihost::print(entry.name);
  semihost::print(" ");
  semihost::print(figures.total / entry.calls / entry.per_call);
  semihost::print(" ");
  semihost::print(figures.most / entry.per_call);
  semihost::print("\n");
}

}  // namespace

const char* recording() { return arguments.data(); }

}  // namespace morepro::count

/// Prints `name mean most`: instructions per call of every entry. Argument: a recording. No interrupt is
/// enabled.
int main() {
  using namespace morepro;
  if (!firmware::semihost::command_line(count::arguments)) firmware::semihost::exit(2);
  firmware::InstructionCounter::start();
  const std::uint32_t overhead = count::count_call(count::do_nothing);
  for (const count::Entry* entry = count::Entry::first; entry != nullptr; entry = entry->next)
    count::report(*entry, overhead);
  firmware::semihost::exit(0);
}
