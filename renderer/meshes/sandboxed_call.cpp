#include "renderer/meshes/sandboxed_call.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <new>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stereobench::renderer {
namespace {

using Clock = std::chrono::steady_clock;

// How a child ends: it has answered, it has said what is wrong, it was refused memory.
enum Ending : int { kAnswered = EXIT_SUCCESS, kComplained = 41, kStarved = 42 };

[[noreturn]] void cannot_start() {
  throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errno)));
}

/// The size of this process's address space.
rlim_t address_space_bytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource resource, rlim_t amount) {
  rlimit now{};
  ::getrlimit(resource, &now);
  now.rlim_cur = now.rlim_max = std::min(amount, now.rlim_max);
  ::setrlimit(resource, &now);
}

/// Makes the child die with its parent, say nothing, and get no more memory than it may have.
void confine(const ChildLimits& limits, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  // Counted from what the parent had: under the address sanitizer that alone is terabytes.
  limit(RLIMIT_AS, address_space_bytes() + limits.memory_bytes);
  std::set_new_handler([] { ::_exit(kStarved); });
}

void write_all(int file, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(EXIT_FAILURE);  // the parent is gone
    done += static_cast<std::size_t>(written);
  }
}

/// Nothing may leave this function in the child, or it would go on as a second parent.
[[noreturn]] void serve(const std::function<std::string()>& work, int file) noexcept {
  try {
    write_all(file, work());
  } catch (const std::exception& error) {
    write_all(file, error.what());
    ::_exit(kComplained);
  }
  ::_exit(kAnswered);
}

/// The parent's side: owns the child and the end of the pipe that is read.
class Child {
 public:
  Child(const std::function<std::string()>& work, const ChildLimits& limits) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) cannot_start();
    std::fflush(nullptr);  // or the child could print the parent's buffered text again
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0) {
      ::close(ends[0]);
      confine(limits, parent);
      serve(work, ends[1]);
    }
    ::close(ends[1]);
    pipe_ = ends[0];
    if (pid_ > 0) return;
    ::close(pipe_);
    cannot_start();
  }
  ~Child() {
    if (pid_ > 0) ::kill(pid_, SIGKILL);  // to any other number it would mean many processes
    ::close(pipe_);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Adds what the child has written to `bytes`. @return whether more may come
  bool read(std::string& bytes) {
    char buffer[65536];
    const ssize_t count = ::read(pipe_, buffer, sizeof(buffer));
    if (count > 0) bytes.append(buffer, static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
  }

  /// Waits until there is something to read, or the child has ended.
  /// @return false where it used up its time before
  bool has_news_before(Clock::time_point deadline, std::chrono::duration<double> of_processor) const {
    for (;;) {
      const std::chrono::duration<double> left =
          std::min<std::chrono::duration<double>>(deadline - Clock::now(), of_processor - processor_time());
      if (left.count() <= 0.0) return false;
      pollfd polled = {pipe_, POLLIN, 0};
      const double milliseconds = std::clamp(std::ceil(1e3 * left.count()), 1.0, 1e6);
      if (::poll(&polled, 1, static_cast<int>(milliseconds)) > 0) return true;
    }
  }

  /// @return what the child has used of processors; 0 once it has ended
  std::chrono::duration<double> processor_time() const {
    clockid_t clock{};
    timespec used{};
    if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return {};
    return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
  }

  /// @return how it ended, once it has; it closes its pipe by ending
  int wait() {
    while (pid_ > 0 && ::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status_;
  }

 private:
  pid_t pid_ = -1;
  int pipe_ = -1;
  int status_ = 0;
};

}  // namespace

std::string call_in_child(const std::function<std::string()>& work, const ChildLimits& limits) {
  const std::chrono::duration<double> allowed(limits.seconds);
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(kPatience * allowed);
  Child child(work, limits);
  const auto starved = [&] {
    return std::runtime_error(fmt::format("needs more than {} MiB of memory", limits.memory_bytes >> 20U));
  };
  std::string bytes;
  do {
    if (!child.has_news_before(deadline, allowed))
      throw std::runtime_error(fmt::format("takes longer than {:g} s", limits.seconds));
    if (bytes.size() > limits.memory_bytes) throw starved();
  } while (child.read(bytes));
  const int status = child.wait();
  if (WIFSIGNALED(status)) throw std::runtime_error(fmt::format("crashed (signal {})", WTERMSIG(status)));
  switch (WEXITSTATUS(status)) {
    case kAnswered:
      return bytes;
    case kComplained:
      throw std::runtime_error(bytes);
    case kStarved:
      throw starved();
    default:
      throw std::runtime_error(fmt::format("crashed (exit status {})", WEXITSTATUS(status)));
  }
}

}  // namespace stereobench::renderer
