#include "harness/dataset/rendered_dataset.h"

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "harness/io/calibration_file.h"
#include "slam/math/random.h"
#include "tests/test_folder.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const vision::StereoRig kRig{{320, 240, 300.0, 150.0, 125.0}, 0.12, 0.5, 0.3};

cv::Mat matrix_of(const vision::StereoRig& rig, const std::string& key) {
  const cv::FileStorage file(calibration_yaml(rig), cv::FileStorage::READ | cv::FileStorage::MEMORY);
  return file[key].mat();
}

Eigen::Vector2d projected(const cv::Mat& projection, const Eigen::Vector3d& point) {
  const cv::Mat pixel = projection * cv::Mat(cv::Vec4d(point.x(), point.y(), point.z(), 1.0));
  return Eigen::Vector2d(pixel.at<double>(0), pixel.at<double>(1)) / pixel.at<double>(2);
}

// Property: P1 and P2 take points of the left camera's frame to the pixels at which the rig's cameras have
// them. Mutations: P2[3] = +f B, a P2 that knows of no turn.
class Calibration : public testing::TestWithParam<double> {};

TEST_P(Calibration, ProjectsWhereTheCamerasOfTheRigDo) {
  vision::StereoRig rig = kRig;
  rig.right_turn_rad = GetParam() * Eigen::Vector3d(0.01, -0.02, 0.03);
  const cv::Mat p1 = matrix_of(rig, "P1");
  const cv::Mat p2 = matrix_of(rig, "P2");
  slam::RandomStream random(4, slam::Stream::kWorld);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d point(random.normal(), random.normal(), 1.0 + 4.0 * random.uniform());
    const Eigen::Vector2d left = vision::project(rig.intrinsics, point);
    const Eigen::Vector2d right =
        vision::project(rig.intrinsics, vision::camera_point(rig, point, vision::Side::kRight));
    EXPECT_LT((projected(p1, point) - left).norm(), 1e-9);
    EXPECT_LT((projected(p2, point) - right).norm(), 1e-9);
  }
  EXPECT_LT(p2.at<double>(0, 3), 0.0);  // as OpenCV has it: -f B
}
INSTANTIATE_TEST_SUITE_P(Turns, Calibration, testing::Values(0.0, 1.0));

// Mutation: the left camera twice.
TEST(CalibrationFile, HasTheCamerasABaselineApart) {
  const cv::Mat left = matrix_of(kRig, "robot_from_left_camera");
  const cv::Mat right = matrix_of(kRig, "robot_from_right_camera");
  EXPECT_NEAR(left.at<double>(1, 3) - right.at<double>(1, 3), kRig.baseline_m, 1e-12);  // y is left
  EXPECT_NEAR(left.at<double>(2, 3), kRig.height_m, 1e-12);
  EXPECT_EQ(cv::norm(matrix_of(kRig, "D")), 0.0);
  EXPECT_EQ(matrix_of(kRig, "K").size(), cv::Size(3, 3));
}

const nlohmann::ordered_json kOne = {{"seed", 1}};

/// A step's files, of two folders, with a text of theirs.
void write_step(RenderedDataset& dataset, std::size_t step, const std::string& text) {
  const std::string name = std::to_string(step);
  dataset.write(step, {text_file("left/" + name + ".png", "left " + text),
                       text_file("deep/er/depth_" + name + ".pfm", "depth " + text)});
}

void finish(RenderedDataset& dataset) {
  dataset.finish({text_file("calibration.txt", "a rig"), text_file("poses.txt", "poses")}, {});
}

/// All files in a folder.
std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) names.push_back(std::filesystem::relative(entry.path(), folder).string());
  return names;
}

// Mutation: writing frames over again.
TEST(RenderedDataset, TakesUpWhatWasInterruptedAndLeavesItsFramesAlone) {
  const TestFolder folder;
  {
    RenderedDataset begun(folder.path(), kOne);
    write_step(begun, 0, "first");
  }
  std::filesystem::remove(folder.path() / "deep/er/depth_0.pfm");
  RenderedDataset again(folder.path(), kOne);
  write_step(again, 0, "second");  // another text, to see which one is kept
  EXPECT_EQ(folder.read("left/0.png"), "left first");
  EXPECT_EQ(folder.read("deep/er/depth_0.pfm"), "depth second");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "manifest-sha256.txt"));
  finish(again);
  const auto marker = nlohmann::json::parse(folder.read("dataset.json"));
  EXPECT_EQ(marker["seed"], 1);
  EXPECT_EQ(marker["frames"], nlohmann::json({0}));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "dataset.unfinished.json"));
}

