#include "slam/joint_covariance.h"

#include <Eigen/LU>

#include "slam/gaussian.h"

namespace stereobench::slam {
namespace {

/// By its leading minors (Sylvester).
bool is_definite(const Eigen::Matrix3d& p) {
  return p(0, 0) > 0.0 && p(0, 0) * p(1, 1) > p(1, 0) * p(1, 0) && p.determinant() > 0.0;
}

}  // namespace

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
                            const Eigen::Matrix2d& noise, long& repairs) {
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
  Eigen::Matrix2d own = by_pose * pose() * by_pose.transpose() + noise;
  mend<2>(own, repairs);
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
  if (!is_definite(pose())) mend_block<3>(0, repairs);
  for (Eigen::Index first = 3; first < size_; first += 2) {
    const double x = row(first)[first];
    const double* last = row(first + 1) + first;  // covariance with x, then y's own variance
    if (!(x > 0.0 && last[1] > 0.0 && last[0] * last[0] < x * last[1])) mend_block<2>(first, repairs);
  }
}

/// Rounding has taken too much of a block, or it was singular all along.
template <int kSize>
void JointCovariance::mend_block(Eigen::Index first, long& repairs) {
  for (Eigen::Index i = first; i < first + kSize; ++i) {
    if (at(i, i) >= 0.0) continue;
    for (Eigen::Index j = 0; j < size_; ++j) at(i, j) = 0.0;
    ++repairs;
  }
  Eigen::Matrix<double, kSize, kSize> block;
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) block(i, j) = at(first + i, first + j);
  }
  mend<kSize>(block, repairs);
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j <= i; ++j) at(first + i, first + j) = block(i, j);
  }
}

}  // namespace stereobench::slam
