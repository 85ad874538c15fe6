/// How an outline is searched, and what it claims.
#pragma once

#include <array>
#include <cstddef>

namespace stereobench::vision {

struct OutlineFitTuning {
  /// Least area of a patch, of its bounding box: a disc has 0.79, what is seen of a partly hidden one may
  /// have less.
  double min_fill = 0.25;
  /// Largest ratio of the box's sides: what is seen of a partly hidden ball is longer than wide.
  double max_elongation = 3.0;
  /// What a patch's box and area lack of a ball's radius on average, since rim pixels have mixed colours.
  double lost_rim_px = 0.15;
  /// Half width of the finest ramp that stands for an edge while the outline is searched.
  double finest_ramp_px = 1.5;
  /// Half width of the first ramp, radii: the guess by a patch of which something hides a part is far off.
  double first_ramp = 0.1;
  /// Largest half width of the next ramp, of this one's: ramps get narrower as the outline comes nearer.
  double ramp_narrows = 0.7;
  /// Half width of the next ramp, of the last step's size: the outline may be off by as much again.
  double ramp_per_step = 2.0;
  /// Steps below this are left to the sharp edge, which finds the rest in one or two.
  double sharpen_below_px = 0.3;
  /// What an outline may be off after the ramps.
  double first_sharp_px = 1.0;
  /// The picture is looked at again around an outline that has moved by more: colours were those beside it.
  double look_again_above_px = 0.3;
  /// How far an outline may move before arcs are compared with it anew: coverage changes linearly along that.
  double straight_px = 0.02;
  /// Most steps of the sharp edge.
  int sharp_steps = 12;
  /// Steps with the shading, at least: the first shows arcs that are hidden, the second goes on without them.
  int shaded_steps = 2;
  /// The same at most: outlines whose arcs turn out to be hidden go on until they stand still. Stopped after
  /// two, range errors of ball_circle were 0.26 mm for 0.20.
  int most_shaded_steps = 8;
  /// Most looks with the shading.
  int shaded_looks = 3;
  /// A step below this ends the search: coverage is linear along it.
  double converged_px = 0.02;
  /// What arcs of one sharp outline may differ by, whatever the noise says: no model is better than that.
  double tolerance_px = 0.02;
  /// Inside of this depth a pixel is wholly the ball's, and counts as hidden where it shows something else.
  double rim_depth_px = 1.2;
  /// What all arcs together are off by: of what a camera and a light source make of a rim. Radii are right to
  /// half a thousandth of a pixel (lab book, biases of the radius).
  double rim_sd_px = 0.0006;
  /// The same of a picture that was interpolated.
  double resampled_rim_sd_px = 0.0025;
  /// What a centre is off by, in common for all arcs.
  double centre_sd_px = 0.0003;
  /// More of that for each px of blur.
  double centre_sd_per_blur = 0.0007;
  /// Outlines below this part of the least radius are not reported: a ball of the least radius is not to be
  /// lost by its own error of measurement.
  double too_small = 0.98;
  /// Larger outlines are none: a fit to no ball's arcs runs away to a straight line.
  double max_radius_px = 1000.0;
  /// Roughness of a patch's edge in noise, by which it may reach beyond its outline; a patch that reaches
  /// further is of a larger ball.
  double roughness_px = 0.75;
  /// Part of an outline's arcs that speak for a whole ball; with less a part may be hidden, and the fit
  /// starts from the boundary too.
  double whole = 0.95;
  /// Of an outline's area, what may be hidden, or outside of the picture, of a ball that passes for whole.
  double most_hidden = 0.06;
};
inline constexpr OutlineFitTuning kOutlineFit{};

/// The circle that most of a patch's boundary lies on.
struct BoundaryTuning {
  /// Points of a boundary that are looked at: bounds the work.
  std::size_t points = 48;
  /// What a boundary of whole pixels is off its outline.
  double on_circle_px = 0.8;
  /// The same of the radius: outlines are ellipses.
  double on_circle = 0.02;
  /// Least part of the boundary that lies on a circle.
  double least_on = 1.0 / 3.0;
  /// Largest radius, of the patch's longer side: a straight cut is no outline.
  double largest_radius = 1.1;
  /// Points between those of a triple: near ones for a short arc, far ones for an exact circle.
  std::array<std::size_t, 5> steps = {3, 5, 7, 10, 14};
};
inline constexpr BoundaryTuning kBoundary{};

/// The blur of a picture, fitted to the edges of all its balls.
struct EdgeProfileTuning {
  /// Where the fit begins: between in focus and badly out of it.
  double first_px = 0.6;
  /// The largest blur: the profile reaches 4.8 px from the outline, little more than 1.5 times that.
  double most_px = 3.0;
  /// Most steps.
  int steps = 12;
  /// Change of the squared blur that ends them: the square of the 0.01 px to which a blur is known.
  double converged_px2 = 1e-4;
};
inline constexpr EdgeProfileTuning kEdgeProfile{};

}  // namespace stereobench::vision
