#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "lib/math/ldl.hpp"

namespace morepro {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3>;
using Vector3 = Eigen::Matrix<double, 3, 1>;

Matrix3 sample() {
  Matrix3 s;
  s << 4.0, 2.0, -1.0, 2.0, 6.0, 0.5, -1.0, 0.5, 3.0;
  return s;
}

TEST(Ldl, SolvesWhatItFactored) {
  const math::Ldl<double, 3> ldl(sample());
  const Vector3 b{1.0, -2.0, 0.5};
  ASSERT_TRUE(ldl.is_positive());
  EXPECT_LE((sample() * ldl.solve(b) - b).norm(), 1.0e-15);
  EXPECT_NEAR(ldl.log_determinant(), std::log(sample().determinant()), 1.0e-15);
}

TEST(Ldl, RefusesWhatIsNotPositive) {
  Matrix3 s = sample();
  s(2, 2) = 0.1;
  EXPECT_FALSE((math::Ldl<double, 3>(s).is_positive()));
  EXPECT_FALSE((math::Ldl<double, 3>(Matrix3::Zero()).is_positive()));
}

TEST(Ldl, RefusesNanAndInfinity) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int i = 0; i < 3; ++i) {
      Matrix3 s = sample();
      s(i, i) = bad;
      EXPECT_FALSE((math::Ldl<double, 3>(s).is_positive())) << i;
    }
  }
}

}  // namespace
}  // namespace morepro
