/// The light source that the balls of a picture share.
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

namespace stereobench::vision {

/// The colours of a ball's light by channel, BGR levels: the rows c0, from all around, and l, the light
/// source's.
using LightColours = Eigen::Matrix<double, 4, 3>;

/// The light on one ball, as its pixels tell it.
struct BallLight {
  LightColours colours = LightColours::Zero();
  /// Of (c0, l) in each channel, in units of one pixel's: the sum of squares of (1, n) over the lit pixels
  /// and of (1, 0) over the others, and next to nothing of a light source that no pixel shows. Zero where
  /// nothing is known.
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  /// Whether the ball shows its light source at all: more than chance makes of a ball that is seen from its
  /// unlit side.
  bool shows_light_source = false;
};

/// What is known of a ball's light before its pixels are looked at: in each channel l is about m c0.
class SharedLightSource {
 public:
  /// @param ratio the column m of each channel
  /// @param information of l - m c0 in each channel, in units of one pixel's; zero where nothing is known
  SharedLightSource(const Eigen::Matrix3d& ratio, const std::array<Eigen::Matrix3d, 3>& information);

  /// Where the light source shines from, times its brightness in all channels over that of all other light.
  Eigen::Vector3d direction() const { return ratio_.rowwise().sum(); }

  /// The colours that suit pixels and light source best.
  /// @param information, products of the pixels: the sums of squares of BallLight and of (1, n) times colours
  LightColours colours(const Eigen::Matrix4d& information, const LightColours& products) const;

 private:
  Eigen::Matrix3d ratio_;
  std::array<Eigen::Matrix4d, 3> information_;  // of (c0, l)
};

/// Gathers what the balls of a picture tell of their light source.
///
/// Paints differ, the light source does not: l / c0 is the same for all matt balls under one distant light
/// source. How well it is the same is read off the balls (random effects, DerSimonian and Laird 1986), so
/// that light sources near by, shadows and gloss make it count for less, down to nothing.
class LightSourcePool {
 public:
  /// @param noise_variance of a pixel's channel, levels^2, > 0
  explicit LightSourcePool(double noise_variance) : noise_variance_(noise_variance) {}

  void add(const BallLight& light) { count(light, 1.0); }

  /// What all the others say of a ball's light source; empty where too few do, and where the ball tells it
  /// well itself.
  /// @param own light of the ball, that was added
  std::optional<SharedLightSource> without(const BallLight& own) const;

 private:
  /// Sums over the balls of one channel, of m with the information I.
  struct Channel {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d information2 = Eigen::Matrix3d::Zero();  // I squared
    Eigen::Vector3d evidence = Eigen::Vector3d::Zero();      // I m
    double squares = 0.0;                                    // m' I m
    double balls = 0.0;
  };

  void count(const BallLight& light, double sign);
  bool tells_light_source(const BallLight& light) const;

  double noise_variance_;
  std::array<Channel, 3> channels_;
};

}  // namespace stereobench::vision
