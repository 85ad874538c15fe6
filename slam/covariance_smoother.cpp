#include "slam/covariance_smoother.h"

#include <algorithm>

namespace stereobench::slam {

std::vector<Eigen::Matrix3d> CovarianceSmoother::covariances() const {
  Eigen::Index size = 3;
  for (const auto& change : changes_) size += std::holds_alternative<Append>(change) ? 2 : 0;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  std::vector<Eigen::Matrix3d> covariances;
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
    if (const Keep* keep = std::get_if<Keep>(&*change)) {
      const Eigen::Matrix3d taken = keep->rows * information * keep->rows.transpose();
      covariances.push_back(keep->rows.leftCols<3>() - 0.5 * (taken + taken.transpose()));
    }
    if (const Move* move = std::get_if<Move>(&*change)) undo(*move, information);
    if (const Append* append = std::get_if<Append>(&*change)) undo(*append, information);
    if (const Correct* correct = std::get_if<Correct>(&*change)) undo(*correct, information);
  }
  std::ranges::reverse(covariances);
  return covariances;
}

/// F' L F, where F is the identity but for the pose.
void CovarianceSmoother::undo(const Move& move, Eigen::MatrixXd& information) {
  information.topRows<3>() = (move.slope.transpose() * information.topRows<3>()).eval();
  information.leftCols<3>() = (information.leftCols<3>() * move.slope).eval();
}

/// F' L F, where F is the identity with the landmark's two rows below it.
void CovarianceSmoother::undo(const Append& append, Eigen::MatrixXd& information) {
  const Eigen::Index before = information.rows() - 2;
  Eigen::MatrixXd folded = information.topLeftCorner(before, before);
  const Eigen::MatrixXd below = information.bottomLeftCorner(2, before);
  folded.topRows<3>() += append.slope.transpose() * below;
  folded.leftCols<3>() += below.transpose() * append.slope;
  folded.topLeftCorner<3, 3>() +=
      append.slope.transpose() * information.bottomRightCorner<2, 2>() * append.slope;
  information = std::move(folded);
}

/// (I - K H)' L (I - K H) + H' S+ H with K = P H' S+. With V = L+ H and W = L+ H P, K H = W' V.
void CovarianceSmoother::undo(const Correct& correct, Eigen::MatrixXd& information) {
  const Eigen::MatrixXd v = correct.whitener * correct.slope;
  const Eigen::MatrixXd& w = correct.whitened_cross;
  const Eigen::MatrixXd wl = w * information;
  Eigen::MatrixXd middle = wl * w.transpose();
  middle.diagonal().array() += 1.0;
  information += v.transpose() * (middle * v - wl) - wl.transpose() * v;
}

}  // namespace stereobench::slam
