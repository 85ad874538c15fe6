#include "harness/process/supervised_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stereobench::harness {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostWords = 16384;  // of the errors, what is kept

/// A pipe whose ends are closed unless they are taken.
struct Pipe {
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw std::runtime_error(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take(int end) { return std::exchange(ends[end], -1); }
  int ends[2];
};

struct Pipes {
  Pipe input, output, errors, status, lifeline;
};

void close_file(int& file) {
  if (file >= 0) ::close(file);
  file = -1;
}

[[noreturn]] void become(const std::string& command, const Pipes& pipes, const sigset_t& signals) {
  ::setpgid(0, 0);
  ::dup2(pipes.input.ends[0], STDIN_FILENO);
  ::dup2(pipes.output.ends[1], STDOUT_FILENO);
  ::dup2(pipes.errors.ends[1], STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  for (const int signal : {SIGPIPE, SIGCHLD, SIGINT, SIGTERM}) ::signal(signal, SIG_DFL);
  ::sigprocmask(SIG_SETMASK, &signals, nullptr);
  ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  ::_exit(127);
}

/// Sends SIGKILL to each child of this process. @return whether /proc says which there are
bool kill_children() {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const pid_t pid = std::atoi(entry.path().filename().c_str());
    std::ifstream file(entry.path() / "stat");
    std::string stat;
    if (pid <= 0 || !std::getline(file, stat) || stat.rfind(") ") == std::string::npos) continue;
    if (std::atoi(stat.c_str() + stat.rfind(") ") + 4) != ::getpid()) continue;  // "pid (name) S parent ..."
    ::kill(pid, SIGKILL);
  }
  return !error;
}

/// Ends a command and all its descendants. Those that have left its process group become children of the
/// supervisor, a subreaper, once their parents have ended.
/// @return how the command ended, as of waitpid
int end_all(pid_t command) {
  ::kill(-command, SIGKILL);
  int of_command = 0;
  int status = 0;
  for (bool some_left = true; some_left;) {
    const pid_t ended = ::waitpid(-1, &status, WNOHANG);
    if (ended == command) of_command = status;
    some_left = ended > 0 || (ended == 0 && kill_children()) || (ended < 0 && errno == EINTR);
    if (ended == 0) ::poll(nullptr, 0, 1);  // for a millisecond
  }
  return of_command;
}

bool has_ended(pid_t command) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(command), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == command;
}

/// The supervisor's life: it waits for the command's end and tells of it, and for the lifeline's end.
[[noreturn]] void supervise(const std::string& command, const std::filesystem::path& scratch,
                            const Pipes& pipes) {
  ::setsid();  // what ends the run from the keyboard does not end the supervisor
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  for (const int signal : {SIGPIPE, SIGINT, SIGTERM}) ::signal(signal, SIG_IGN);  // the lifeline ends it
  ::signal(SIGCHLD, [](int) {});
  sigset_t child, before;
  ::sigemptyset(&child);
  ::sigaddset(&child, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &child, &before);
  ::sigdelset(&before, SIGCHLD);
  const pid_t pid = ::fork();
  if (pid == 0) become(command, pipes, before);
  if (pid > 0) ::setpgid(pid, pid);
  ::dup2(pipes.lifeline.ends[0], STDIN_FILENO);
  ::dup2(pipes.status.ends[1], STDOUT_FILENO);
  ::close_range(STDERR_FILENO, ~0U, 0);  // nobody shall wait for the end of what it inherited
  bool running = pid > 0;
  for (pollfd lifeline{STDIN_FILENO, POLLIN, 0}; (lifeline.revents & (POLLIN | POLLHUP)) == 0;) {
    if (running && has_ended(pid)) {
      const int status = end_all(pid);
      running = false;
      if (::write(STDOUT_FILENO, &status, sizeof(status)) != sizeof(status)) break;
    }
    ::ppoll(&lifeline, 1, nullptr, &before);  // lets SIGCHLD through while it waits, and only then
  }
  if (running) end_all(pid);
  std::error_code ignored;
  std::filesystem::remove_all(scratch, ignored);
  ::_exit(0);
}

int milliseconds_until(SupervisedProcess::Time until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 3'600'000));
}

/// Waits until one of the files can be read or written; the second one, which may never fall silent, only as
/// long as there is time.
/// @return false when the time is over
bool wait_for(std::array<pollfd, 2>& files, SupervisedProcess::Time until) {
  for (;;) {
    const int ready = ::poll(files.data(), files.size(), milliseconds_until(until));
    const bool in_time = Clock::now() < until;
    if (ready > 0 && (in_time || files[0].revents != 0)) return true;
    if (ready >= 0 && !in_time) return false;
  }
}

