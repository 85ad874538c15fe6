#include "harness/io/atomic_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace stereobench::harness {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
  throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), what, std::strerror(error)));
}

/// The name of a temporary file, for a signal's handler.
struct UnfinishedFile {
  std::array<char, PATH_MAX> name = {};
  std::atomic<bool> is_there = false;
};
static_assert(std::atomic<bool>::is_always_lock_free);

std::array<UnfinishedFile, AtomicFile::kMostAtATime> unfinished;
std::array<bool, AtomicFile::kMostAtATime> is_taken = {};

/// @return a place among the unfinished files that nobody has
std::size_t take_place(const fs::path& path) {
  const auto* const free = std::ranges::find(is_taken, false);
  if (free == is_taken.end())
    throw std::logic_error(fmt::format("{}: too many files are being written", path.string()));
  const auto place = static_cast<std::size_t>(free - is_taken.begin());
  is_taken[place] = true;
  return place;
}

/// Tells a signal's handler what to remove.
void announce(UnfinishedFile& file, const std::string& name) {
  file.is_there = false;
  if (name.size() >= file.name.size()) return;
  std::copy_n(name.c_str(), name.size() + 1, file.name.begin());
  file.is_there = true;
}

void give_back(std::size_t place) {
  unfinished[place].is_there = false;
  is_taken[place] = false;
}

/// Makes a rename in a folder survive a power cut. File systems that cannot do so are let be.
void sync_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

/// Whether a process is gone, or dead and not yet buried by its parent.
bool has_ended(int process) {
  if (kill(process, 0) != 0) return errno == ESRCH;
  std::ifstream status(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(status, line);
  const std::size_t name_end = line.rfind(") ");
  return name_end != std::string::npos && line.find_first_of("ZX", name_end + 2) == name_end + 2;
}

/// Whether a name is one that AtomicFile gives, and its process is gone.
bool is_leftover(const std::string& name) {
  static const std::regex temporary(R"(.*\.([0-9]{1,9})-[0-9]+\.tmp)");
  std::smatch parts;
  if (!std::regex_match(name, parts, temporary)) return false;
  return has_ended(std::stoi(parts[1]));
}

}  // namespace

void remove_unfinished_files() noexcept {
  for (const UnfinishedFile& file : unfinished)
    if (file.is_there) unlink(file.name.data());
}

void remove_leftovers_in(const fs::path& folder) {
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_leftover(entry.path().filename().string()))
      leftovers.push_back(entry.path());
  for (const fs::path& leftover : leftovers) fs::remove(leftover);
}

void remove_leftovers(const fs::path& folder) {
  remove_leftovers_in(folder);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_directory()) remove_leftovers_in(entry.path());
}

void prepare_output_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw std::runtime_error(
        fmt::format("{}: is a file, not a folder that results can be written to", folder.string()));
  }
  fs::create_directories(folder, error);
  if (error) fail(folder, "cannot be created", error.value());
  if (access(folder.c_str(), W_OK | X_OK) != 0) fail(folder, "cannot be written to", errno);
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  if (fs::is_directory(path_)) fail(path_, "cannot be replaced", EISDIR);
  place_ = take_place(path_);
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    name_ = fmt::format("{}.{}-{}.tmp", path_.string(), getpid(), attempt);
    announce(unfinished[place_], name_);  // before it is there: a signal may come right after
    descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0 || errno == EEXIST) continue;
    const int error = errno;
    give_back(place_);
    fail(path_, "cannot be written", error);
  }
}

AtomicFile::~AtomicFile() {
  if (is_moved_) return;
  if (descriptor_ >= 0) close(descriptor_);
  unlink(name_.c_str());
  give_back(place_);
}

void AtomicFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_, "cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::overwrite(std::uint64_t at, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_, "cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
}

void AtomicFile::rename_into_place() {
  if (close(std::exchange(descriptor_, -1)) != 0) fail(path_, "cannot be written", errno);
  if (std::rename(name_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be replaced", errno);
  give_back(place_);
  is_moved_ = true;
}

void AtomicFile::move_into_place() {
  if (fsync(descriptor_) != 0) fail(path_, "cannot be written", errno);
  rename_into_place();
  sync_folder(path_.has_parent_path() ? path_.parent_path() : fs::path("."));
}

AtomicFile& AtomicFiles::begin(const fs::path& path) {
  constexpr std::size_t kMostTogether = AtomicFile::kMostAtATime / 2;
  if (files_.size() == kMostTogether) move_into_place();
  return *files_.emplace_back(std::make_unique<AtomicFile>(path));
}

void AtomicFiles::write(const fs::path& path, std::string_view bytes) {
  begin(path).append(bytes);
}

void AtomicFiles::copy(const fs::path& path, const fs::path& from) {
  constexpr std::size_t kBlock = 1 << 20;
  AtomicFile& file = begin(path);
  std::ifstream stream(from, std::ios::binary);
  std::string block(kBlock, '\0');
  while (stream.read(block.data(), kBlock) || stream.gcount() > 0)
    file.append(std::string_view(block).substr(0, static_cast<std::size_t>(stream.gcount())));
  if (!stream.eof()) throw std::runtime_error(fmt::format("{}: cannot be read", from.string()));
}

void AtomicFiles::move_into_place() {
  if (!files_.empty() && syncfs(files_.front()->descriptor_) != 0)
    fail(files_.front()->path_, "cannot be written", errno);
  for (const auto& file : files_) file->rename_into_place();
  files_.clear();
}

void sync_file_system(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail(folder, "cannot be opened", errno);
  const bool is_synced = syncfs(descriptor) == 0;
  const int error = errno;
  close(descriptor);
  if (!is_synced) fail(folder, "cannot be written", error);
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.append(bytes);
  file.move_into_place();
}

}  // namespace stereobench::harness
