#include <gtest/gtest.h>

#include "lib/math/phi_functions.hpp"

namespace morepro::math {
namespace {

/// The sum of z^i / (i + k)!, term by term, in long double.
double sum_of(int k, double z) {
  long double term = 1.0L;
  for (int i = 1; i <= k; ++i) term /= static_cast<long double>(i);
  long double sum = 0.0L;
  for (int i = 0; i < 200; ++i) {
    sum += term;
    term *= static_cast<long double>(z) / static_cast<long double>(i + 1 + k);
  }
  return static_cast<double>(sum);
}

template <class Real>
void expect_sums(Real z, double relative) {
  const PhiFunctions<Real> phi(z);
  const Real found[] = {phi.exp, phi.phi1, phi.phi2, phi.phi3, phi.phi4};
  for (int k = 0; k < 5; ++k) {
    const double sum = sum_of(k, static_cast<double>(z));
    EXPECT_NEAR(static_cast<double>(found[k]), sum, relative * sum) << "phi" << k << " at " << z;
  }
}

// Both ways to work them out, where they meet, and far from zero, where the state has decayed.
TEST(PhiFunctions, AreTheirSums) {
  for (const double z : {-12.0, -3.0, -1.0, -0.31, -0.29, -0.01, 0.0, 1.0e-9, 0.2, 0.299, 0.3, 1.0, 5.0}) {
    expect_sums(z, 1.0e-9);
    expect_sums(static_cast<float>(z), 1.0e-3);
  }
}

}  // namespace
}  // namespace morepro::math
