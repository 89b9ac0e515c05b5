#include "firmware/semihosting/semihost.hpp"
#include "tests/support/check.hpp"

namespace morepro::check {
namespace {
int failures = 0;
}

Sink fail(const char* file, int line, const char* expression) {
  namespace semihost = firmware::semihost;
  ++failures;
  for (const char* part : {file, ": "}) semihost::print(part);
  semihost::print(static_cast<std::uint32_t>(line));
  for (const char* part : {": expected ", expression, "\n"}) semihost::print(part);
  return {};
}

}  // namespace morepro::check

/// Runs every test that is linked in; exit status 1: one failed or there were none.
int main() {
  using namespace morepro;
  namespace semihost = firmware::semihost;
  std::uint32_t count = 0;
  for (const check::Test* test = check::Test::first; test != nullptr; test = test->next, ++count) {
    for (const char* part : {test->suite, ".", test->name, "\n"}) semihost::print(part);
    test->run();
  }
  semihost::print(count);
  semihost::print(" tests\n");
  semihost::exit(check::failures == 0 && count != 0 ? 0 : 1);
}
