#include "harness/frames/kept_pair.h"

#include <algorithm>
#include <tuple>

#include <opencv2/imgproc.hpp>

#include "renderer/pictures/jpeg_writer.h"

namespace stereobench::harness {
namespace {

constexpr int kQuality = 80;

std::string jpeg_of(const cv::Mat& picture) {
  cv::Mat small = picture;
  if (picture.cols > kWidestKept_px) {
    const double scale = static_cast<double>(kWidestKept_px) / picture.cols;
    cv::resize(picture, small, {kWidestKept_px, std::max(1, cvRound(scale * picture.rows))}, 0.0, 0.0,
               cv::INTER_AREA);
  }
  const std::vector<std::uint8_t> bytes = renderer::encode_jpeg(small, kQuality);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

PairBadness badness_of(const VisionScore& score) {
  PairBadness badness{.faults = score.visible - score.found + score.misidentified + score.spurious +
                                score.repeated};
  for (const double nis : score.normalised_errors)
    if (nis > badness.worst_nis) badness.worst_nis = nis;  // which NaN is not
  return badness;
}

bool is_worse(const KeptPair& pair, const KeptPair& other) {
  return std::tuple(-pair.badness.faults, -pair.badness.worst_nis, pair.seed, pair.frame) <
         std::tuple(-other.badness.faults, -other.badness.worst_nis, other.seed, other.frame);
}

void keep_pictures(KeptPair& kept, const vision::StereoPair& pair) {
  kept.left_jpeg = jpeg_of(pair.left);
  kept.right_jpeg = jpeg_of(pair.right);
}

void WorstPairs::offer(KeptPair pair, const std::function<void(KeptPair&)>& take_pictures) {
  const auto place = std::ranges::lower_bound(pairs_, pair, is_worse);
  if (pairs_.size() >= most_ && place == pairs_.end()) return;
  if (take_pictures) take_pictures(pair);
  pairs_.insert(place, std::move(pair));
  if (pairs_.size() > most_) pairs_.pop_back();
}

std::vector<KeptPair> within_bytes(const std::vector<KeptPair>& pairs, std::size_t most_bytes) {
  std::vector<KeptPair> within;
  std::size_t bytes = 0;
  for (const KeptPair& pair : pairs) {
    bytes += pair.left_jpeg.size() + pair.right_jpeg.size();
    if (bytes > most_bytes) break;
    within.push_back(pair);
  }
  return within;
}

}  // namespace stereobench::harness
