/// What the future tells of a pose that a Kalman filter has left behind, without its measurements.
#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace stereobench::slam {

/// The fixed-interval smoother of Bryson and Frazier in Bierman's form (G. J. Bierman, "Fixed interval
/// smoothing with discrete measurements", Int. J. Control 18, 1973), for covariances alone.
///
/// A filter reports each change of its joint covariance P of pose and landmarks while it goes forward. The
/// way back carries the information L that later measurements hold about the state, and the covariance given
/// all of them is P - P L P. Unlike in Rauch, Tung and Striebel's form no covariance is inverted, so that a
/// known start, the rank two of a control's noise and landmarks that come into the state later are nothing
/// special.
class CovarianceSmoother {
 public:
  /// The pose moved. @param slope d pose / d pose before
  void move(const Eigen::Matrix3d& slope) { changes_.emplace_back(Move{slope}); }

  /// A landmark was put behind the state. @param slope d landmark / d pose
  void append(const Eigen::Matrix<double, 2, 3>& slope) { changes_.emplace_back(Append{slope}); }

  /// A measurement z = H x + v corrected the state, with S = H P H' + R.
  /// @param slope H
  /// @param whitener L+ with (L+)' L+ = S+, the pseudo-inverse
  /// @param whitened_cross L+ H P, with P from before the measurement
  void correct(Eigen::SparseMatrix<double> slope, Eigen::MatrixXd whitener, Eigen::MatrixXd whitened_cross) {
    changes_.emplace_back(Correct{std::move(slope), std::move(whitener), std::move(whitened_cross)});
  }

  /// Asks for the covariance of the pose as it is now. @param rows of P that are the pose's
  void keep(Eigen::MatrixXd rows) { changes_.emplace_back(Keep{std::move(rows)}); }

  /// @return for each pose that was kept, in that order, its covariance given all measurements so far
  std::vector<Eigen::Matrix3d> covariances() const;

 private:
  struct Move {
    Eigen::Matrix3d slope;
  };
  struct Append {
    Eigen::Matrix<double, 2, 3> slope;
  };
  struct Correct {
    Eigen::SparseMatrix<double> slope;
    Eigen::MatrixXd whitener, whitened_cross;
  };
  struct Keep {
    Eigen::MatrixXd rows;
  };

  static void undo(const Move& move, Eigen::MatrixXd& information);
  static void undo(const Append& append, Eigen::MatrixXd& information);
  static void undo(const Correct& correct, Eigen::MatrixXd& information);

  std::vector<std::variant<Move, Append, Correct, Keep>> changes_;
};

}  // namespace stereobench::slam
