/// The covariance of a pose and all landmarks together.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace stereobench::slam {

/// Covariances of (x, y, heading) and of any number of landmarks (x, y), each with every other.
///
/// The lower triangle is kept row by row: a landmark found is two more rows at the end, symmetry cannot be
/// lost, and a correction runs through memory once from front to back.
class JointCovariance {
 public:
  /// By row of the state: its covariances with the two numbers of a sighting.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2>;

  JointCovariance() = default;

  /// @param dense symmetric, of (x, y, heading) and landmarks
  explicit JointCovariance(const Eigen::MatrixXd& dense);

  /// Where the coordinates of a landmark begin in the state.
  static Eigen::Index row_of(int landmark) { return 3 + 2 * landmark; }

  Eigen::Matrix3d pose() const;
  Eigen::Matrix2d landmark(int index) const;

  /// @return of (pose, landmark)
  Eigen::Matrix<double, 5, 5> pose_and_landmark(int index) const;

  /// @return between (pose, one landmark) and (pose, another)
  Eigen::Matrix<double, 5, 5> between(int one, int other) const;

  /// @return of all landmarks, without the pose
  Eigen::MatrixXd landmarks() const;

  /// Forgets all landmarks and all uncertainty, and keeps the memory for those to come.
  void clear();

  /// The pose moves, which no landmark feels: O(n).
  /// @param swing by which errors in x and y grow with that of the heading, m/rad
  void move_pose(const Eigen::Vector2d& heading_lever, const Eigen::Matrix3d& noise);

  /// A landmark becomes by_pose * pose + noise: O(n).
  ///
  /// @param index of a landmark that is forgotten, or one more than the last
  /// @param repairs counts a block that came out indefinite
  void place(int index, const Eigen::Matrix<double, 2, 3>& by_pose, const Eigen::Matrix2d& noise,
             long& repairs);

  /// P H' for a sighting with slopes by (pose, landmark), in O(n).
  ///
  /// @param near what is known of it: slope * pose_and_landmark(index)
  /// @param product receives it; memory is asked for when its size changes alone
  void with_sighting(int index, const Eigen::Matrix<double, 2, 5>& slope,
                     const Eigen::Matrix<double, 2, 5>& near, Columns& product) const;

  /// P H' for the way from one landmark to another, in O(n).
  ///
  /// @param product receives it
  void with_difference(int from, int to, Columns& product) const;

  /// P - W W', in O(n^2) / 2.
  ///
  /// @param whitened W = P H' L^-T, where L L' is the sighting's covariance
  /// @param repairs counts blocks of the pose or a landmark that came out indefinite: what is negative in
  /// them becomes zero, and where that is a variance, so do its covariances
  void subtract(const Columns& whitened, long& repairs);

 private:
  template <int kSize>
  void project_block(Eigen::Index first, long& repairs);
  Eigen::Index size() const { return size_; }
  double* row(Eigen::Index index) { return lower_.data() + index * (index + 1) / 2; }
  const double* row(Eigen::Index index) const { return lower_.data() + index * (index + 1) / 2; }
  double& at(Eigen::Index i, Eigen::Index j) { return i >= j ? row(i)[j] : row(j)[i]; }
  double at(Eigen::Index i, Eigen::Index j) const { return i >= j ? row(i)[j] : row(j)[i]; }

  Eigen::Index size_ = 3;
  std::vector<double> lower_ = std::vector<double>(6, 0.0);
};

}  // namespace stereobench::slam
