#include "harness/frames/linked_files.h"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace stereobench::harness {
void LinkedFiles::place(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(from, error);
  if (error) throw std::runtime_error(fmt::format("{}: {}", from.string(), error.message()));
  std::filesystem::remove(to);
  std::filesystem::create_hard_link(file, to, error);
  if (!error) return;
  copies_.copy(to, file);
}

void LinkedFiles::move_into_place() {
  copies_.move_into_place();
}

}  // namespace stereobench::harness
