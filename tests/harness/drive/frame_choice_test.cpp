#include "harness/drive/frame_choice.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

std::vector<std::size_t> frames_of(const FrameChoice& choice, std::size_t steps) {
  std::vector<std::size_t> frames;
  for (std::size_t step = 0; step < steps; ++step)
    if (choice.has(step)) frames.push_back(step);
  return frames;
}

// Mutations: a last frame that is left out; a stride that counts from 0.
TEST(FrameChoice, ReadsFramesAsPeopleWriteThem) {
  EXPECT_THAT(frames_of(parse_frames("7"), 10), ElementsAre(7));
  EXPECT_THAT(frames_of(parse_frames("3..5"), 10), ElementsAre(3, 4, 5));
  EXPECT_THAT(frames_of(parse_frames("1..8:3"), 10), ElementsAre(1, 4, 7));
  EXPECT_THAT(frames_of(FrameChoice(), 3), ElementsAre(0, 1, 2));
}

TEST(FrameChoice, RefusesWhatIsNoRange) {
  for (const char* text : {"", "x", "-1", "5..3", "0..", "..4", "0..4:0", "0..4:", "7:2", "0..4:1:1", "1,2",
                           "0..99999999999999999999", " 3", "0x3"})
    EXPECT_THAT([&] { parse_frames(text); },
                ThrowsMessage<std::runtime_error>(StartsWith("--frames: expected frames such as 7, 0..90")))
        << text;
}

// Law: within a drive the same frames have the same name, which reads as them. Mutation: the last frame as it
// was written.
TEST(FrameChoice, HasOneNameForTheSameFrames) {
  constexpr std::size_t kSteps = 12;
  for (std::size_t first = 0; first < kSteps; ++first)
    for (std::size_t last = first; last < kSteps; ++last)
      for (const std::size_t stride : {1U, 2U, 5U, 20U}) {
        const FrameChoice asked = {first, last, stride};
        const FrameChoice named = frames_of_drive(asked, kSteps);
        EXPECT_EQ(frames_of(named, kSteps), frames_of(asked, kSteps));
        EXPECT_EQ(frames_of(parse_frames(text_of(named)), kSteps), frames_of(asked, kSteps));
        EXPECT_TRUE(named.has(*named.last));
      }
  EXPECT_EQ(text_of(frames_of_drive({0, 9, 4}, kSteps)), text_of(frames_of_drive({0, 8, 4}, kSteps)));
  EXPECT_EQ(text_of(frames_of_drive({}, kSteps)), "0..11");
}

TEST(FrameChoice, RefusesFramesBeyondTheDrive) {
  for (const FrameChoice& beyond : {FrameChoice{.first = 12}, {0, 12, 1}, {12, 12, 1}, {0, 20, 10}})
    EXPECT_THAT([&] { frames_of_drive(beyond, 12); },
                ThrowsMessage<std::runtime_error>(HasSubstr("--frames: the drive has the frames 0 to 11")));
}

}  // namespace
}  // namespace stereobench::harness