// Bytes of a file that is there may be dear. Mutation: asked for before the look whether it is.
TEST(RenderedDataset, AsksForNoBytesOfFilesThatAreThere) {
  const TestFolder folder;
  RenderedDataset dataset(folder.path(), kOne);
  write_step(dataset, 0, "first");
  const auto dear = []() -> std::string { throw std::logic_error("asked for"); };
  EXPECT_NO_THROW(dataset.write(0, {{"left/0.png", dear}}));
  EXPECT_THROW(dataset.write(0, {{"left/1.png", dear}}), std::logic_error);
}

// Law: whatever file loses a part, all of it, or a bit, it is found, made again, and all others stay.
// Mutations: sizes alone compared; files that are missing not looked for; frames alone listed.
TEST(RenderedDataset, FindsWhatIsNotAsItWasWritten) {
  const TestFolder folder;
  const auto write_all = [](RenderedDataset& dataset) {
    for (const std::size_t step : {0U, 1U}) write_step(dataset, step, std::to_string(step));
    finish(dataset);
  };
  RenderedDataset first(folder.path(), kOne);
  write_all(first);
  const std::string manifest = folder.read("manifest-sha256.txt");
  EXPECT_EQ(files_in(folder.path()).size(), 10U);
  EXPECT_TRUE(RenderedDataset(folder.path(), kOne).spoilt().empty());
  for (const std::string& name : files_in(folder.path())) {
    if (name == "manifest-sha256.txt") continue;
    const std::string bytes = folder.read(name);
    std::string flipped = bytes;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    for (const std::string& spoilt : {bytes.substr(0, bytes.size() / 2), flipped, std::string()}) {
      if (name == "dataset.json" && !spoilt.empty()) continue;  // it no longer says what was rendered
      folder.write(name, spoilt);
      if (spoilt.empty()) std::filesystem::remove(folder.path() / name);
      RenderedDataset again(folder.path(), kOne);
      EXPECT_EQ(again.spoilt(), std::vector<std::string>{name});
      EXPECT_FALSE(std::filesystem::exists(folder.path() / "manifest-sha256.txt"));
      write_all(again);
      EXPECT_EQ(folder.read(name), bytes) << name;
      EXPECT_EQ(folder.read("manifest-sha256.txt"), manifest) << name;
    }
  }
}

// Whoever lists a file of somebody else's removes it. Mutations: all files of the folder listed; names not
// looked at.
TEST(RenderedDataset, ListsAndRemovesItsOwnFilesAlone) {
  const TestFolder folder;
  RenderedDataset dataset(folder.path(), kOne);
  write_step(dataset, 0, "first");
  folder.write("notes.csv", "mine");
  folder.write("left/notes.png", "mine");
  finish(dataset);
  const std::string whole = folder.read("manifest-sha256.txt");
  EXPECT_THAT(whole, testing::Not(HasSubstr("notes")));
  const std::string hash(64, 'a');
  for (const char* victim : {"../victim", "left/../../victim", "/victim", "left/", ".", ""}) {
    folder.write("manifest-sha256.txt", whole + hash + "  " + victim + "\n");
    EXPECT_THAT([&] { RenderedDataset(folder.path(), kOne); },
                ThrowsMessage<std::runtime_error>(HasSubstr("expected the name of a file in the folder")))
        << victim;
  }
}

// A format's file would be written over, or taken for the data set's own.
TEST(RenderedDataset, TakesNoFileOfAFormatForItsOwn) {
  const TestFolder folder;
  for (const char* name : {"dataset.json", "README.md", "croissant.json", "manifest-sha256.txt"}) {
    RenderedDataset dataset(folder.path(), kOne);
    EXPECT_THAT([&] { dataset.write(0, {text_file(name, "mine")}); },
                ThrowsMessage<std::logic_error>(HasSubstr("is no format's file")));
  }
}

