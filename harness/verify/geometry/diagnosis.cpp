#include "harness/verify/geometry/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "harness/verify/geometry/link_statistics.h"

namespace stereobench::harness {
namespace {

constexpr int kMostCauses = 3;  ///< that are looked for one after another

/// How a residual changes with the amount of a hypothesis, link by link.
struct Slope {
  double at = 0.0;  ///< the residual along the slope, px
  double by = 0.0;  ///< px for one unit of the amount
};

std::vector<Slope> slopes_of(const Claims& claims, const Hypothesis& cause, double amount,
                             const std::vector<Link>& links) {
  Claims here = claims, there = claims;
  cause.undo(here, amount);
  cause.undo(there, amount + cause.first_step);
  std::vector<Slope> slopes;
  for (const Link& link : links) {
    const auto at = residual_px(here, link), then = residual_px(there, link);
    if (!at || !then || at->norm() >= kMostResidual_px) continue;
    const Eigen::Vector2d by = (*then - *at) / cause.first_step;
    const double scale = scale_px(link.kind);
    if (by.norm() > 1e-9) slopes.push_back({at->dot(by.normalized()) / scale, by.norm() / scale});
  }
  return slopes;
}

/// An amount, and how well links know it.
struct Amount {
  double value = 0.0;
  double sd = 0.0;        ///< of errors of links that are each its own
  double moves_px = 0.0;  ///< by how much it moves links, rms
};

/// The amount that leaves the least sum of residuals: each link votes for one, as heavily as it depends on
/// it.
Amount fitted(const Claims& claims, const Hypothesis& cause, const std::vector<Link>& links) {
  constexpr int kRounds = 3;
  Amount amount;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Slope> slopes = slopes_of(claims, cause, amount.value, links);
    if (slopes.empty()) return {};
    std::ranges::sort(slopes, {}, [](const Slope& slope) { return -slope.at / slope.by; });
    double whole = 0.0, squares = 0.0, below = 0.0;
    for (const Slope& slope : slopes) whole += slope.by, squares += slope.by * slope.by;
    double step = 0.0;
    for (const Slope& slope : slopes) {
      below += slope.by;
      step = -slope.at / slope.by;
      if (below >= 0.5 * whole) break;
    }
    amount.value += step;
    std::vector<double> scatter;
    for (const Slope& slope : slopes) scatter.push_back(std::abs(slope.at + step * slope.by));
    constexpr double kSdOfMedian = 1.2533, kSdOfMad = 1.4826;
    amount.sd = kSdOfMedian * kSdOfMad * median(scatter) / std::sqrt(squares);
    amount.moves_px = std::abs(amount.value) * scale_px(links.front().kind) *
                      std::sqrt(squares / static_cast<double>(slopes.size()));
  }
  return amount;
}

/// What is left of the disagreement when a cause is undone.
struct Explanation {
  const Hypothesis* cause = nullptr;
  Amount amount;
  Claims claims;
  int mended = 0;       ///< kinds of links that agree then
  std::string instead;  ///< other causes that explain as much
  double left = 0.0;
};

std::string text_of(const Explanation& explanation) {
  const Hypothesis& cause = *explanation.cause;
  if (!cause.has_amount) return cause.cause;
  const double scale = cause.shown_scale;
  return fmt::format(fmt::runtime(cause.cause),
                     fmt::format("{:.3g} {}", scale * explanation.amount.value, cause.unit));
}

std::string file_of(const DatasetView& view, Suspect suspect) {
  switch (suspect) {
    case Suspect::kCalibration:
      return view.calibration_file;
    case Suspect::kPoses:
      return view.poses_file;
    case Suspect::kDepth:
      return view.depth_file;
    case Suspect::kPicture:
      return view.pictures_file;
  }
  return {};
}

/// Whether a hypothesis says something that the format can be wrong in.
bool applies(const DatasetView& view, const Hypothesis& cause) {
  if (file_of(view, cause.suspect).empty()) return false;
  return cause.poses_of.contains(view.poses_of);
}

/// Whether a kind that was bad is as it should be, or nearly: other causes may be left.
bool is_mended(LinkKind kind, const KindResiduals& before, const KindResiduals& after) {
  constexpr double kNearly = 0.2, kHalf = 0.5;
  const double share = mean(after.length_px) / mean(before.length_px);
  return share < kNearly || (share < kHalf && !is_suspicious(kind, after));
}

/// How many kinds a hypothesis mends.
/// @param all of all links before
/// @return 0 for one that spoils another kind, or says nothing of what files say of each other
int mended_by(const Residuals& all, const ChangedResiduals& change) {
  constexpr std::size_t kFewest = 20;  // corners: some are found wrongly
  int mended = 0;
  for (const auto& [kind, residuals] : all) {
    const auto left = change.after.find(kind);
    if (left == change.after.end() && is_measured(kind)) continue;
    if (left == change.after.end()) return 0;
    const KindResiduals& before = change.before.at(kind);
    if (!is_suspicious(kind, before)) {
      if (is_suspicious(kind, left->second)) return 0;
    } else if (is_mended(kind, before, left->second) &&
               (!is_measured(kind) || before.length_px.size() >= kFewest)) {
      ++mended;
    }
  }
  return mended;
}

/// The first of those that leave about as little as the best one; the others are named with it.
/// @param all at least one
Explanation first_of_best(std::vector<Explanation> all) {
  constexpr double kAboutAsLittle = 1.1, kNoise = 0.02;
  const double least = std::ranges::min_element(all, {}, &Explanation::left)->left;
  std::erase_if(all, [&](const Explanation& one) { return one.left > kAboutAsLittle * least + kNoise; });
  for (std::size_t i = 1; i < all.size(); ++i)
    all.front().instead += fmt::format(", or as likely {}", text_of(all[i]));
  return std::move(all.front());
}

/// The cause that mends the most kinds and leaves the least; of those that leave about as little, the one
/// that is listed first.
std::optional<Explanation> best_explanation(const DatasetView& view, const Claims& claims,
                                            const std::vector<Link>& links, const Residuals& before,
                                            const std::vector<Hypothesis>& causes) {
  std::vector<Explanation> all;
  for (const Hypothesis& cause : causes) {
    if (!applies(view, cause)) continue;
    Explanation one = {.cause = &cause, .amount = {}, .claims = claims};
    if (cause.has_amount) one.amount = fitted(claims, cause, links);
    if (cause.has_amount && std::abs(one.amount.value) < cause.least) continue;
    cause.undo(one.claims, one.amount.value);
    const ChangedResiduals change = compared(claims, one.claims, links);
    one.mended = mended_by(before, change);
    one.left = disagreement(change.after, before);
    if (one.mended > 0) all.push_back(std::move(one));
  }
  if (all.empty()) return std::nullopt;
  const int most = std::ranges::max_element(all, {}, &Explanation::mended)->mended;
  std::erase_if(all, [&](const Explanation& one) { return one.mended < most; });
  return first_of_best(std::move(all));
}

std::string measured(const Residuals& before, const Residuals& after) {
  std::string text;
  for (const auto& [kind, residuals] : before) {
    if (!is_suspicious(kind, residuals) || !after.contains(kind)) continue;
    text += fmt::format("{}{}: {:.3g} px off on average, {:.2g} px without it, over {} points",
                        text.empty() ? "" : "; ", name_of(kind), mean(residuals.length_px),
                        mean(after.at(kind).length_px), residuals.length_px.size());
  }
  return text;
}

/// What files say of each other and no cause explains. Corners that were not found again prove nothing.
void add_unexplained(const DatasetView& view, const Residuals& residuals, std::vector<Fault>& faults) {
  for (const auto& [kind, of_kind] : residuals)
    if (is_bad(kind, of_kind) && !is_measured(kind))
      faults.push_back(
          {view.calibration_file.empty() ? view.poses_file : view.calibration_file, "",
           fmt::format("{}: {:.3g} px off in the middle of {} points; no single cause that is known "
                       "explains it",
                       name_of(kind), median(of_kind.length_px), of_kind.length_px.size())});
}

/// Faults of the whole set. @return the claims without those that were explained
Claims explain(const DatasetView& view, const std::vector<Link>& links, std::vector<Fault>& faults) {
  const std::vector<Hypothesis> causes = known_hypotheses();
  Claims claims = claims_of(view);
  for (int round = 0; round < kMostCauses; ++round) {
    const Residuals before = residuals_of(claims, links);
    const bool is_fine =
        std::ranges::none_of(before, [](const auto& kind) { return is_suspicious(kind.first, kind.second); });
    if (is_fine) break;
    const auto best = best_explanation(view, claims, links, before, causes);
    if (!best) {
      add_unexplained(view, before, faults);
      break;
    }
    faults.push_back({file_of(view, best->cause->suspect), "",
                      fmt::format("{}{} ({})", text_of(*best), best->instead,
                                  measured(before, residuals_of(best->claims, links)))});
    claims = best->claims;
  }
  return claims;
}

/// What corners say of amounts that are too small to be seen in any one of them.
void find_small_amounts(const DatasetView& view, const Claims& claims, const std::vector<Link>& links,
                        Margins& margins, std::vector<Fault>& faults) {
  constexpr double kSure = 8.0, kGain = 0.9, kGainOfCertain = 0.75;
  constexpr std::size_t kLeast = 60;
  // What comes nearer grows, unevenly within the patch that is searched: all of a floor seems to move on.
  constexpr double kCommonError_px = 0.2;
  std::vector<Link> corners;
  for (const Link& link : links) {
    const auto residual = is_measured(link.kind) ? residual_px(claims, link) : std::nullopt;
    if (residual && residual->norm() < kGross_px) corners.push_back(link);
  }
  if (corners.size() < kLeast) return;
  std::vector<Explanation> all;
  const std::vector<Hypothesis> causes = known_hypotheses();
  for (const Hypothesis& cause : causes) {
    if (!applies(view, cause)) continue;
    Explanation one = {.cause = &cause, .amount = {}, .claims = claims};
    if (cause.has_amount) one.amount = fitted(claims, cause, corners);
    const double value = std::abs(one.amount.value);
    // A small amount has to be beyond all three limits: the one that it is nearest to counts.
    const double beyond = std::min(
        {value / cause.least, value / (kSure * one.amount.sd), one.amount.moves_px / kCommonError_px});
    if (cause.has_amount && !margins.is_beyond("amount by corners", beyond, 1.0)) continue;
    cause.undo(one.claims, one.amount.value);
    const ChangedResiduals change = compared(claims, one.claims, corners);
    if (change.before.empty()) continue;
    one.left = disagreement(change.after, {}) / disagreement(change.before, {});
    const double gain = (1.0 - one.left) / (1.0 - (cause.has_amount ? kGain : kGainOfCertain));
    if (margins.is_beyond(cause.has_amount ? "gain of an amount" : "gain of a cause", gain, 1.0))
      all.push_back(std::move(one));
  }
  if (all.empty()) return;
  const Explanation best = first_of_best(std::move(all));
  faults.push_back({file_of(view, best.cause->suspect), "",
                    fmt::format("{}{} (from {} corners of pictures: their mean error shrinks by {:.0f} %)",
                                text_of(best), best.instead, corners.size(), 100.0 * (1.0 - best.left))});
}

std::string file_of(const DatasetView& view, const Link& link) {
  const ViewFrame& frame = view.frames[link.from];
  const auto file = [&](Channel channel) {
    const ChannelFile* found = find_channel(frame, link.from_side, channel);
    return found == nullptr ? std::string() : found->file;
  };
  switch (link.kind) {
    case LinkKind::kDisparityDepth:
    case LinkKind::kRightDepth:
      return file(Channel::kDisparity);
    case LinkKind::kFlow:
      return file(Channel::kFlow);
    case LinkKind::kNextDisparity:
      return file(Channel::kNextDisparity);
    case LinkKind::kBallSurface:
      return file(Channel::kDepth);
    case LinkKind::kBallCentre:
    case LinkKind::kBallPlace:
      return frame.balls[index_of(link.to_side)]->file;
    case LinkKind::kStereoPictures:
    case LinkKind::kEpipolar:
    case LinkKind::kNextPictures:
      return file(Channel::kPicture);
  }
  return {};
}

/// Frames that are off alone: half of a frame's links of a kind.
void find_single_frames(const DatasetView& view, const Claims& claims, const std::vector<Link>& links,
                        Margins& margins, std::vector<Fault>& faults) {
  constexpr std::size_t kFewestExact = 1, kFewestMeasured = 24;
  constexpr double kGrossAlone_px = 3.0;
  std::map<std::tuple<std::size_t, vision::Side, LinkKind>, std::vector<const Link*>> groups;
  for (const Link& link : links) groups[{link.from, link.from_side, link.kind}].push_back(&link);
  const Residuals all = residuals_of(claims, links);
  for (const auto& [key, group] : groups) {
    const LinkKind kind = std::get<LinkKind>(key);
    if (!all.contains(kind) || is_bad(kind, all.at(kind))) continue;
    std::vector<double> px, tolerances;
    for (const Link* link : group)
      if (const auto residual = residual_px(claims, *link)) {
        px.push_back(residual->norm());
        tolerances.push_back(residual->norm() / link->tolerance_px);
      }
    if (px.size() < (is_measured(kind) ? kFewestMeasured : kFewestExact)) continue;
    const double share = is_measured(kind) ? median(px) / kGrossAlone_px : median(tolerances);
    if (!margins.is_beyond(is_measured(kind) ? "corners of a single frame" : "files of a single frame", share,
                           1.0))
      continue;
    faults.push_back({file_of(view, *group.front()), view.frames[std::get<0>(key)].name,
                      fmt::format("{}: {:.3g} px off in the middle of {} points, where other frames agree",
                                  name_of(kind), median(px), px.size())});
  }
}

}  // namespace

std::vector<Fault> diagnose(const DatasetView& view, const std::vector<Link>& links, Margins& margins) {
  std::vector<Fault> faults;
  for (const auto& [kind, residuals] : residuals_of(claims_of(view), links))
    margins.is_beyond(std::string(name_of(kind)), share_of_limit(kind, residuals, kMostLinks), 1.0);
  const Claims claims = explain(view, links, faults);
  find_single_frames(view, claims, links, margins, faults);
  if (faults.empty()) find_small_amounts(view, claims, links, margins, faults);
  return faults;
}

}  // namespace stereobench::harness
