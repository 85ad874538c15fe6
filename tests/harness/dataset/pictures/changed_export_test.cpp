#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/dataset/dataset_export.h"
#include "harness/io/picture_reader.h"
#include "tests/complaint.h"
#include "tests/harness/dataset/rendered_twice.h"

namespace stereobench::harness {
namespace {

constexpr const char* kTruth = "balls,disparity,flow";

std::vector<WrittenDataset> export_changed(const RenderedTwice& drive, const DatasetFormat& format,
                                           const PictureChange& change, const char* from = "plain") {
  return export_dataset(drive.folder(from), {&format}, drive.folder("exported"), change, [](double) {});
}

class EveryChangedExport : public testing::TestWithParam<DatasetFormat> {};

// Law: a changed export is what a changed rendering would have been, to the byte, dataset.json and all.
// Mutations: observations of pairs that are left out; the key `pictures` after `format`.
TEST_P(EveryChangedExport, IsWhatWouldHaveBeenRendered) {
  const bool is_grey = GetParam().pictures.find("grey") != std::string_view::npos;
  const bool has_pairs_in_a_row = GetParam().name != "kitti-scene-flow";
  const PictureChange change = {.every = has_pairs_in_a_row ? 2UL : 1UL,
                                .crop = cv::Rect(7, 11, 142, 98),
                                .divide = 2,
                                .kind = is_grey ? PictureKind::kGrey : PictureKind::kColour};
  const RenderedTwice drive(GetParam(), kTruth, TruthFormat::kExact, change);
  EXPECT_EQ(export_changed(drive, GetParam(), change).front().pairs, has_pairs_in_a_row ? 2 : 3);
  const auto rendered = bytes_in(drive.folder("rendered")), exported = bytes_in(drive.folder("exported"));
  for (const auto& [name, bytes] : rendered) {
    ASSERT_TRUE(exported.contains(name)) << name;
    EXPECT_TRUE(exported.at(name) == bytes) << name;
  }
  EXPECT_EQ(rendered.size(), exported.size());
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryChangedExport,
                         testing::ValuesIn(dataset_formats().begin(), dataset_formats().end()),
                         [](const auto& test) {
                           std::string name(test.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// Law: each K-th pair has the bytes that it has in the whole drive.
TEST(ChangedExport, KeepsTheBytesOfEachSoManiethPair) {
  const DatasetFormat& plain = dataset_formats().front();
  const RenderedTwice drive(plain, kTruth, TruthFormat::kExact, {.every = 2});
  const auto whole = bytes_in(drive.folder("plain")), some = bytes_in(drive.folder("rendered"));
  int pictures = 0;
  for (const auto& [name, bytes] : some) {
    if (!name.ends_with(".png") && !name.ends_with(".pfm")) continue;
    ASSERT_TRUE(whole.contains(name)) << name;
    EXPECT_TRUE(whole.at(name) == bytes) << name;
    EXPECT_EQ(name.find("000001."), std::string::npos) << name;
    ++pictures;
  }
  EXPECT_EQ(pictures, 2 * 2 * 5 + 2 * 2);  // two pairs; flow and its mask of the first one alone
}

// Pictures of a changed set are read back in their kind, and copied. Mutation: the kind not read from
// dataset.json.
TEST(ChangedExport, GoesOnFromAChangedSet) {
  const DatasetFormat& plain = dataset_formats().front();
  const DatasetFormat& euroc = dataset_format("euroc");
  const RenderedTwice drive(plain, kTruth, TruthFormat::kExact, {.divide = 2, .kind = PictureKind::kGrey});
  EXPECT_EQ(export_changed(drive, euroc, {}, "rendered").front().pairs, 3);
  const std::string name = fmt::format("exported/mav0/cam0/data/{}.png", kEpoch_ns);
  EXPECT_EQ(drive.files().read(name), drive.files().read("rendered/left/000000.png"));
  EXPECT_EQ(complaint_of([&] { export_changed(drive, dataset_format("tum"), {}, "rendered"); }),
            "the format tum has no place for pictures of the kind grey; it holds colour");
  EXPECT_EQ(complaint_of([&] { export_changed(drive, euroc, {.every = 2}, "rendered"); }),
            fmt::format("{}: its pictures were changed when they were written ({{\"scale\":\"1/2\",\"kind\":"
                        "\"grey\"}}); export them from the set with all of them as the camera took them, or "
                        "leave the options out",
                        drive.folder("rendered").string()));
}

TEST(ChangedExport, RefusesWhatASetDoesNotTell) {
  const DatasetFormat& plain = dataset_formats().front();
  const RenderedTwice drive(dataset_format("tum"), "balls,normal");
  EXPECT_EQ(complaint_of([&] { export_changed(drive, plain, {.every = 2}); }),
            fmt::format("{}: has normal, which is not read from data sets; render it so instead",
                        drive.folder("plain").string()));
  EXPECT_EQ(
      complaint_of([&] { export_changed(drive, plain, {.kind = PictureKind::kLinear16}); }),
      fmt::format("{}: has levels of 8 bits, and linear16 needs more; render it with --picture linear16",
                  drive.folder("plain").string()));
  EXPECT_FALSE(std::filesystem::exists(drive.folder("exported")));
}

/// A set whose right camera is turned.
TEST(ChangedExport, DoesNotCutDisparityWithoutRows) {
  const RenderedTwice drive(dataset_format("euroc"), "disparity", TruthFormat::kExact, {},
                            [](worlds::Scenario& scenario) {
                              scenario.rig.right_turn_rad = {0.01, 0.0, 0.02};
                              scenario.believed_rig = scenario.rig;
                            });
  EXPECT_EQ(
      complaint_of([&] { export_changed(drive, dataset_format("euroc"), {.crop = cv::Rect(0, 0, 80, 60)}); }),
      fmt::format("--crop: {} has disparity of a rig that is not rectified, which does not say in which rows "
                  "points are in the other picture; render it with --crop instead",
                  drive.folder("plain").string()));
  EXPECT_EQ(export_changed(drive, dataset_format("euroc"), {.divide = 2}).front().pairs, 3);
}

// Law: 16 bits are those of the same camera, noise and all: rounded to 8, they are what it stores; and there
// are more than 256 of them. Mutation: noise of the other camera.
TEST(Linear16, IsWhatTheCameraRounds) {
  const RenderedTwice drive(
      dataset_formats().front(), "", TruthFormat::kExact, {.kind = PictureKind::kLinear16},
      [](worlds::Scenario& scenario) { scenario.camera = {.vignette = 0.3, .full_well_electrons = 9000.0}; });
  std::set<int> levels;
  for (const char* name : {"left/000000.png", "right/000002.png"}) {
    const cv::Mat fine = read_exact_png(drive.folder("rendered") / name);
    const cv::Mat stored = read_exact_png(drive.folder("plain") / name);
    ASSERT_EQ(fine.type(), CV_16UC3);
    for (int row = 0; row < fine.rows; ++row)
      for (int i = 0; i < 3 * fine.cols; ++i) {
        const int level = fine.ptr<std::uint16_t>(row)[i];
        EXPECT_LE(std::abs(level - 257 * stored.ptr(row)[i]), 129) << name;
        levels.insert(level);
      }
  }
  EXPECT_GT(levels.size(), 2000U);
}

// A camera that only adds noise needs but light of 8 bits; its linear pictures have more all the same.
TEST(Linear16, HasFineLightOfEveryCamera) {
  const RenderedTwice drive(dataset_formats().front(), "", TruthFormat::kExact,
                            {.kind = PictureKind::kLinear16});
  const cv::Mat fine = read_exact_png(drive.folder("rendered") / "left/000000.png");
  std::set<int> levels;
  for (int row = 0; row < fine.rows; ++row)
    levels.insert(fine.ptr<std::uint16_t>(row), fine.ptr<std::uint16_t>(row) + 3 * fine.cols);
  EXPECT_GT(levels.size(), 500U);
}

}  // namespace
}  // namespace stereobench::harness
