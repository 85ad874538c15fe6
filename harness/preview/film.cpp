#include "harness/preview/film.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/io/text_file.h"
#include "harness/preview/contact_sheet.h"
#include "harness/process/supervised_process.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kMostWidth_px = 1280;
constexpr std::chrono::seconds kPatience(120);  ///< for a picture, and for the end

/// One word of a shell.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

fs::path make_film_folder() {
  std::string name = (fs::temp_directory_path() / "stereobench_film_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(fmt::format("{}: cannot be created: {}", name, std::strerror(errno)));
  return name;
}

cv::Mat side_by_side(const vision::StereoPair& pair) {
  if (pair.right.empty()) return pair.left;
  cv::Mat both;
  cv::hconcat(pair.left, pair.right, both);
  return both;
}

/// The size of the film: encoders want even numbers.
cv::Size film_size(const cv::Size& pair) {
  const double scale = std::min(1.0, static_cast<double>(kMostWidth_px) / pair.width);
  const auto even = [scale](int px) { return std::max(2, static_cast<int>(px * scale) / 2 * 2); };
  return {even(pair.width), even(pair.height)};
}

/// A picture's bytes, row by row, blue first. @param size of the film
std::string film_frame(const cv::Mat& picture, const cv::Size& size) {
  cv::Mat scaled;
  cv::resize(picture, scaled, size, 0, 0, cv::INTER_AREA);
  return {reinterpret_cast<const char*>(scaled.ptr()), scaled.total() * scaled.elemSize()};
}

[[noreturn]] void report_failure(SupervisedProcess& process, const fs::path& ffmpeg) {
  const std::vector<std::string> errors = process.last_errors(1);
  throw std::runtime_error(fmt::format("{}: made no film{}", ffmpeg.string(),
                                       errors.empty() ? "" : fmt::format(": {}", errors.back())));
}

}  // namespace

fs::path find_ffmpeg() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "ffmpeg";
    if (!folder.empty() && fs::is_regular_file(program) && ::access(program.c_str(), X_OK) == 0)
      return program;
  }
  throw std::runtime_error(
      "--video: no program called ffmpeg is in the folders of PATH; install it (Debian: apt-get install "
      "ffmpeg) "
      "or leave --video out");
}

std::string film_of(const DatasetView& view, const std::vector<std::size_t>& frames, const fs::path& ffmpeg,
                    const std::function<void(double)>& on_progress) {
  const worlds::Encoding encoding = shown_encoding(view.folder);
  const auto picture_of = [&](std::size_t i) {
    return side_by_side(shown_pair(view.frames[frames[i]], encoding));
  };
  const cv::Size size = film_size(picture_of(0).size());
  const fs::path scratch = make_film_folder();
  const fs::path film = scratch / "film.mp4";
  SupervisedProcess process(
      fmt::format(
          "exec {} -hide_banner -loglevel error -y -f rawvideo -pix_fmt bgr24 -s {}x{} -r 10 -i - -an "
          "-pix_fmt yuv420p -movflags +faststart -f mp4 {}",
          quoted(ffmpeg.string()), size.width, size.height, quoted(film.string())),
      scratch);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!process.say(film_frame(picture_of(i), size), Clock::now() + kPatience))
      report_failure(process, ffmpeg);
    on_progress(static_cast<double>(i + 1) / static_cast<double>(frames.size()));
  }
  process.close_input();
  const std::optional<int> status = process.wait_status(Clock::now() + kPatience);
  if (!status || !WIFEXITED(*status) || WEXITSTATUS(*status) != 0 || !fs::exists(film))
    report_failure(process, ffmpeg);
  return read_text(film);
}

}  // namespace stereobench::harness
