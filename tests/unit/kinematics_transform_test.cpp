#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lib/kinematics/rotation_vector.hpp"

namespace morepro::kinematics {
namespace {

using Vector = Vector3<double>;
using Matrix = Matrix3<double>;

// A handful of operations on numbers up to pi, each 1.1e-16 of its value.
constexpr double kTolerance = 5.0e-15;

Vector random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> component(-size, size);
  return {component(random), component(random), component(random)};
}

double difference(const Matrix& a, const Matrix& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST(KinematicsTransform, AQuarterTurnAboutEachAxisTakesTheNextAxisToTheOneAfter) {
  const double quarter = std::acos(0.0);
  EXPECT_LE((rotation_x(quarter) * Vector::UnitY() - Vector::UnitZ()).norm(), kTolerance);
  EXPECT_LE((rotation_y(quarter) * Vector::UnitZ() - Vector::UnitX()).norm(), kTolerance);
  EXPECT_LE((rotation_z(quarter) * Vector::UnitX() - Vector::UnitY()).norm(), kTolerance);
}

TEST(KinematicsTransform, RollPitchAndYawTurnAboutFixedAxesInThisOrder) {
  const Matrix expected = rotation_z(0.3) * rotation_y(-0.2) * rotation_x(0.1);
  EXPECT_LE(difference(rotation_of(Vector(0.1, -0.2, 0.3)), expected), kTolerance);
}

TEST(KinematicsTransform, InverseUndoesAndProductsChain) {
  const Transform<double> a{rotation_of(Vector(0.4, 0.5, 0.6)), {1.0, 2.0, 3.0}};
  const Transform<double> b{rotation_of(Vector(-1.4, 0.7, 2.6)), {-0.1, 0.2, 0.9}};
  const Vector point(0.7, -0.8, 0.9);
  EXPECT_LE((a.inverse() * (a * point) - point).norm(), kTolerance);
  EXPECT_LE(((a * b) * point - a * (b * point)).norm(), kTolerance);
  EXPECT_LE(((a * b).matrix() - a.matrix() * b.matrix()).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(KinematicsTransform, AnglesComeBackFromTheirRotation) {
  std::mt19937 random(3);
  for (int k = 0; k < 1000; ++k) {
    Vector angles = random_vector(random, 3.1);
    angles(1) *= 0.48;
    // Beside a pitch of +-90 degrees the other two lose digits: 1/cos(1.49) = 12.
    EXPECT_LE((angles_of(rotation_of(angles)) - angles).norm(), 20 * kTolerance) << angles.transpose();
  }
}

TEST(KinematicsTransform, AnglesAtAPitchOfNinetyDegreesGiveTheSameRotation) {
  for (const double pitch : {std::acos(0.0), -std::acos(0.0)}) {
    const Matrix r = rotation_of(Vector(0.3, pitch, 0.8));
    EXPECT_LE(difference(rotation_of(angles_of(r)), r), kTolerance);
    EXPECT_EQ(angles_of(r)(0), 0.0);
  }
}

TEST(KinematicsTransform, ARotationVectorComesBackAtEveryAngle) {
  std::mt19937 random(4);
  for (const double angle : {1.0e-12, 1.0e-6, 0.1, 1.5, 2.9, 3.1, 3.14, 3.141592}) {
    for (int k = 0; k < 200; ++k) {
      const Vector v = random_vector(random, 1.0).normalized() * angle;
      EXPECT_LE((rotation_vector(rotation_about(v)) - v).norm(), kTolerance * std::max(1.0, angle)) << angle;
    }
  }
}

TEST(KinematicsTransform, AHalfTurnHasAnAxisOfEitherSign) {
  std::mt19937 random(5);
  for (int k = 0; k < 200; ++k) {
    const Matrix r = rotation_about(Vector(random_vector(random, 1.0).normalized() * std::acos(-1.0)));
    EXPECT_LE(difference(rotation_about(rotation_vector(r)), r), kTolerance);
  }
  EXPECT_EQ(rotation_vector(Matrix(Matrix::Identity())).norm(), 0.0);
  EXPECT_EQ(rotation_about(Vector(Vector::Zero())), Matrix::Identity());
}

// In float an angle of up to pi is rounded by 1.2e-7, sines by as much, their quotient twice.
TEST(KinematicsTransform, ARotationVectorComesBackInFloat) {
  std::mt19937 random(6);
  double worst = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const Vector3<float> v = random_vector(random, 1.7).cast<float>();
    if (v.norm() > 3.1F) continue;
    worst = std::max(worst, static_cast<double>((rotation_vector(rotation_about(v)) - v).norm()));
  }
  EXPECT_LE(worst, 2.0e-6);
}

}  // namespace
}  // namespace morepro::kinematics
