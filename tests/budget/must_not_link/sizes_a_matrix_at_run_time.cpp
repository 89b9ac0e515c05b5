#include <Eigen/Core>

int main(int count, char**) {
  const Eigen::MatrixXf matrix = Eigen::MatrixXf::Constant(count, count, 1.0F);
  return static_cast<int>(matrix.sum());
}
