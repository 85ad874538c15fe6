#include "slam/ekf/joint_covariance.h"

#include <Eigen/LU>

#include "slam/math/gaussian.h"
#include "slam/models/belief.h"

namespace stereobench::slam {
namespace {

/// By its leading minors (Sylvester). What is left of a heading once x and y are known may be nothing up to
/// rounding: that is no news to project_to_psd(), which would leave it as it is.
bool is_semidefinite(const Eigen::Matrix3d& p) {
  constexpr double kClear = 1e-6;
  constexpr double kRounding = 1e-8;
  const double square = p(0, 0) * p(1, 1);
  const double minor = square - p(1, 0) * p(1, 0);
  if (!(p(0, 0) > 0.0 && minor > 0.0)) return false;
  // The determinant is rounding where x and y hang together: no correlation is beyond one either.
  for (int i = 0; i < 2; ++i)
    if (p(2, i) * p(2, i) > p(i, i) * p(2, 2) * (1.0 + kRounding)) return false;
  const double slack = minor > kClear * square ? kRounding * minor * p(2, 2) : 0.0;
  return p.determinant() > -slack;
}

}  // namespace

JointCovariance::JointCovariance(const Eigen::MatrixXd& dense) : size_(dense.rows()) {
  lower_.clear();
  for (Eigen::Index i = 0; i < size_; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) lower_.push_back(dense(i, j));
  }
}

Eigen::Matrix3d JointCovariance::pose() const {
  const double* p = lower_.data();
  Eigen::Matrix3d block;
  block << p[0], p[1], p[3], p[1], p[2], p[4], p[3], p[4], p[5];
  return block;
}

Eigen::Matrix2d JointCovariance::landmark(int index) const {
  const Eigen::Index first = row_of(index);
  const double* x = row(first) + first;
  const double* y = row(first + 1) + first;
  Eigen::Matrix2d block;
  block << x[0], y[0], y[0], y[1];
  return block;
}

Eigen::Matrix<double, 5, 5> JointCovariance::pose_and_landmark(int index) const {
  Eigen::Matrix<double, 5, 5> block;
  block.topLeftCorner<3, 3>() = pose();
  block.bottomRightCorner<2, 2>() = landmark(index);
  for (int i = 0; i < 2; ++i) {
    const double* with_pose = row(row_of(index) + i);
    for (int j = 0; j < 3; ++j) block(3 + i, j) = block(j, 3 + i) = with_pose[j];
  }
  return block;
}

Eigen::MatrixXd JointCovariance::landmarks() const {
  Eigen::MatrixXd all(size_ - 3, size_ - 3);
  for (Eigen::Index i = 3; i < size_; ++i) {
    for (Eigen::Index j = 3; j <= i; ++j) all(i - 3, j - 3) = all(j - 3, i - 3) = row(i)[j];
  }
  return all;
}

void JointCovariance::clear() {
  size_ = 3;
  lower_.assign(6, 0.0);
}

Eigen::Matrix<double, 5, 5> JointCovariance::between(int one, int other) const {
  const auto row = [](int landmark, Eigen::Index i) { return i < 3 ? i : row_of(landmark) + i - 3; };
  Eigen::Matrix<double, 5, 5> block;
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = 0; j < 5; ++j) block(i, j) = at(row(one, i), row(other, j));
  }
  return block;
}

void JointCovariance::move_pose(const Eigen::Vector2d& heading_lever, const Eigen::Matrix3d& noise) {
  const Eigen::Matrix3d moved = with_heading_error(pose(), heading_lever);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) row(i)[j] = moved(i, j) + noise(i, j);
  }
  for (Eigen::Index i = 3; i < size_; ++i) {
    double* with_pose = row(i);
    with_pose[0] += heading_lever.x() * with_pose[2];
    with_pose[1] += heading_lever.y() * with_pose[2];
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
  project_to_psd<2>(own, repairs);
  at(first, first) = own(0, 0);
  at(first + 1, first) = own(1, 0);
  at(first + 1, first + 1) = own(1, 1);
}

void JointCovariance::with_sighting(int index, const Eigen::Matrix<double, 2, 5>& slope,
                                    const Eigen::Matrix<double, 2, 5>& near, Columns& product) const {
  product.resize(size_, 2);
  const auto along = [&](Eigen::Index i, double with_x, double with_y) {
    const double* with_pose = row(i);
    const Eigen::Vector2d with_seen = slope.col(0) * with_pose[0] + slope.col(1) * with_pose[1] +
                                      slope.col(2) * with_pose[2] + slope.col(3) * with_x +
                                      slope.col(4) * with_y;
    product.row(i) = with_seen.transpose();
  };
  const Eigen::Index first = row_of(index);
  const double* x = row(first);
  const double* y = row(first + 1);
  product.topRows<3>() = near.leftCols<3>().transpose();
  for (Eigen::Index i = 3; i < first; ++i) along(i, x[i], y[i]);
  product.middleRows<2>(first) = near.rightCols<2>().transpose();
  for (Eigen::Index i = first + 2; i < size_; ++i) along(i, row(i)[first], row(i)[first + 1]);
}

void JointCovariance::with_difference(int from, int to, Columns& product) const {
  product.resize(size_, 2);
  for (Eigen::Index i = 0; i < size_; ++i) {
    for (Eigen::Index j = 0; j < 2; ++j) product(i, j) = at(i, row_of(to) + j) - at(i, row_of(from) + j);
  }
}

void JointCovariance::subtract(const Columns& whitened, long& repairs) {
  using Pair = Eigen::Map<Eigen::Vector2d>;
  using Known = Eigen::Map<const Eigen::Vector2d>;
  const double* a = whitened.col(0).data();
  const double* b = whitened.col(1).data();
  double* next = lower_.data();
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) *next++ -= a[i] * a[j] + b[i] * b[j];
  }
  for (Eigen::Index i = 3; i < size_; i += 2) {  // both rows of a landmark in one go, two columns at a time
    double* x = next;
    double* y = x + i + 1;
    for (Eigen::Index j = 0; j <= i; j += 2) {
      const Known with_a(a + j), with_b(b + j);
      Pair(x + j) -= a[i] * with_a + b[i] * with_b;
      Pair(y + j) -= a[i + 1] * with_a + b[i + 1] * with_b;
    }
    y[i + 1] -= a[i + 1] * a[i + 1] + b[i + 1] * b[i + 1];
    next = y + i + 2;
  }
  if (!is_semidefinite(pose())) project_block<3>(0, repairs);
  for (Eigen::Index first = 3; first < size_; first += 2) {
    const double x = row(first)[first];
    const double* last = row(first + 1) + first;  // covariance with x, then y's own variance
    if (!(x > 0.0 && last[1] > 0.0 && last[0] * last[0] < x * last[1])) project_block<2>(first, repairs);
  }
}

/// Rounding has taken too much of a block, or it was singular all along.
template <int kSize>
void JointCovariance::project_block(Eigen::Index first, long& repairs) {
  for (Eigen::Index i = first; i < first + kSize; ++i) {
    if (at(i, i) >= 0.0) continue;
    for (Eigen::Index j = 0; j < size_; ++j) at(i, j) = 0.0;
    ++repairs;
  }
  Eigen::Matrix<double, kSize, kSize> block;
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) block(i, j) = at(first + i, first + j);
  }
  project_to_psd<kSize>(block, repairs);
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j <= i; ++j) at(first + i, first + j) = block(i, j);
  }
}

}  // namespace stereobench::slam
