#include "harness/io/atomic_file.h"

#include <filesystem>
#include <set>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

long files_in(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(AtomicFile, WritesEveryByteAndLeavesNothingElse) {
  const TestFolder folder;
  const std::string bytes("a\0b\n\xff", 5);
  write_file_atomically(folder.path() / "file", bytes);
  EXPECT_EQ(folder.read("file"), bytes);
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(AtomicFile, ReplacesAnOldFileAndHonoursTheCreationMask) {
  const TestFolder folder;
  folder.write("file", "a much longer old content");
  const mode_t mask = umask(027);
  write_file_atomically(folder.path() / "file", "new");
  umask(mask);
  struct stat status {};
  ASSERT_EQ(stat((folder.path() / "file").c_str(), &status), 0);
  EXPECT_EQ(folder.read("file"), "new");
  EXPECT_EQ(status.st_mode & 0777, 0640U);
}

// Meant to catch: appended in place of replaced; the last block left out; blocks one after the other in one
// place.
TEST(AtomicFiles, CopiesALargeFileBlockByBlock) {
  const TestFolder folder;
  std::string bytes((std::size_t{5} << 19) + 3, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 251);
  folder.write("from", bytes);
  AtomicFiles files;
  files.copy(folder.path() / "to", folder.path() / "from");
  EXPECT_FALSE(fs::exists(folder.path() / "to"));
  files.move_into_place();
  EXPECT_TRUE(folder.read("to") == bytes);
  EXPECT_THAT([&] { files.copy(folder.path() / "to", folder.path() / "nowhere"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("nowhere: cannot be read")));
}

// Mutation: writing to the final name directly. The reader that holds the old file would see it change.
TEST(AtomicFile, AReaderOfTheOldFileKeepsIt) {
  const TestFolder folder;
  folder.write("file", "old");
  std::ifstream reader(folder.path() / "file");
  write_file_atomically(folder.path() / "file", "new and longer");
  std::string seen;
  reader >> seen;
  EXPECT_EQ(seen, "old");
}

// Mutation: a place that is not given back: there are none left after kMostAtATime files.
TEST(AtomicFile, MayBeOneOfAFew) {
  const TestFolder folder;
  for (int i = 0; i < 40; ++i) {
    AtomicFile one(folder.path() / "one"), other(folder.path() / "other");
    write_file_atomically(folder.path() / "third", "c");
    one.append("a");
    other.append("b");
    if (i % 2 == 0) one.move_into_place();
    other.move_into_place();
  }
  EXPECT_EQ(folder.read("one") + folder.read("other") + folder.read("third"), "abc");
  EXPECT_EQ(files_in(folder.path()), 3);
}

TEST(AtomicFile, PassesOverWhatAKilledRunLeft) {
  const TestFolder folder;
  folder.write("file." + std::to_string(getpid()) + "-0.tmp", "left behind");
  write_file_atomically(folder.path() / "file", "new");
  EXPECT_EQ(folder.read("file"), "new");
  EXPECT_EQ(files_in(folder.path()), 2);
}

TEST(AtomicFile, NamesPathAndCause) {
  const TestFolder folder;
  fs::create_directory(folder.path() / "sub");
  const auto write = [&](const char* name) { write_file_atomically(folder.path() / name, "x"); };
  EXPECT_THAT([&] { write("missing/file"); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("missing/file"), HasSubstr("No such file"))));
  EXPECT_THAT([&] { write("sub"); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("sub"), HasSubstr("Is a directory"))));
  EXPECT_EQ(files_in(folder.path()), 1);
}

// A child with a limit on file size stands for a full disk: the write fails half way.
// Mutation: leaving out the removal of the temporary file, or replacing the old file before the write is
// done.
TEST(AtomicFile, AFullDiskLeavesTheOldFileAndNoPart) {
  const TestFolder folder;
  folder.write("file", "old");
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{1000, 1000};
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_file_atomically(folder.path() / "file", std::string(100'000, 'x'));
    } catch (const std::runtime_error& error) {
      _exit(std::string(error.what()).find("File too large") == std::string::npos ? 1 : 2);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(folder.read("file"), "old");
  EXPECT_EQ(files_in(folder.path()), 1);
}

// Mutations: each moved when it is written; what is not moved left behind.
TEST(AtomicFiles, AreThereTogetherOrNotAtAll) {
  const TestFolder folder;
  const auto names_in = [&] {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      names.insert(entry.path().filename());
    return names;
  };
  {
    AtomicFiles files;
    for (const char* name : {"a", "b", "c"}) files.write(folder.path() / name, name);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a"));
    EXPECT_EQ(names_in().size(), 3U);
    files.move_into_place();
    EXPECT_EQ(names_in(), (std::set<std::string>{"a", "b", "c"}));
    EXPECT_EQ(folder.read("b"), "b");
    EXPECT_NO_THROW(sync_file_system(folder.path()));
    files.write(folder.path() / "d", "d");
    EXPECT_THROW(files.write(folder.path() / "nowhere" / "e", "e"), std::runtime_error);
  }
  EXPECT_EQ(names_in(), (std::set<std::string>{"a", "b", "c"}));
  EXPECT_THROW(sync_file_system(folder.path() / "nowhere"), std::runtime_error);
}

TEST(OutputFolder, IsCreatedWithItsParentsAndMayExist) {
  const TestFolder folder;
  prepare_output_folder(folder.path() / "a/b");
  prepare_output_folder(folder.path() / "a/b");
  EXPECT_TRUE(fs::is_directory(folder.path() / "a/b"));
}

TEST(OutputFolder, NamesWhatIsWrong) {
  const TestFolder folder;
  folder.write("file", "x");
  EXPECT_THAT([&] { prepare_output_folder(folder.path() / "file"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("file: is a file, not a folder")));
  EXPECT_THAT([&] { prepare_output_folder(folder.path() / "file/below"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("Not a directory")));
  EXPECT_THAT([] { prepare_output_folder("/proc/stereobench"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/proc/stereobench: cannot be created")));
  EXPECT_THAT([] { prepare_output_folder("/dev/null"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/dev/null: is a file, not a folder")));
  EXPECT_THROW(prepare_output_folder(""), std::runtime_error);
}

// A picture of many balls has a mask for each. Mutation: without a move in between, there are too many files.
TEST(AtomicFiles, MayBeMany) {
  const TestFolder folder;
  AtomicFiles files;
  for (int i = 0; i < 200; ++i) files.write(folder.path() / std::to_string(i), "mask " + std::to_string(i));
  files.move_into_place();
  for (int i = 0; i < 200; ++i) EXPECT_EQ(folder.read(std::to_string(i)), "mask " + std::to_string(i));
}

}  // namespace
}  // namespace stereobench::harness
