/// The most probable path and map, kept up to date frame by frame.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "slam/models/belief.h"
#include "slam/models/residuals.h"
#include "slam/smoother/bayes_tree.h"

namespace stereobench::slam {

/// All poses at which something was seen and all landmarks, tied by motions and sightings: a factor graph,
/// whose mode is followed by Gauss-Newton steps (iSAM2; Kaess et al., IJRR 2012).
///
/// A factor is linearised anew where its residual is off by more than kCurved standard deviations from what
/// its slopes say. Where a step does not lower the cost, all that it concerns is linearised anew first, and
/// the step is halved only then: old slopes can point uphill.
class PathGraph {
 public:
  /// @param start world_from_robot, known exactly
  explicit PathGraph(const Pose& start);

  /// Adds the pose after a motion from the last one.
  ///
  /// @param motion in the robot's frame before it; the covariance may have any rank
  /// @param guess where the search for it starts
  void add_pose(const PoseBelief& motion, const Pose& guess);

  /// @param guess where the search for it starts, m in the world
  /// @return the landmark's variable
  int add_landmark(const Eigen::Vector2d& guess);

  /// @param landmark a landmark's variable, seen from the last pose
  /// @param observation whose noise is read at the range where the landmark is now (noise_at())
  void add_sighting(int landmark, const Observation& observation);

  /// Two landmarks are at one place.
  void add_same_place(int one, int other);

  /// Goes to the mode of all that was added. Of a long past most is left behind, until somebody asks for it
  /// or the graph has grown by a share: then all of it is linearised anew.
  void solve();

  /// Brings variables of the past to where they belong now.
  void catch_up(std::span<const int> variables);

  /// @return the last pose, or the start
  Pose pose() const;
  Eigen::Vector2d landmark(int variable) const { return value(variable).head<2>(); }

  /// @return all values, by variable, where they belong now
  std::vector<Eigen::Vector3d> settled() const;

  /// @param landmarks variables, each once
  /// @return of the last pose (x, y, heading; zeros for the start) and landmarks, in their order
  Eigen::MatrixXd covariance(std::span<const int> landmarks) const;

  /// How many factors could not be used, and directions of which nothing was known.
  long repairs() const { return refused_ + tree_.repairs(); }

 private:
  static constexpr int kStart = -1;

  /// How many variables of the past may be solved anew at once; those beyond are left behind.
  static constexpr std::size_t kMostOfThePast = 300;

  struct Motion {
    int from;  ///< variable, or kStart
    int to;
    MotionResidual residual;
  };
  struct Sighted {
    int pose;
    int landmark;
    SightingResidual residual;
  };
  /// What the curvature of a factor's residual depends on.
  struct Sight {
    Eigen::Vector2d apart = Eigen::Vector2d::Zero();  ///< from its pose to what it sees, in the world
    double heading_rad = 0.0;                         ///< of a motion: half way of its turn
  };
  enum class Kind { kMotion, kSighting, kSamePlace };
  struct SamePlace {
    int one;
    int other;
  };
  struct GraphFactor {
    Kind kind;
    std::size_t index;  ///< among those of its kind
    Sight linearised;   ///< where its slopes were taken
  };
  /// Residual and slopes of a factor at some values.
  struct Linear {
    Eigen::Vector3d residual = Eigen::Vector3d::Zero();
    BayesTree::Factor factor;
  };

  using Residuals = std::vector<Eigen::Vector3d>;

  const Eigen::Vector3d& value(int variable) const { return values_[static_cast<std::size_t>(variable)]; }
  Eigen::Vector3d& value(int variable) { return values_[static_cast<std::size_t>(variable)]; }
  int add_variable(int numbers, const Eigen::Vector3d& guess);
  void add(Kind kind, std::size_t index);
  Linear linearise(std::size_t factor) const;
  Linear linearise(const Motion& motion) const;
  Linear linearise(const Sighted& sighted) const;
  Sight sight_of(std::size_t factor) const;
  Eigen::Vector3d foreseen(std::size_t factor) const;
  bool is_as_linear(std::size_t factor) const;
  Residuals residuals_of(std::span<const std::size_t> factors) const;
  static double cost_of(const Residuals& residuals);
  std::vector<std::size_t> curved(std::span<const std::size_t> factors, const Residuals& residuals) const;
  void linearise_anew(std::span<const std::size_t> factors);
  void renew();
  std::vector<int> changed_variables();
  std::vector<std::size_t> concerned_by(std::span<const int> changed) const;
  template <class Go>
  std::vector<std::size_t> go_part_of_the_way(const Go& go, std::span<const std::size_t> concerned,
                                              double limit);
  bool step(std::span<const int> changed);

  Pose start_;
  BayesTree tree_;
  std::vector<Eigen::Vector3d> values_;  ///< by variable; a pose's heading is not wrapped
  std::vector<Motion> motions_;
  std::vector<Sighted> sightings_;
  std::vector<SamePlace> same_places_;
  std::vector<GraphFactor> factors_;           ///< by index in the tree
  int pose_ = kStart;                          ///< the last one
  std::vector<int> late_;                      ///< variables that the last frame concerned
  std::vector<int> behind_;                    ///< variables that are not at the tree's solution
  std::size_t renewed_from_ = kMostOfThePast;  ///< from how many variables on all is linearised anew
  bool is_fresh_ = false;  ///< whether what the last step concerned was linearised where it stands
  long refused_ = 0;
};

}  // namespace stereobench::slam
