#include "harness/process/standard_streams.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace stereobench::harness {

void open_standard_streams() {
  // Lowest first: open() takes the lowest number that is free.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void flush_standard_output() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0 && static_cast<bool>(std::cout.flush());
  if (flushed && std::ferror(stdout) == 0) return;
  throw std::runtime_error(fmt::format("standard output: cannot be written: {}",
                                       errno == 0 ? "an earlier write failed" : std::strerror(errno)));
}

void note(const std::string& line) {
  // fmt would throw where standard error cannot be written.
  const std::string whole = "stereobench: " + line + "\n";
  std::fwrite(whole.data(), 1, whole.size(), stderr);
}

void complain(const std::exception& error) {
  const bool is_of_output =
      std::ferror(stdout) != 0 && dynamic_cast<const std::system_error*>(&error) != nullptr;
  note((is_of_output ? "standard output: " : "") + std::string(error.what()));
}

}  // namespace stereobench::harness
