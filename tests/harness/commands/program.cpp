#include "tests/harness/commands/program.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stereobench::harness {
namespace {

void redirect(int file, const std::filesystem::path& path) {
  const int target = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (target < 0 || ::dup2(target, file) < 0) ::_exit(126);
}

}  // namespace

Outcome run_stereobench(const std::vector<std::string>& arguments, Environment environment) {
  const TestFolder scratch;
  std::vector<std::string> words = {STEREOBENCH_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t pid = ::fork();
  if (pid == 0) {
    redirect(STDOUT_FILENO, scratch.path() / "out");
    redirect(STDERR_FILENO, scratch.path() / "err");
    for (std::string& variable : environment) ::putenv(variable.data());
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), bytes_of(scratch.path() / "out"),
          bytes_of(scratch.path() / "err")};
}

std::string scenario_path(const std::string& name) {
  return fmt::format("{}/assets/scenarios/{}.yaml", STEREOBENCH_SOURCE_DIR, name);
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

}  // namespace stereobench::harness
