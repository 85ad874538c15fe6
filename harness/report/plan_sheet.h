/// The sheet that a floor plan is drawn on: metres to pixels, axes, a grid, and SVG.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace stereobench::harness {

/// An SVG document with a plan of part of the floor (x to the right, y up) and lines of text below it.
class PlanSheet {
 public:
  /// @param extent_m the part of the floor that is shown
  explicit PlanSheet(const Eigen::AlignedBox2d& extent_m);

  /// @return a length on the floor in pixels
  double to_px(double length_m) const { return scale_ * length_m; }

  void line(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, std::string_view style);
  void disc(const Eigen::Vector2d& at_m, double radius_px, std::string_view style);
  void polygon(std::span<const Eigen::Vector2d> corners_m, std::string_view style);
  /// A few words beside a place. @param shift_px right and down
  void label(const Eigen::Vector2d& at_m, const Eigen::Vector2d& shift_px, std::string_view words,
             std::string_view style);
  /// Text below the plan. @param row from 0 on
  void text(double x_px, int row, std::string_view words, std::string_view style = "");
  /// A frame, grid lines at round distances, and their coordinates in metres along the lower and left edges.
  void axes();

  std::string document() const;

 private:
  double x(const Eigen::Vector2d& at_m) const;
  double y(const Eigen::Vector2d& at_m) const;
  double bottom_px() const;
  double grid_m() const;
  std::string point(const Eigen::Vector2d& at_m) const;
  void grid_line(int axis, double at_m, int decimals);

  Eigen::AlignedBox2d extent_;
  double scale_;
  std::string body_;
};

}  // namespace stereobench::harness