// Whoever is killed right before the manifest has nothing that says it is whole.
TEST(RenderedDataset, IsNotFinishedWithoutAManifest) {
  const TestFolder folder;
  const auto write_all = [](RenderedDataset& dataset) {
    write_step(dataset, 0, "first");
    finish(dataset);
  };
  RenderedDataset first(folder.path(), kOne);
  write_all(first);
  const std::string manifest = folder.read("manifest-sha256.txt");
  std::filesystem::remove(folder.path() / "manifest-sha256.txt");
  RenderedDataset again(folder.path(), kOne);
  EXPECT_FALSE(again.is_complete());
  write_all(again);
  EXPECT_EQ(folder.read("manifest-sha256.txt"), manifest);
}

// Law: the manifest is what `sha256sum -c` alone checks, of every file but itself.
TEST(RenderedDataset, HasAManifestThatSha256sumChecks) {
  const TestFolder folder;
  RenderedDataset dataset(folder.path(), kOne);
  write_step(dataset, 0, "first");
  finish(dataset);
  const std::string check =
      "cd '" + folder.path().string() + "' && sha256sum --strict -c manifest-sha256.txt > checked 2>&1";
  ASSERT_EQ(std::system(check.c_str()), 0) << folder.read("checked");
  const std::string checked = folder.read("checked");
  for (const std::string& name : files_in(folder.path()))
    if (name != "checked" && name != "manifest-sha256.txt") {
      EXPECT_THAT(checked, HasSubstr(name + ": OK\n"));
    }
  folder.write("README.md", "another");
  EXPECT_NE(std::system(check.c_str()), 0);
}

/// Of the parts of two steps, one after the other.
std::vector<DatasetContainer> archive() {
  return {
      {"drive.txt", [](AtomicFile& file, const std::filesystem::path& folder) {
         for (const char* name : {"0", "1"}) {
           std::ifstream part(folder / "dataset.parts" / name);
           file.append(std::string{std::istreambuf_iterator<char>(part), std::istreambuf_iterator<char>()});
         }
       }}};
}

void write_part(RenderedDataset& dataset, std::size_t step, const std::string& text) {
  dataset.write(step, {text_file("dataset.parts/" + std::to_string(step), text)});
}

// Meant to catch: parts in the manifest; parts that stay; bytes replaced at another place.
TEST(RenderedDataset, PutsContainersTogetherOfParts) {
  const TestFolder folder;
  RenderedDataset dataset(folder.path(), kOne);
  write_part(dataset, 0, "one ");
  write_part(dataset, 1, "two");
  auto containers = archive();
  containers.push_back({"head.txt", [](AtomicFile& file, const std::filesystem::path&) {
                          file.append("....tail");
                          file.overwrite(1, "ea");
                        }});
  dataset.finish({text_file("poses.txt", "poses")}, {}, containers);
  EXPECT_EQ(folder.read("drive.txt"), "one two");
  EXPECT_EQ(folder.read("head.txt"), ".ea.tail");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "dataset.parts"));
  EXPECT_THAT(folder.read("manifest-sha256.txt"),
              testing::AllOf(HasSubstr("  drive.txt\n"), HasSubstr("  head.txt\n"),
                             HasSubstr("  poses.txt\n"), testing::Not(HasSubstr("dataset.parts"))));
  EXPECT_EQ(nlohmann::json::parse(folder.read("dataset.json"))["frames"], nlohmann::json({0, 1}));
  EXPECT_TRUE(RenderedDataset(folder.path(), kOne).is_complete());
}

// Whoever ends while a container is written has lost no part, nor leaves half a container. Mutations: parts
// removed before the manifest is there; the container's file at its place at once.
TEST(RenderedDataset, KeepsPartsUntilTheManifestIsThere) {
  const TestFolder folder;
  {
    RenderedDataset begun(folder.path(), kOne);
    write_part(begun, 0, "one ");
    write_part(begun, 1, "two");
    std::vector<DatasetContainer> containers = archive();
    containers.push_back({"other.txt", [](AtomicFile& file, const std::filesystem::path&) {
                            file.append("half");
                            throw std::runtime_error("full");
                          }});
    EXPECT_THROW(begun.finish({}, {}, containers), std::runtime_error);
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "other.txt"));
  EXPECT_EQ(folder.read("dataset.parts/1"), "two");
  RenderedDataset again(folder.path(), kOne);
  write_part(again, 0, "another");  // is there: kept
  write_part(again, 1, "another");
  again.finish({}, {}, archive());
  EXPECT_EQ(folder.read("drive.txt"), "one two");
}

