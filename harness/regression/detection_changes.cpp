#include "harness/regression/detection_changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/json/json_numbers.h"
#include "harness/page/command_words.h"
#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostFrames = 10;
constexpr std::size_t kMostConfusions = 3;

using Balls = std::vector<const PairedBall*>;

Balls those(const std::vector<PairedBall>& balls, const std::function<bool(const PairedBall&)>& is_one) {
  Balls found;
  for (const PairedBall& ball : balls)
    if (is_one(ball)) found.push_back(&ball);
  return found;
}

bool is_lost(const PairedBall& ball) {
  return ball.truth.is_required && ball.first.is_found && !ball.second.is_found;
}

bool is_misidentified(const PairedBall& ball) {
  return ball.second.wrong_colour.has_value() && !ball.first.wrong_colour.has_value();
}

std::vector<Property> properties_of(const Balls& balls) {
  const auto property = [&](const char* name, const char* unit, auto of, bool is_category = false) {
    Property made{.name = name, .unit = unit, .values = {}, .is_category = is_category};
    for (const PairedBall* ball : balls) made.values.push_back(of(*ball));
    return made;
  };
  const auto category = [&](const char* name, auto of) { return property(name, "", of, true); };
  return {property("range", "m", [](const PairedBall& b) { return b.truth.range_m; }),
          property("bearing", "deg",
                   [](const PairedBall& b) { return slam::kDegreesPerRad * b.truth.bearing_rad; }),
          property("radius", "px", [](const PairedBall& b) { return b.truth.radius_px; }),
          property("visible fraction", "", [](const PairedBall& b) { return b.truth.fraction; }),
          property("distance from the border", "px", [](const PairedBall& b) { return b.truth.border_px; }),
          property("x", "px", [](const PairedBall& b) { return b.truth.left_px.x(); }),
          property("y", "px", [](const PairedBall& b) { return b.truth.left_px.y(); }),
          property("frame", "", [](const PairedBall& b) { return static_cast<double>(b.key.frame); }),
          category("colour", [](const PairedBall& b) { return static_cast<double>(b.truth.colour); }),
          category("ball", [](const PairedBall& b) { return static_cast<double>(b.key.ball); }),
          category("seed", [](const PairedBall& b) { return static_cast<double>(b.key.seed); })};
}

/// What those balls have in common of which something holds; empty where it holds of none.
template <class Holds>
std::optional<Slice> slice_of(const Balls& balls, const Holds& holds) {
  std::vector<bool> marked;
  for (std::size_t i = 0; i < balls.size(); ++i) marked.push_back(holds(i));
  if (std::ranges::count(marked, true) == 0) return {};
  return find_slice(properties_of(balls), marked);
}

double growth_m2(const PairedBall& ball) {
  return ball.second.range_error_m * ball.second.range_error_m -
         ball.first.range_error_m * ball.first.range_error_m;
}

/// @return whether a ball is among the fewest that make up nine tenths of the growth of range errors
std::vector<bool> carriers_of_growth(const Balls& balls) {
  std::vector<std::size_t> order(balls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return growth_m2(*balls[i]); });
  double all_m2 = 0.0;
  for (const PairedBall* ball : balls) all_m2 += growth_m2(*ball);
  std::vector<bool> carries(balls.size(), false);
  double so_far_m2 = 0.0;
  for (const std::size_t i : order) {
    if (so_far_m2 >= 0.9 * all_m2) break;
    so_far_m2 += growth_m2(*balls[i]);
    carries[i] = true;
  }
  return carries;
}

CentreShift shift_of(const Balls& balls, Eigen::Vector2d BallFinding::*error) {
  std::vector<double> x_px, y_px;
  for (const PairedBall* ball : balls) {
    const Eigen::Vector2d shift = ball->second.*error - ball->first.*error;
    x_px.push_back(shift.x());
    y_px.push_back(shift.y());
  }
  return {summarise(x_px), summarise(y_px)};
}

Summary growth_of(const Balls& balls) {
  std::vector<double> shares;
  for (const PairedBall* ball : balls)
    shares.push_back((ball->second.range_error_m - ball->first.range_error_m) / ball->truth.range_m);
  return summarise(shares);
}

std::vector<Confusion> confusions_of(const Balls& misidentified) {
  std::map<std::pair<int, int>, long> counts;
  for (const PairedBall* ball : misidentified) ++counts[{ball->truth.colour, *ball->second.wrong_colour}];
  std::vector<Confusion> confusions;
  for (const auto& [colours, count] : counts) confusions.push_back({colours.first, colours.second, count});
  std::ranges::stable_sort(confusions, std::greater{}, &Confusion::balls);
  return confusions;
}

