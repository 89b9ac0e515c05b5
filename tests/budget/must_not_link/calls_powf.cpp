#include <cmath>

int main(int count, char**) { return static_cast<int>(std::pow(static_cast<float>(count), -0.45F)); }
