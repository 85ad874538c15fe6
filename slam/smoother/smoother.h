/// The incremental smoother: the most probable path and map of all that was seen so far, frame by frame.
#pragma once

#include <span>
#include <vector>

#include "slam/association/policy.h"
#include "slam/ekf/ekf_slam.h"
#include "slam/smoother/path_graph.h"

namespace stereobench::slam {

/// Smoothing and mapping (Dellaert and Kaess, IJRR 2006; Kaess et al., iSAM2, IJRR 2012): nothing of the past
/// is linearised for good. Estimates are causal: the pose of a step is the one that the log up to it says.
///
/// A frame is read by an iterated EKF, whose belief is the graph's own, exact to first order at the mode: of
/// the last pose and of the landmarks that the frame may show. So gate, association, contradictions and map
/// management are those of EkfSlam. What it uses of the frame then goes into the graph.
///
/// A landmark that turns out to be elsewhere is a new one for the graph; what was seen of it before stays.
/// Two that turn out to be one are tied to one place.
class Smoother {
 public:
  Smoother(const FilterConfig& config, const Pose& start);

  void predict(const Control& control) { reader_.predict(control); }
  void update(std::span<const RangeBearing> sightings);
  Estimate estimate() const;
  Estimate estimate_without_map() const;
  const UpdateReport& last_update() const { return reader_.last_update(); }
  int particle_count() const { return 1; }
  Decisions last_decisions() const;

 private:
  struct Mapped {
    EkfSlam::Mapped kept;
    int variable = 0;          ///< in the graph
    double variance_m2 = 0.0;  ///< trace of the covariance when it was last looked at; more is known since
  };

  std::vector<std::size_t> may_be_seen(std::span<const Sighting> frame) const;
  void assume(std::span<const std::size_t> near);
  void take_over_map(std::span<const std::size_t> near);
  std::vector<std::size_t> may_be_doubles() const;
  void merge_doubles(std::size_t shown);
  int variable_of(int origin) const;
  int variable_found_by(const Sighting& sighting) const;

  AssociationPolicy policy_;
  PathGraph graph_;
  EkfSlam reader_;  ///< between frames its belief is that of the pose alone
  std::vector<Mapped> map_;
  std::vector<int> landmark_of_slot_;
};

}  // namespace stereobench::slam
