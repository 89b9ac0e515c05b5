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

TEST(Ldl, ItsSmallestPivotTellsHowNearASingularMatrixIs) {
  Matrix3 s = Matrix3::Identity();
  EXPECT_EQ((math::Ldl<double, 3>(s).smallest_pivot(Vector3::Ones())), 1.0);
  EXPECT_EQ((math::Ldl<double, 3>(s).smallest_pivot({0.5, 0.25, 2.0})), 0.25);
  s(0, 0) = 4.0;
  s(1, 0) = s(0, 1) = 1.9;
  EXPECT_NEAR((math::Ldl<double, 3>(s).smallest_pivot(Vector3::Ones())), 1.0 - 1.9 * 1.9 / 4.0, 1.0e-15);
  s(1, 0) = s(0, 1) = 2.1;
  EXPECT_LT((math::Ldl<double, 3>(s).smallest_pivot(Vector3::Ones())), 0.0);
  s(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((math::Ldl<double, 3>(s).smallest_pivot(Vector3::Ones()) >= 0.0));
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
