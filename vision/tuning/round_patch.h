/// How circles are found around patches of learned colours.
#pragma once

#include <cstddef>

namespace stereobench::vision {

struct RoundPatchTuning {
  /// Least area of a patch, of the smallest circle's: what hides a thing leaves less of it.
  double min_patch = 0.3;
  /// Least area of a patch, of its bounding box: a disc has 0.79, what is seen of a partly hidden one less.
  double min_fill = 0.25;
  /// Largest ratio of the box's sides: half of a disc has 2.
  double max_elongation = 2.5;
  /// Looks along rays, each around the circle of the one before, which is nearer than the patch's.
  int looks = 5;
  /// How far to either side of the circle the first look goes, radii: shade and seams cut a patch short.
  double first_band = 0.4;
  /// The same of the last look: an edge farther from the circle is another thing's.
  double last_band = 0.15;
  /// The same in px, at least: a blurred edge has to fit in.
  double least_band_px = 3.0;
  /// Part of half the band at either end that a ray's two colours are sampled from.
  double end_of_band = 0.35;
  /// Distance of samples along a ray: pixels are interpolated, and half a pixel misses nothing.
  double step_px = 0.5;
  /// Least distance of a ray's two colours, levels: noise and JPEG's blocks make smaller steps.
  double min_contrast_levels = 25.0;
  /// Least scatter of edges about a circle: no thing is known to be rounder.
  double least_spread_px = 0.15;
  /// Residual at which an edge's weight ends, in robust standard deviations: 95 % efficiency for Gaussian
  /// errors (Tukey).
  double tukey = 4.685;
  /// Fewest edges for a circle of three unknowns.
  std::size_t fewest_edges = 8;
  /// Least part of the outline that must be found: as for our own balls.
  double min_arc = 0.2;
  /// Part of the outline that tells a circle: what shows less of it may be none. An oval follows a circle
  /// along half of its way: trusting half, false ones rise from 0.10 to 0.175 a picture.
  double known_arc = 0.65;
  /// Most steps of a circle's fit.
  int steps = 12;
  /// What edges of a round thing may scatter by: noise and JPEG's blocks.
  double rough_px = 0.25;
  /// The same of the radius: real things are not quite round.
  double rough = 0.03;
  /// The same, times as much, of what is reported: between once and this much it is reported and not trusted.
  double roughest = 2.0;
  /// Largest part of rays along which the patch's colour may go on across the circle. What hides a thing
  /// takes of its patch and adds nothing; without this limit trusted false ones rise from 0.10 to 0.15 a
  /// picture.
  double most_beyond = 0.15;
  /// A colour goes on where it is seen so far beyond the circle: outlines are blurred.
  double beyond_px = 1.5;
  /// The same in radii.
  double beyond = 0.12;
  /// Largest area of a patch, of its outline's: edges are blurred.
  double largest_patch = 1.15;
  /// Most patches of a picture that are looked at, the largest ones: bounds the work.
  std::size_t most_patches = 200;
  /// Least area of a piece that is joined to a patch, of the patch's: smaller ones are noise.
  double least_piece = 0.02;
  /// Largest distance of such a piece, of the patch's longer side: a seam is no wider. Without joining 0.959
  /// are found for 0.967.
  double gap = 0.15;
};
inline constexpr RoundPatchTuning kRoundPatch{};

/// How much of a circle is hidden, by rays from its centre.
struct CoverTuning {
  /// Part of the radius to which a thing's colour must be seen along a ray that is not in question.
  double reach = 0.8;
  /// Distance of samples along a ray.
  double step_px = 0.5;
  /// Rays to either side whose steps are summed, of 96 rays: 26 degrees in all.
  int beside = 3;
  /// Radii next to the circle's own that belong to it: outlines are blurred.
  int own = 1;
  /// Radii apart from the circle's, from which on steps are held against its own.
  double first_ring = 2.0;
  /// Least step at the circle, of the root mean square of those at other radii. Without such steps 0.729 of
  /// the balls that are found are trusted, for 0.881: prints, seams and shade end at the circle too.
  double stands_out = 1.5;
  /// Least mean step, levels: JPEG's own steps are smaller.
  double least_step_levels = 6.0;
};
inline constexpr CoverTuning kCover{};

}  // namespace stereobench::vision