// Killed right after the manifest: the parts go when the folder is looked at again. Those of an unfinished
// data set stay. Meant to catch: each for the other.
TEST(RenderedDataset, RemovesPartsThatAreOfNoMoreUse) {
  const TestFolder folder;
  RenderedDataset dataset(folder.path(), kOne);
  write_part(dataset, 0, "one ");
  remove_used_parts(folder.path());
  EXPECT_EQ(folder.read("dataset.parts/0"), "one ");
  write_part(dataset, 1, "two");
  dataset.finish({}, {}, archive());
  folder.write("dataset.parts/0", "one ");
  EXPECT_TRUE(RenderedDataset(folder.path(), kOne).is_complete());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "dataset.parts"));
}

// Meant to catch: a container that is not among the files that are looked at.
TEST(RenderedDataset, WritesASpoiltContainerAgain) {
  const TestFolder folder;
  for (int round = 0; round < 2; ++round) {
    RenderedDataset dataset(folder.path(), kOne);
    EXPECT_EQ(dataset.spoilt(),
              round == 0 ? std::vector<std::string>() : std::vector<std::string>{"drive.txt"});
    write_part(dataset, 0, "one ");
    write_part(dataset, 1, "two");
    dataset.finish({}, {}, archive());
    EXPECT_EQ(folder.read("drive.txt"), "one two");
    folder.write("drive.txt", "one twp");
  }
}

// Mutations: no check of the identity; none while the data set is unfinished.
TEST(RenderedDataset, RefusesAFolderOfAnotherIdentityFinishedOrNot) {
  const TestFolder folder;
  RenderedDataset dataset(folder.path(), kOne);
  write_step(dataset, 0, "first");
  const auto take_up = [&] { RenderedDataset(folder.path(), {{"seed", 2}}); };
  EXPECT_THAT(take_up, ThrowsMessage<std::runtime_error>(HasSubstr("a data set of another seed; choose")));
  finish(dataset);
  EXPECT_THAT(take_up, ThrowsMessage<std::runtime_error>(HasSubstr("holds a data set of another")));
}

// Of a drive all of whose frames were lost, a format may have no file at all. Mutation: the folder left to
// the files.
TEST(RenderedDataset, IsCompleteWithoutAnyFile) {
  const TestFolder folder;
  const auto place = folder.path() / "data";
  RenderedDataset(place, kOne).finish({}, {});
  EXPECT_EQ(nlohmann::json::parse(folder.read("data/dataset.json"))["frames"], nlohmann::json::array());
  EXPECT_TRUE(RenderedDataset(place, kOne).is_complete());
}

// What failed before its first frame is in nobody's way. Mutations: the marker written at once, or looked at
// where nothing else is.
TEST(RenderedDataset, LeavesNothingBeforeItsFirstFrame) {
  const TestFolder folder;
  const auto place = folder.path() / "data";
  const auto begin = [&](int seed) {
    RenderedDataset begun(place, {{"seed", seed}});
    EXPECT_TRUE(begun.spoilt().empty());
    return begun;
  };
  begin(1);
  EXPECT_FALSE(std::filesystem::exists(place));
  RenderedDataset one = begin(1);
  write_step(one, 0, "first");
  EXPECT_THAT([&] { begin(2); }, testing::Throws<std::runtime_error>());
  for (const char* name : {"left/0.png", "deep/er/depth_0.pfm"}) std::filesystem::remove(place / name);
  RenderedDataset two = begin(2);
  write_step(two, 0, "second");
  EXPECT_THAT([&] { begin(1); }, testing::Throws<std::runtime_error>());
}

}  // namespace
}  // namespace stereobench::harness
