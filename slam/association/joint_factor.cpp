#include "slam/association/joint_factor.h"

#include <utility>

namespace stereobench::slam {

void JointFactor::push(std::size_t pair) {
  std::vector<Eigen::Matrix2d> row;
  Eigen::Matrix2d rest = pairings_[pair].covariance;
  Eigen::Vector2d residual = pairings_[pair].residual;
  for (const Row& before : chosen_) {
    Eigen::Matrix2d block = tie_(pair, before.pair);
    for (std::size_t i = 0; i < row.size(); ++i) block -= row[i] * before.blocks[i].transpose();
    row.push_back(before.factor.whiten<2>(block));
    rest -= row.back() * row.back().transpose();
    residual -= row.back() * before.white;
  }
  long repaired = 0;  // of a search, not of a belief
  const Factor2 factor(rest, repaired);
  const Eigen::Vector2d white = factor.whiten<1>(residual.transpose()).transpose();
  const double length = white.squaredNorm();
  chosen_.push_back({pair, std::move(row), factor, white, squared_length() + length,
                     cost() + length + factor.log_det_2_pi()});
}

std::vector<std::size_t> JointFactor::pairs() const {
  std::vector<std::size_t> list;
  for (const Row& row : chosen_) list.push_back(row.pair);
  return list;
}

}  // namespace stereobench::slam
