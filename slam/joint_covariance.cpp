#include "slam/joint_covariance.h"

namespace stereobench::slam {

Eigen::Matrix3d JointCovariance::pose() const {
  Eigen::Matrix3d block;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) block(i, j) = at(i, j);
  }
  return block;
}

Eigen::Matrix2d JointCovariance::landmark(int index) const {
  const Eigen::Index first = row_of(index);
  Eigen::Matrix2d block;
  block << at(first, first), at(first, first + 1), at(first + 1, first), at(first + 1, first + 1);
  return block;
}

Eigen::Matrix<double, 5, 5> JointCovariance::pose_and_landmark(int index) const {
  Eigen::Matrix<double, 5, 5> block;
  block.topLeftCorner<3, 3>() = pose();
  block.bottomRightCorner<2, 2>() = landmark(index);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 3; ++j) block(3 + i, j) = block(j, 3 + i) = at(row_of(index) + i, j);
  }
  return block;
}

Eigen::Matrix<double, 5, 5> JointCovariance::between(int one, int other) const {
  const auto row = [](int landmark, Eigen::Index i) { return i < 3 ? i : row_of(landmark) + i - 3; };
  Eigen::Matrix<double, 5, 5> block;
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = 0; j < 5; ++j) block(i, j) = at(row(one, i), row(other, j));
  }
  return block;
}

void JointCovariance::move_pose(const Eigen::Matrix3d& by_pose, const Eigen::Matrix3d& noise) {
  const Eigen::Matrix3d moved = by_pose * pose() * by_pose.transpose() + noise;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) at(i, j) = moved(i, j);
  }
  for (Eigen::Index i = 3; i < size_; ++i) {
    Eigen::Map<Eigen::Vector3d> with_pose(row(i));
    with_pose = (by_pose * with_pose).eval();
  }
}

void JointCovariance::place(int index, const Eigen::Matrix<double, 2, 3>& by_pose,
                            const Eigen::Matrix2d& noise) {
  const Eigen::Index first = row_of(index);
  if (first == size_) {
    size_ += 2;
    lower_.resize(static_cast<std::size_t>(size_ * (size_ + 1) / 2));
  }
  for (Eigen::Index j = 0; j < size_; ++j) {
    if (j == first || j == first + 1) continue;
    const Eigen::Vector2d with_other = by_pose * Eigen::Vector3d(at(j, 0), at(j, 1), at(j, 2));
    at(first, j) = with_other.x();
    at(first + 1, j) = with_other.y();
  }
  const Eigen::Matrix2d own = by_pose * pose() * by_pose.transpose() + noise;
  at(first, first) = own(0, 0);
  at(first + 1, first) = own(1, 0);
  at(first + 1, first + 1) = own(1, 1);
}

JointCovariance::Columns JointCovariance::with_sighting(int index,
                                                        const Eigen::Matrix<double, 2, 5>& slope) const {
  const Eigen::Index first = row_of(index);
  Columns product(size_, 2);
  for (Eigen::Index i = 0; i < size_; ++i) {
    Eigen::Matrix<double, 5, 1> with_seen;
    with_seen << at(i, 0), at(i, 1), at(i, 2), at(i, first), at(i, first + 1);
    product.row(i) = slope * with_seen;
  }
  return product;
}

void JointCovariance::subtract(const Columns& whitened, long& repairs) {
  for (Eigen::Index i = 0; i < size_; ++i) {
    Eigen::Map<Eigen::VectorXd>(row(i), i + 1) -=
        whitened(i, 0) * whitened.col(0).head(i + 1) + whitened(i, 1) * whitened.col(1).head(i + 1);
  }
  for (Eigen::Index i = 0; i < size_; ++i) {
    if (at(i, i) >= 0.0) continue;
    for (Eigen::Index j = 0; j < size_; ++j) at(i, j) = 0.0;
    ++repairs;
  }
}

}  // namespace stereobench::slam
