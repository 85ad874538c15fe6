#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/io/picture_file.h"
#include "harness/io/picture_reader.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

std::string file_of(const char* folder, int step, int instant = 10) {
  return fmt::format("{}/{:06}_{}.png", folder, step, instant);
}

/// Changes the levels of a picture of 16 bits.
void change_picture(const PlantedSet& set, const std::string& file,
                    const std::function<void(cv::Mat&)>& change) {
  cv::Mat levels = read_exact_png(set.path(file));
  change(levels);
  set.write(file, encoded(".png", levels));
}

/// A fault in KITTI's scene flow, and what the message says of it.
struct FlowCase {
  const char* name;
  void (*plant)(const PlantedSet&);
  const char* cause;
};

void PrintTo(const FlowCase& planted, std::ostream* out) {
  *out << planted.name;
}

void swap_second_pair(const PlantedSet& set) {
  const std::string left = file_of("image_2", 4, 11), right = file_of("image_3", 4, 11),
                    kept = set.text(left);
  set.write(left, set.text(right));
  set.write(right, kept);
}
void repeat_first_pair(const PlantedSet& set) {
  for (const char* folder : {"image_2", "image_3"})
    set.write(file_of(folder, 4, 11), set.text(file_of(folder, 4)));
}
void take_flow_of_another(const PlantedSet& set) {
  set.write(file_of("flow_occ", 5), set.text(file_of("flow_occ", 2)));
}
/// The flow's rows count upward.
void turn_flow_up(const PlantedSet& set) {
  change_picture(set, file_of("flow_occ", 4), [](cv::Mat& levels) {
    for (int v = 0; v < levels.rows; ++v)
      for (int u = 0; u < levels.cols; ++u) {
        auto& down = levels.at<cv::Vec3w>(v, u)[1];
        down = static_cast<std::uint16_t>(65536 - down);
      }
  });
}
void repeat_first_disparity(const PlantedSet& set) {
  set.write(file_of("disp_occ_1", 4), set.text(file_of("disp_occ_0", 4)));
}
/// One pixel's disparity of those that the right picture shows.
void change_a_part(const PlantedSet& set) {
  change_picture(set, file_of("disp_noc_0", 4), [](cv::Mat& levels) {
    std::vector<cv::Point> valid;
    cv::findNonZero(levels, valid);
    levels.at<std::uint16_t>(valid.at(valid.size() / 2)) += 1;
  });
}
/// Flow that the next picture shows, and that all of it has not.
void forget_whole_flow(const PlantedSet& set) {
  change_picture(set, file_of("flow_occ", 4),
                 [](cv::Mat& levels) { levels(cv::Rect(100, 180, 20, 20)).setTo(0); });
}

class SecondPair : public testing::TestWithParam<FlowCase> {};

// Law: flow, both disparities and both pairs are of one motion.
TEST_P(SecondPair, IsOfTheSameMotion) {
  const PlantedSet set("kitti-scene-flow");
  GetParam().plant(set);
  EXPECT_THAT(set.faults(), HasSubstr(GetParam().cause));
}

constexpr FlowCase kFlowCases[] = {
    {"swapped", swap_second_pair, "image_2/000004_11.png: frame 000004: corners of the first picture are"},
    {"right_one_swapped", swap_second_pair,
     "image_3/000004_11.png: frame 000004: corners of the first picture are"},
    {"repeated", repeat_first_pair, "image_2/000004_11.png: frame 000004: corners of the first picture are"},
    {"flow_of_another", take_flow_of_another,
     "flow_occ/000005_10.png: frame 000005: flow and both disparities"},
    {"flow_up", turn_flow_up, "flow_occ/000004_10.png: frame 000004: flow and both disparities"},
    {"disparity_of_now", repeat_first_disparity,
     "flow_occ/000004_10.png: frame 000004: flow and both disparities"},
    {"part", change_a_part, "disp_noc_0/000004_10.png: frame 000004: 1 values are not those of disp_occ_0"},
    {"part_of_nothing", forget_whole_flow, "flow_noc/000004_10.png: frame 000004: "},
};

INSTANTIATE_TEST_SUITE_P(Faults, SecondPair, testing::ValuesIn(kFlowCases),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace stereobench::harness
