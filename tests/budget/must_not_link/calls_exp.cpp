#include <cmath>

int main(int count, char**) { return static_cast<int>(std::exp(static_cast<double>(count))); }
