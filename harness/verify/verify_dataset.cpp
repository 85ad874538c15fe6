#include "harness/verify/verify_dataset.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "harness/verify/checks/checks.h"
#include "harness/verify/geometry/diagnosis.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// Points and corners of a whole data set; those of a frame are fewer the more frames there are.
constexpr std::size_t kMostPoints = 40'000, kMostCorners = 6'000;

void append(std::vector<Fault>& all, std::vector<Fault> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// A channel's picture; what cannot be read is a fault.
cv::Mat load(const DatasetView& view, const ViewFrame& frame, Side side, Channel channel,
             std::vector<Fault>& faults) {
  const ChannelFile* file = find_channel(frame, side, channel);
  if (file == nullptr) return {};
  try {
    return file->read();
  } catch (const std::runtime_error& error) {
    std::string what = error.what();
    const std::string path = (view.folder / file->file).string() + ": ";
    if (what.starts_with(path)) what.erase(0, path.size());
    faults.push_back({file->file, frame.name, what});
    return {};
  }
}

std::unique_ptr<LoadedFrame> load(const DatasetView& view, std::size_t index, Margins& margins,
                                  std::vector<Fault>& faults) {
  auto loaded = std::make_unique<LoadedFrame>();
  loaded->index = index;
  const ViewFrame& frame = view.frames[index];
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const std::size_t i = index_of(side);
    loaded->picture[i] = load(view, frame, side, Channel::kPicture, faults);
    loaded->disparity_px[i] = load(view, frame, side, Channel::kDisparity, faults);
    loaded->depth_m[i] = load(view, frame, side, Channel::kDepth, faults);
    loaded->flow_px[i] = load(view, frame, side, Channel::kFlow, faults);
    loaded->ball_id[i] = load(view, frame, side, Channel::kBallId, faults);
    loaded->next_picture[i] = load(view, frame, side, Channel::kNextPicture, faults);
    const cv::Mat range_m = load(view, frame, side, Channel::kRange, faults);
    if (!range_m.empty()) append(faults, check_range(view, *loaded, range_m, side, margins));
  }
  loaded->next_disparity_px = load(view, frame, Side::kLeft, Channel::kNextDisparity, faults);
  append(faults, check_pictures(view, *loaded));
  append(faults, check_boxes(view, *loaded, margins));
  append(faults, check_outlines(view, frame, margins));
  append(faults, check_parts(view, *loaded));
  append(faults, check_next_instant(view, *loaded, margins));
  return loaded;
}

/// Reads all frames once, three at a time. @return the links of all
std::vector<Link> walk(const DatasetView& view, Margins& margins, std::vector<Fault>& faults,
                       const std::function<void(double)>& on_progress) {
  const std::size_t count = view.frames.size();
  const std::size_t points = std::clamp<std::size_t>(kMostPoints / std::max<std::size_t>(1, count), 8, 200);
  const std::size_t corners = std::clamp<std::size_t>(kMostCorners / std::max<std::size_t>(1, count), 6, 120);
  std::vector<Link> links;
  std::unique_ptr<LoadedFrame> before, now, after;
  if (count > 0) now = load(view, 0, margins, faults);
  for (std::size_t i = 0; i < count; ++i) {
    on_progress(static_cast<double>(i) / static_cast<double>(count));
    after = i + 1 < count ? load(view, i + 1, margins, faults) : nullptr;
    const Neighbourhood frames = {before.get(), now.get(), after.get()};
    if (view.has_calibration) {
      add_file_links(view, frames, points, links);
      add_picture_links(view, frames, corners, links);
    }
    before = std::move(now);
    now = std::move(after);
  }
  return links;
}

std::vector<std::string> counts_of(const std::vector<Link>& links) {
  std::map<LinkKind, std::size_t> counts;
  for (const Link& link : links) ++counts[link.kind];
  std::vector<std::string> lines;
  for (const auto& [kind, count] : counts)
    lines.push_back(fmt::format("{} ({} points)", name_of(kind), count));
  return lines;
}

}  // namespace

void leave_out_repeated(std::vector<Fault>& faults) {
  std::set<std::tuple<std::string, std::string, std::string>> known;
  std::erase_if(
      faults, [&](const Fault& fault) { return !known.emplace(fault.file, fault.frame, fault.what).second; });
}

Verification verify_dataset(const std::filesystem::path& folder, const DatasetReader& reader,
                            const std::function<void(double)>& on_progress) {
  DatasetView view = reader.read(folder);
  if (view.frames.empty() && view.faults.empty())
    throw std::runtime_error(fmt::format("{}: expected a data set of the format {} (it has no frames)",
                                         folder.string(), reader.format));
  Verification result = {
      .format = view.format, .faults = {}, .checked = {}, .cannot = view.cannot, .margins = view.margins};
  ChecksumResult checksums = check_checksums(folder);
  append(result.faults, std::move(checksums.faults));
  append(result.faults, view.faults);
  append(result.faults, check_stamps(view));
  append(result.faults, check_poses(view, result.margins));
  const std::vector<Link> links = walk(view, result.margins, result.faults, on_progress);
  append(result.faults, diagnose(view, links, result.margins));
  leave_out_repeated(result.faults);
  result.checked.push_back(fmt::format("{} frames", view.frames.size()));
  if (checksums.files > 0) result.checked.push_back(fmt::format("{} files by SHA-256", checksums.files));
  if (!view.poses.empty()) result.checked.push_back(fmt::format("{} poses", view.poses.size()));
  for (const auto& lines : {view.checked, counts_of(links)})
    result.checked.insert(result.checked.end(), lines.begin(), lines.end());
  result.cannot.insert(result.cannot.end(), checksums.cannot.begin(), checksums.cannot.end());
  return result;
}

std::string line_of(const Fault& fault) {
  constexpr std::size_t kMost = 1000;  // letters of each: names may be of files that anybody made up
  std::string line = worlds::excerpt(fault.file, kMost);
  if (!fault.frame.empty())
    line += fmt::format("{}frame {}", line.empty() ? "" : ": ", worlds::excerpt(fault.frame, kMost));
  return fmt::format("{}{}{}", line, line.empty() ? "" : ": ", worlds::excerpt(fault.what, kMost));
}

}  // namespace stereobench::harness