std::vector<ChangedFrame> changed_frames(const std::vector<PairedBall>& balls) {
  std::map<std::pair<std::uint64_t, int>, ChangedFrame> frames;
  for (const PairedBall& ball : balls) {
    const long changed = is_lost(ball) || is_misidentified(ball) ? 1 : 0;
    const double worse_m2 = ball.first.is_found && ball.second.is_found ? growth_m2(ball) : 0.0;
    if (changed == 0 && worse_m2 <= 0.0) continue;
    ChangedFrame& frame = frames[{ball.key.seed, ball.key.frame}];
    frame.seed = ball.key.seed;
    frame.frame = ball.key.frame;
    frame.balls += changed;
    frame.worse_m2 += worse_m2;
  }
  std::vector<ChangedFrame> worst;
  for (const auto& [key, frame] : frames) worst.push_back(frame);
  std::ranges::stable_sort(worst, [](const ChangedFrame& a, const ChangedFrame& b) {
    return std::tuple(a.balls, a.worse_m2) > std::tuple(b.balls, b.worse_m2);
  });
  worst.resize(std::min(worst.size(), kMostFrames));
  return worst;
}

template <class Right>
PairedCount count(const Balls& balls, const Right& is_right) {
  PairedCount counted{.total = std::ssize(balls)};
  for (const PairedBall* ball : balls) {
    const bool first = is_right(ball->first);
    const bool second = is_right(ball->second);
    counted.worse += first && !second ? 1 : 0;
    counted.better += second && !first ? 1 : 0;
  }
  return counted;
}

/// "58 of 60 at range 4.1 to 6 m, colour 3 (where 140 of 1840 balls are)"
std::string slice_text(const Slice& slice) {
  if (slice.conditions.empty()) return "they have nothing in common that chance does not explain";
  const std::string rivals =
      slice.rivals.empty() ? "" : fmt::format("; said as well by {}", fmt::join(slice.rivals, ", or by "));
  return fmt::format("{} of {} at {} (where {} of {} balls are){}", slice.marked, slice.all_marked,
                     fmt::join(slice.conditions, ", "), slice.things, slice.all_things, rivals);
}

double standard_error_of(const Summary& summary) {
  return summary.sd / std::sqrt(static_cast<double>(summary.count));
}

std::string shift_text(const CentreShift& shift) {
  return fmt::format("({:+.4f} +- {:.4f}, {:+.4f} +- {:.4f}) px", shift.x_px.mean,
                     standard_error_of(shift.x_px), shift.y_px.mean, standard_error_of(shift.y_px));
}

std::string frames_text(const std::vector<ChangedFrame>& frames) {
  std::vector<std::string> texts;
  for (const ChangedFrame& frame : frames)
    texts.push_back(fmt::format("seed {} frame {}", frame.seed, frame.frame));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string confusions_text(const std::vector<Confusion>& confusions) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostConfusions, confusions.size()); ++i)
    text += fmt::format("; colour {} taken for {}: {}", confusions[i].colour, confusions[i].taken_for,
                        confusions[i].balls);
  return text;
}

nlohmann::ordered_json slice_json(const std::optional<Slice>& slice) {
  if (!slice) return nullptr;
  return {{"conditions", slice->conditions}, {"rivals", slice->rivals}, {"marked", slice->marked},
          {"of_marked", slice->all_marked},  {"balls", slice->things},  {"of_balls", slice->all_things}};
}

nlohmann::ordered_json shift_json(const CentreShift& shift) {
  return nlohmann::ordered_json::array({number(shift.x_px.mean), number(shift.y_px.mean)});
}

/// Whether all balls moved alike: their standard deviation is less than half of their mean. Then where range
/// errors grew says where they are sensitive, and no more.
bool is_one_change_of_all(const DetectionChanges& changes) {
  return std::ranges::any_of(std::array{changes.left.x_px, changes.right.x_px, changes.range_growth},
                             [](const Summary& moved) { return moved.sd < 0.5 * std::abs(moved.mean); });
}

/// Whether there are any, and one at least is not zero.
bool has_moved(const Summary& summary) {
  return summary.count > 1 && (summary.mean != 0.0 || summary.sd != 0.0);
}

bool has_moved(const CentreShift& shift) {
  return has_moved(shift.x_px) || has_moved(shift.y_px);
}

}  // namespace

DetectionChanges detection_changes(const PairedBalls& pairs) {
  const std::vector<PairedBall>& balls = pairs.balls;
  const Balls all = those(balls, [](const PairedBall&) { return true; });
  const Balls required = those(balls, [](const PairedBall& b) { return b.truth.is_required; });
  const Balls found = those(balls, [](const PairedBall& b) { return b.first.is_found && b.second.is_found; });
  DetectionChanges changes{.required = std::ssize(required), .unpaired = pairs.unpaired};
  changes.found = count(required, [](const BallFinding& finding) { return finding.is_found; });
  changes.misidentified =
      count(all, [](const BallFinding& finding) { return !finding.wrong_colour.has_value(); });
  changes.found_by_both = std::ssize(found);
  changes.lost_slice = slice_of(required, [&](std::size_t i) { return is_lost(*required[i]); });
  changes.misidentified_slice = slice_of(all, [&](std::size_t i) { return is_misidentified(*all[i]); });
  changes.confusions = confusions_of(those(balls, is_misidentified));
  changes.left = shift_of(found, &BallFinding::left_error_px);
  changes.right = shift_of(found, &BallFinding::right_error_px);
  changes.range_growth = growth_of(found);
  changes.frames = changed_frames(balls);
  if (is_one_change_of_all(changes)) return changes;
  const std::vector<bool> carries = carriers_of_growth(found);
  changes.misplaced_slice = slice_of(found, [&](std::size_t i) { return carries[i]; });
  return changes;
}

