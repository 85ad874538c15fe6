#include "harness/frames/linked_files.h"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "harness/io/text_file.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kCopiesAtATime = 32;  ///< half of AtomicFile::kMostAtATime

}  // namespace

void LinkedFiles::place(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(from, error);
  if (error) throw std::runtime_error(fmt::format("{}: {}", from.string(), error.message()));
  std::filesystem::remove(to);
  std::filesystem::create_hard_link(file, to, error);
  if (!error) return;
  copies_.write(to, read_text(file));
  if (++waiting_ >= kCopiesAtATime) move_into_place();
}

void LinkedFiles::move_into_place() {
  copies_.move_into_place();
  waiting_ = 0;
}

}  // namespace stereobench::harness
