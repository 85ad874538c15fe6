#include "harness/detector/detector_process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/wait.h>

#include "harness/detector/detection_lines.h"
#include "harness/detector/protocol.h"
#include "harness/json/json_line.h"
#include "renderer/pictures/png_picture.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostBytes = 1 << 20;  // of a line
constexpr std::chrono::seconds kDying(2);    // from the end of a program's output to its own
constexpr std::size_t kMostErrorLines = 10;  // of its errors, what is shown: the end of a traceback

fs::path make_scratch_folder() {
  std::string name = (fs::temp_directory_path() / "stereobench_detector_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(fmt::format("{}: cannot be created: {}", name, std::strerror(errno)));
  return name;
}

void write_picture(const fs::path& path, const cv::Mat& picture) {
  // It is read once: packing it well would take longer than all that is done with it.
  const std::vector<std::uint8_t> bytes = renderer::encode_png(picture, renderer::PngPacking::kStored);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  if (!file.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
}

/// A frame's pictures, for as long as they are asked about.
class ShownPictures {
 public:
  ShownPictures(const fs::path& folder, const DetectorInput& input)
      : files_{folder / fmt::format("{:06}_left.png", input.frame),
               folder / fmt::format("{:06}_right.png", input.frame)} {
    write_picture(files_[0], input.pair.left);
    write_picture(files_[1], input.pair.right);
  }
  ~ShownPictures() {
    std::error_code ignored;
    for (const fs::path& file : files_) fs::remove(file, ignored);
  }
  ShownPictures(const ShownPictures&) = delete;
  ShownPictures& operator=(const ShownPictures&) = delete;
  const fs::path& left() const { return files_[0]; }
  const fs::path& right() const { return files_[1]; }

 private:
  std::array<fs::path, 2> files_;
};

std::string describe(int status) {
  return WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                             : fmt::format("exit status {}", WEXITSTATUS(status));
}

/// What a shell ends with when there is no such command, or it is no program.
bool never_started(int status) {
  return WIFEXITED(status) && (WEXITSTATUS(status) == 126 || WEXITSTATUS(status) == 127);
}

}  // namespace

DetectorProcess::DetectorProcess(const DetectorProgram& program, const DetectorSetup& setup,
                                 std::string where)
    : program_(program),
      setup_(setup),
      where_(std::move(where)),
      scratch_(make_scratch_folder()),
      process_(std::make_unique<SupervisedProcess>(program.command, scratch_)) {
  process_->say(setup_line(setup_) + "\n", deadline());
}

double DetectorProcess::patience_s() const {
  return program_.timeout_s + (has_answered_ ? 0.0 : program_.start_s);
}

std::string DetectorProcess::patience() const {
  if (has_answered_) return fmt::format("{:g} s", patience_s());
  return fmt::format("{:g} s, {:g} to start and {:g} for a frame", patience_s(), program_.start_s,
                     program_.timeout_s);
}

SupervisedProcess::Time DetectorProcess::deadline() const {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_s()));
}

std::vector<vision::BallObservation> DetectorProcess::operator()(const DetectorInput& input) {
  const std::string when = fmt::format("frame {}", input.frame);
  const ShownPictures pictures(scratch_, input);
  const SupervisedProcess::Time until = deadline();
  const FrameRequest request = {input.frame, input.stamp_ns, pictures.left(), pictures.right()};
  if (!process_->say(request_line(request) + "\n", until))
    fault(when, fmt::format("expected it to read its input within {}", patience()));
  std::string line;
  const Heard heard = process_->hear(line, kMostBytes, until);
  if (heard != Heard::kLine) fail(when, heard, line);
  try {
    auto balls = read_detections(line, input.frame, {setup_.rig, setup_.ball_radius_m});
    has_answered_ = true;
    return balls;
  } catch (const BadLine& bad) {
    fault(when, bad.what());
  }
}

void DetectorProcess::finish() {
  const std::string when = "after the last frame";
  process_->close_input();
  const SupervisedProcess::Time until = deadline();
  std::string line;
  const Heard heard = process_->hear(line, kMostBytes, until);
  if (heard == Heard::kLine || heard == Heard::kTooMuch || !line.empty())
    fault(when, fmt::format("expected one line a frame and no more (got '{}')", excerpt(line)));
  const auto status = heard == Heard::kEnd ? process_->wait_status(until) : std::nullopt;
  if (!status) fault(when, fmt::format("expected it to end within {} of its input", patience()));
  if (*status != 0) fault(when, fmt::format("expected exit status 0 (it ended with {})", describe(*status)));
}

void DetectorProcess::fail(const std::string& when, Heard heard, const std::string& line) {
  if (heard == Heard::kSilence)
    fault(when, fmt::format("expected a line of detections within {} (none came)", patience()));
  if (heard == Heard::kTooMuch)
    fault(when, fmt::format("expected a line of at most {} bytes (got more)", kMostBytes));
  const auto status = process_->wait_status(Clock::now() + kDying);
  if (status && never_started(*status) && !has_answered_) {
    const std::vector<std::string> errors = process_->last_errors(1);
    throw std::runtime_error(fmt::format("detector '{}': cannot be started: {}", excerpt(program_.command),
                                         errors.empty() ? "" : excerpt(errors.back())));
  }
  const std::string end = status ? "it ended with " + describe(*status) : "it closed its output";
  const std::string part = line.empty() ? "" : fmt::format(" in the middle of '{}'", excerpt(line));
  fault(when, fmt::format("expected a line of detections ({}{})", end, part));
}

void DetectorProcess::fault(const std::string& when, const std::string& what) {
  const std::vector<std::string> errors = process_->last_errors(kMostErrorLines);
  std::string message =
      fmt::format("detector '{}': {}, {}: {}; ", excerpt(program_.command), where_, when, what);
  if (errors.empty()) throw DetectorFault(message + "it wrote no error");
  message += "its last error: " + excerpt(errors.back().substr(errors.back().find_first_not_of(" \t")));
  if (errors.size() > 1)
    for (const std::string& error : errors) message += "\n    " + excerpt(error);
  throw DetectorFault(message);
}

}  // namespace stereobench::harness
