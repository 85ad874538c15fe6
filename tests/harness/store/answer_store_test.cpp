#include "harness/store/answer_store.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/io/sha256.h"
#include "slam/math/random.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

std::string key_of(int number) {
  return sha256_of(std::to_string(number));
}

/// Bytes of any value, zeros and line ends among them.
std::string answer_of(int number) {
  slam::RandomStream random(static_cast<std::uint64_t>(number), slam::Stream::kWorld);
  std::string answer(static_cast<std::size_t>(3000.0 * random.uniform()), '\0');
  for (char& byte : answer) byte = static_cast<char>(256.0 * random.uniform());
  return answer;
}

void fill(const fs::path& file, int answers) {
  AnswerStore store(file);
  for (int i = 0; i < answers; ++i) store.append(key_of(i), answer_of(i));
}

TEST(Sha256, IsThatOfTheStandard) {  // FIPS 180-4's own examples
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const TestFolder folder;
  folder.write("million", std::string(1'000'000, 'a'));
  EXPECT_EQ(sha256_of_file(folder.path() / "million"),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_THROW(sha256_of_file(folder.path() / "none"), std::runtime_error);
}

TEST(AnswerStore, GivesBackWhatItWasGiven) {
  const TestFolder folder;
  const fs::path file = folder.path() / "store";
  fill(file, 20);
  const AnswerStore store(file);
  EXPECT_EQ(store.size(), 20U);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(store.read(key_of(i)), answer_of(i));
  EXPECT_FALSE(store.holds(key_of(20)));
  EXPECT_THROW(store.read(key_of(20)), std::out_of_range);
}

// Law: whatever its length, a file that was cut holds exactly the answers that are whole, and takes more.
// Mutations: no check that the answer's bytes are all there; the torn end not cut off (what is appended next
// is lost behind it).
TEST(AnswerStore, DropsATornEndAndGoesOn) {
  const TestFolder folder;
  const fs::path whole = folder.path() / "whole", torn = folder.path() / "torn";
  constexpr int kAnswers = 5;
  std::vector<std::uintmax_t> ends = {0};
  for (int i = 0; i < kAnswers; ++i) {
    fill(torn, i + 1);
    ends.push_back(fs::file_size(torn));
    fs::remove(torn);
  }
  fill(whole, kAnswers);
  for (std::uintmax_t size = 0; size <= ends.back(); size += 97) {
    fs::copy_file(whole, torn, fs::copy_options::overwrite_existing);
    fs::resize_file(torn, size);
    const auto left = std::upper_bound(ends.begin(), ends.end(), size) - ends.begin() - 1;
    {
      AnswerStore store(torn);
      EXPECT_EQ(store.size(), static_cast<std::size_t>(left)) << size;
      store.append(key_of(77), "more");
    }
    const AnswerStore again(torn);
    EXPECT_EQ(again.size(), static_cast<std::size_t>(left) + 1) << size;
    EXPECT_EQ(again.read(key_of(77)), "more");
    if (left > 0) {
      EXPECT_EQ(again.read(key_of(static_cast<int>(left) - 1)), answer_of(static_cast<int>(left) - 1));
    }
  }
}

// Mutation: no check of an answer's hash.
TEST(AnswerStore, PassesOverAnAnswerWhoseBytesHaveChanged) {
  const TestFolder folder;
  const fs::path file = folder.path() / "store";
  fill(file, 1);
  const std::uintmax_t first = fs::file_size(file);
  fill(file, 0);
  {
    AnswerStore store(file);
    store.append(key_of(1), answer_of(1));
  }
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(static_cast<std::streamoff>(first) - 1);
  bytes.put('!').flush();
  const AnswerStore store(file);
  EXPECT_FALSE(store.holds(key_of(0)));
  EXPECT_EQ(store.read(key_of(1)), answer_of(1));
}

TEST(AnswerStore, OfAnyBytesHoldsNothingAndTakesAnswers) {
  const TestFolder folder;
  folder.write("store", std::string(1000, 's') + answer_of(3));
  {
    AnswerStore store(folder.path() / "store");
    EXPECT_EQ(store.size(), 0U);
    store.append(key_of(1), "one");
  }
  EXPECT_EQ(AnswerStore(folder.path() / "store").read(key_of(1)), "one");
}

// A child with a limit on file size stands for a full disk. Mutation: what was written of it is left there.
TEST(AnswerStore, AFullDiskIsAnErrorAndLosesNothing) {
  const TestFolder folder;
  const fs::path file = folder.path() / "store";
  fill(file, 3);
  const std::uintmax_t size = fs::file_size(file);
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{size + 1000, size + 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int outcome = 0;
    try {
      AnswerStore(file).append(key_of(9), std::string(100'000, 'x'));
    } catch (const std::runtime_error& error) {
      outcome = std::string(error.what()).find("File too large") == std::string::npos ? 1 : 2;
    }
    ::_exit(outcome);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(fs::file_size(file), size);
  EXPECT_EQ(AnswerStore(file).size(), 3U);
}

// Mutations: no lock; a lock that a child which outlives its parent keeps.
TEST(AnswerStore, IsOpenToOneProcessAlone) {
  const TestFolder folder;
  const fs::path file = folder.path() / "store";
  const AnswerStore store(file);
  const pid_t child = ::fork();
  if (child == 0) {
    int outcome = 0;
    try {
      const AnswerStore second(file);
    } catch (const std::runtime_error& error) {
      outcome = std::string(error.what()).find("another stereobench is writing") == std::string::npos ? 1 : 2;
    }
    ::_exit(outcome);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 2);
}

TEST(AnswerStore, LeavesNoFileWhereThereIsNoAnswer) {
  const TestFolder folder;
  { const AnswerStore store(folder.path() / "store"); }
  EXPECT_FALSE(fs::exists(folder.path() / "store"));
  fill(folder.path() / "store", 2);
  EXPECT_TRUE(fs::exists(folder.path() / "store"));
  AnswerStore(folder.path() / "store").remove();
  EXPECT_FALSE(fs::exists(folder.path() / "store"));
}

}  // namespace
}  // namespace stereobench::harness
