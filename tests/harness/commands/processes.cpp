#include "tests/harness/commands/processes.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stereobench::harness {
namespace {

/// State and parent of a process; '-' where there is none.
struct Stat {
  char state = '-';
  pid_t parent = 0;
};

Stat stat_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  Stat stat;
  if (!std::getline(file, line)) return stat;
  const std::size_t name_end = line.rfind(") ");
  stat.state = line[name_end + 2];
  stat.parent = std::atoi(line.c_str() + name_end + 4);
  return stat;
}

}  // namespace

bool is_alive(pid_t process) {
  const char state = stat_of(process).state;
  return state != '-' && state != 'Z' && state != 'X';
}

bool ignores(pid_t process, int signal) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string word; file >> word;)
    if (unsigned long mask = 0; word == "SigIgn:" && file >> std::hex >> mask)
      return ((mask >> (signal - 1)) & 1U) != 0;
  return false;
}

std::vector<pid_t> children_of(pid_t process) {
  std::vector<pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const pid_t pid = std::atoi(entry.path().filename().c_str());
    if (pid > 0 && stat_of(pid).parent == process && is_alive(pid)) children.push_back(pid);
  }
  return children;
}

bool comes_true_in_time(const std::function<bool()>& condition) {
  for (int tries = 0; tries < 24'000; ++tries) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

pid_t start_stereobench(const std::string& command) {
  const std::string whole = fmt::format("exec '{}' {}", STEREOBENCH_PROGRAM, command);
  const pid_t process = ::fork();
  if (process == 0) {
    ::execl("/bin/sh", "sh", "-c", whole.c_str(), nullptr);
    ::_exit(127);
  }
  return process;
}

int exit_code_of(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace stereobench::harness
