#include <array>
#include <functional>

std::function<int(int)> function;

int main(int count, char**) {
  std::array<int, 16> captured{};
  captured[0] = count;
  function = [captured](int index) { return captured[static_cast<unsigned>(index) % 16]; };
  return function(count);
}
