/// Detectors that are linked in and chosen by name.
#include "harness/detector/detector_registry.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

TEST(DetectorRegistry, HasOursAndTakesANameOnce) {
  ASSERT_NE(find_detector("stereobench"), nullptr);
  EXPECT_EQ(find_detector("python3 detector.py"), nullptr);
  EXPECT_THAT(
      [] {
        register_detector({"stereobench", our_detector});
      },
      testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("'stereobench' is taken")));
  EXPECT_THAT(
      [] {
        register_detector({"", our_detector});
      },
      testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("no name")));
}

// The program of tests/linked_detector. Mutations: names are started as programs (exit 2); ours whatever the
// name.
TEST(DetectorRegistry, IsChosenByTheCommandLine) {
  const TestFolder folder;
  const auto vision_of = [&](const std::string& detector) {
    const std::string out = (folder.path() / detector).string();
    const std::string command = std::string(STEREOBENCH_LINKED_DETECTOR) + " run " +
                                scenario_path("ball_circle") +
                                " --seeds 0 --set path.laps=0.06 --set gates=[] --quiet --detector " +
                                detector + " --out " + out + " >/dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    const auto run = nlohmann::json::parse(bytes_of(folder.path() / detector / "run.json"));
    EXPECT_EQ(run["detector"], detector);
    return run["vision"];
  };
  const nlohmann::json all = vision_of("stereobench"), some = vision_of("monocular");
  EXPECT_EQ(all["recall"], 1.0);
  EXPECT_LT(some["recall"].get<double>(), 0.95);
  EXPECT_GT(some["recall"].get<double>(), 0.3);
  EXPECT_EQ(some["precision"], 1.0);
}

}  // namespace
}  // namespace stereobench::harness