PairedCounts counts_of(const DetectionChanges& changes) {
  if (changes.unpaired > 0) return {};
  return {{"vision.recall", {changes.found, true}}, {"vision.misidentified", {changes.misidentified, false}}};
}

std::string changes_text(const DetectionChanges& changes, bool range_errors_grew) {
  std::string text;
  if (changes.unpaired > 0)
    text += fmt::format(
        "balls that had to be found, and are in one result alone: {}; it saw another world, other "
        "frames or another path\n",
        changes.unpaired);
  if (changes.found.worse + changes.found.better > 0)
    text += fmt::format(
        "of {} balls that had to be found, A alone found {} and B alone {} (McNemar's p {:.2g})\n",
        changes.required, changes.found.worse, changes.found.better, mcnemar(changes.found));
  if (changes.lost_slice) text += "  lost: " + slice_text(*changes.lost_slice) + "\n";
  if (changes.misidentified.worse + changes.misidentified.better > 0)
    text += fmt::format("B alone took {} balls for another colour, and A alone {} (McNemar's p {:.2g}){}\n",
                        changes.misidentified.worse, changes.misidentified.better,
                        mcnemar(changes.misidentified), confusions_text(changes.confusions));
  if (changes.misidentified_slice)
    text += "  misidentified: " + slice_text(*changes.misidentified_slice) + "\n";
  if (has_moved(changes.left) || has_moved(changes.right))
    text += fmt::format("centres of the {} balls that both found, B minus A: left {}, right {}\n",
                        changes.found_by_both, shift_text(changes.left), shift_text(changes.right));
  if (has_moved(changes.range_growth))
    text += fmt::format("ranges of these {} balls, B over A: {:+.3f} +- {:.3f} %\n", changes.found_by_both,
                        100.0 * changes.range_growth.mean, 100.0 * standard_error_of(changes.range_growth));
  if (range_errors_grew && changes.misplaced_slice && !changes.misplaced_slice->conditions.empty())
    text +=
        "  nine tenths of the growth of squared range errors: " + slice_text(*changes.misplaced_slice) + "\n";
  if (changes.frames.empty()) return text;
  text += "frames that changed most: " + frames_text(changes.frames) + "\n";
  return text;
}

std::string slices_text(const DetectionChanges& changes) {
  std::vector<std::string> texts;
  if (changes.lost_slice) texts.push_back("lost: " + slice_text(*changes.lost_slice));
  if (changes.misidentified_slice)
    texts.push_back("misidentified: " + slice_text(*changes.misidentified_slice));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string replay_command(const ChangedFrame& frame, const std::string& result) {
  const std::vector<std::string> words = {"stereobench", "replay", result, "--frame",
                                          fmt::format("{}:{}", frame.seed, frame.frame)};
  return shell_line(words);
}

std::string replay_line(const DetectionChanges& changes, const std::string& result) {
  if (changes.frames.empty() || result.empty()) return {};
  return "  look at it: " + replay_command(changes.frames.front(), result) + "\n";
}

nlohmann::ordered_json changes_json(const DetectionChanges& changes) {
  using Json = nlohmann::ordered_json;
  Json confusions = Json::array();
  for (const Confusion& confusion : changes.confusions)
    confusions.push_back(
        {{"colour", confusion.colour}, {"taken_for", confusion.taken_for}, {"balls", confusion.balls}});
  Json frames = Json::array();
  for (const ChangedFrame& frame : changes.frames)
    frames.push_back(
        {{"seed", frame.seed}, {"frame", frame.frame}, {"balls", frame.balls}, {"worse_m2", frame.worse_m2}});
  return {{"required", changes.required},
          {"unpaired", changes.unpaired},
          {"found_by_first_alone", changes.found.worse},
          {"found_by_second_alone", changes.found.better},
          {"misidentified_by_second_alone", changes.misidentified.worse},
          {"misidentified_by_first_alone", changes.misidentified.better},
          {"lost", slice_json(changes.lost_slice)},
          {"misidentified", slice_json(changes.misidentified_slice)},
          {"misplaced", slice_json(changes.misplaced_slice)},
          {"confusions", confusions},
          {"left_shift_px", shift_json(changes.left)},
          {"right_shift_px", shift_json(changes.right)},
          {"range_growth", number(changes.range_growth.mean)},
          {"frames", frames}};
}

}  // namespace stereobench::harness