/// While it lives, writing to a pipe that nobody reads is an error and not the end.
class IgnoredSigpipe {
 public:
  IgnoredSigpipe() : before_(::signal(SIGPIPE, SIG_IGN)) {}
  ~IgnoredSigpipe() { ::signal(SIGPIPE, before_); }
  IgnoredSigpipe(const IgnoredSigpipe&) = delete;
  IgnoredSigpipe& operator=(const IgnoredSigpipe&) = delete;

 private:
  void (*before_)(int);
};

}  // namespace

SupervisedProcess::SupervisedProcess(const std::string& command, const std::filesystem::path& scratch) {
  Pipes pipes;
  supervisor_ = ::fork();
  if (supervisor_ == 0) supervise(command, scratch, pipes);
  if (supervisor_ < 0) {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove_all(scratch, ignored);
    throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(error)));
  }
  input_ = pipes.input.take(1);
  output_ = pipes.output.take(0);
  errors_ = pipes.errors.take(0);
  status_ = pipes.status.take(0);
  lifeline_ = pipes.lifeline.take(1);
  for (const int file : {input_, output_, errors_}) ::fcntl(file, F_SETFL, O_NONBLOCK);
}

SupervisedProcess::~SupervisedProcess() {
  close_file(lifeline_);
  for (int* file : {&input_, &output_, &errors_, &status_}) close_file(*file);
  while (::waitpid(supervisor_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool SupervisedProcess::say(std::string_view text, Time until) {
  const IgnoredSigpipe guard;
  while (!text.empty()) {
    const ssize_t written = ::write(input_, text.data(), text.size());
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    if (written >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN) return true;
    std::array<pollfd, 2> files = {{{input_, POLLOUT, 0}, {errors_, POLLIN, 0}}};
    if (!wait_for(files, until)) return false;
    if (files[1].revents != 0) read_errors();
  }
  return true;
}

Heard SupervisedProcess::hear(std::string& line, std::size_t most_bytes, Time until) {
  for (std::size_t searched = 0;;) {
    const std::size_t end = heard_.find('\n', searched);
    if (std::min(end, heard_.size()) > most_bytes) return Heard::kTooMuch;
    if (end != std::string::npos) {
      line = heard_.substr(0, end);
      heard_.erase(0, end + 1);
      return Heard::kLine;
    }
    searched = heard_.size();
    std::array<pollfd, 2> files = {{{output_, POLLIN, 0}, {errors_, POLLIN, 0}}};
    if (!wait_for(files, until)) return Heard::kSilence;
    if (files[1].revents != 0) read_errors();
    if (files[0].revents == 0) continue;
    char buffer[65536];
    const ssize_t count = ::read(output_, buffer, sizeof(buffer));
    if (count > 0) heard_.append(buffer, static_cast<std::size_t>(count));
    if (count != 0) continue;
    line = std::exchange(heard_, {});
    return Heard::kEnd;
  }
}

void SupervisedProcess::close_input() {
  close_file(input_);
}

std::optional<int> SupervisedProcess::wait_status(Time until) {
  int status = 0;
  std::array<pollfd, 2> files = {{{status_, POLLIN, 0}, {-1, 0, 0}}};
  if (!wait_for(files, until) || ::read(status_, &status, sizeof(status)) != sizeof(status)) return {};
  return status;
}

void SupervisedProcess::read_errors() {
  char buffer[4096];
  const ssize_t count = ::read(errors_, buffer, sizeof(buffer));
  if (count == 0) close_file(errors_);
  if (count <= 0) return;
  words_.append(buffer, static_cast<std::size_t>(count));
  if (words_.size() > kMostWords) words_.erase(0, words_.size() - kMostWords);
}

std::vector<std::string> SupervisedProcess::last_errors(std::size_t most) {
  // What is in the pipe by now, and not what an endless writer may yet add to it.
  for (int reads = 0; errors_ >= 0 && reads < 64; ++reads) {
    pollfd file{errors_, POLLIN, 0};
    if (::poll(&file, 1, 0) <= 0) break;
    read_errors();
  }
  std::vector<std::string> lines;
  std::istringstream words(words_);
  for (std::string line; std::getline(words, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (!line.empty()) lines.push_back(line);
  }
  if (lines.size() > most) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(most));
  return lines;
}

}  // namespace stereobench::harness
