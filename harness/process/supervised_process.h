/// A program of somebody else's beside ours: asked and heard through pipes, and never left behind.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace stereobench::harness {

/// What came of listening to a program.
enum class Heard {
  kLine,     ///< a whole line
  kEnd,      ///< its output has ended; what it wrote since the last line comes with it
  kSilence,  ///< the time is over
  kTooMuch   ///< more than the most bytes, and still no end of the line
};

/// A shell command in a process group of its own, with pipes for its input, output and errors.
///
/// Between this process and the command stands a supervisor. When the command ends, it ends every descendant
/// of the command, those in other process groups and sessions too; when this process ends, however it does,
/// it ends the command as well, and removes the scratch folder.
class SupervisedProcess {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// @param command of /bin/sh
  /// @param scratch an existing folder that is removed together with the process
  /// @throws std::runtime_error when the system has no process or pipe left
  SupervisedProcess(const std::string& command, const std::filesystem::path& scratch);
  /// Ends the command at once.
  ~SupervisedProcess();
  SupervisedProcess(const SupervisedProcess&) = delete;
  SupervisedProcess& operator=(const SupervisedProcess&) = delete;

  /// Writes to its input. One that no longer reads is none of the writer's concern: its output tells.
  /// @return whether it took everything in time, or has ended
  bool say(std::string_view text, Time until);
  /// Listens for a line, and to its errors meanwhile.
  /// @param line what it wrote, without the end of the line
  Heard hear(std::string& line, std::size_t most_bytes, Time until);
  /// Ends its input.
  void close_input();
  /// Waits for the command's end.
  /// @return as of waitpid; empty when the time is over
  std::optional<int> wait_status(Time until);
  /// The last lines that it wrote to its errors so far, blank ones left out, the latest last.
  /// @param most how many
  std::vector<std::string> last_errors(std::size_t most);

 private:
  void read_errors();

  pid_t supervisor_ = -1;
  int input_ = -1;
  int output_ = -1;
  int errors_ = -1;
  int status_ = -1;    ///< the supervisor says here how the command ended
  int lifeline_ = -1;  ///< what the supervisor watches: it closes when this process ends
  std::string heard_;  ///< beyond the last line
  std::string words_;  ///< the end of what it wrote to its errors
};

}  // namespace stereobench::harness
