#include <vector>

int main(int count, char**) {
  std::vector<int> numbers;
  numbers.push_back(count);
  return numbers.back();
}
