#pragma once
#include <cmath>

namespace morepro::host {

/// Natural logarithms of a number that is mostly the last one again, as the variance of an observer that has
/// settled is.
class RepeatedLogarithm {
 public:
  double operator()(double number) {
    if (number != number_) {
      number_ = number;
      value_ = std::log(number);
    }
    return value_;
  }

 private:
  double number_ = 1.0;
  double value_ = 0.0;
};

}  // namespace morepro::host
