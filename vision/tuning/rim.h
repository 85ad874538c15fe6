/// Which pixels along an outline are collected, and into arcs of which length.
#pragma once

namespace stereobench::vision {

struct RimTuning {
  /// Length of an arc: an edge behind a rim costs the arcs that it touches, the less the shorter they are.
  double arc_length_px = 3.0;
  /// The same in the coarse pass, which only finds out whether a ball is whole; longer arcs lost two of 18
  /// mostly hidden balls.
  double coarse_arc_length_px = 6.0;
  /// Least number of arcs: a third of them are three, as many as an outline has unknowns.
  double fewest_arcs = 9.0;
  /// Most arcs, from 92 px of radius on. With 96 one edge behind a near rim costs eight pixels of it.
  double most_arcs = 192.0;
  /// Distance from an outline at which a pixel in focus shows one thing alone: half its diagonal (0.71 px),
  /// and a fifth of a pixel that the outline may be off.
  double pure_px = 0.9;
  /// How much further a blurred edge reaches, in standard deviations: 2 % of the other colour is left there.
  double blur_reach = 2.0;
  /// Width of the rings beside an outline whose colours stand for ball and background: six pixels
  /// beside an arc.
  double ring_width_px = 2.0;
  /// Width of the outer ring once the shading is known: the background's noise then adds 1 / (4 . 5) of the
  /// edge's own variance; with two pixels it is two and a half times that.
  double wide_ring_px = 5.0;
  /// Distance from the outline of pixels that it may cross in focus, once it is about right: half
  /// its diagonal, and what the outline moves before the picture is looked at again.
  double crossed_px = 1.5;
  /// Radius from which on the coarse pass looks at less: a smaller outline has fewer than ten of its long
  /// arcs.
  double coarse_from_px = 10.0;
  /// Rows are passed over in the coarse pass where they cross the outline steeply: within this part of the
  /// radius above and below the centre, 45 degrees.
  double steep = 0.7;
};
inline constexpr RimTuning kRim{};

}  // namespace stereobench::vision
