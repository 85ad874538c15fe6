#include "harness/dataset/dataset_export.h"

#include <gmock/gmock.h>

#include "harness/io/text_file.h"
#include "tests/harness/dataset/rendered_twice.h"

namespace stereobench::harness {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class EveryExport : public testing::TestWithParam<DatasetFormat> {};

// Law: what is exported is what would have been rendered, to the byte, dataset.json and all. Mutations: the
// right camera's flow for the left one's; numbers of four digits; the time of the step before.
TEST_P(EveryExport, IsWhatWouldHaveBeenRendered) {
  const RenderedTwice drive(GetParam());
  const auto written = export_dataset(drive.folder("plain"), {&GetParam()}, drive.folder("exported"),
                                      PictureChange{}, [](double) {});
  EXPECT_EQ(written.front().pairs, 3);
  const auto rendered = bytes_in(drive.folder("rendered")), exported = bytes_in(drive.folder("exported"));
  for (const auto& [name, bytes] : rendered) {
    ASSERT_TRUE(exported.contains(name)) << name;
    EXPECT_TRUE(exported.at(name) == bytes) << name;
  }
  EXPECT_EQ(rendered.size(), exported.size());
  EXPECT_TRUE(export_dataset(drive.folder("plain"), {&GetParam()}, drive.folder("exported"), PictureChange{},
                             [](double) {})
                  .front()
                  .was_complete);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryExport,
                         testing::ValuesIn(dataset_formats().begin() + 1, dataset_formats().end()),
                         [](const auto& test) {
                           std::string name(test.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

std::string complaint_of(const fs::path& folder, const char* format, const fs::path& out) {
  try {
    export_dataset(folder, {&dataset_format(format)}, out, PictureChange{}, [](double) {});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

// Mutations: found out after the first pair was written; disparities of 1/256 px taken for exact.
TEST(DatasetExport, NeedsTheTruthThatTheFormatHas) {
  const RenderedTwice without(dataset_format("tum"), "");
  EXPECT_THAT(complaint_of(without.folder("plain"), "middlebury", without.folder("out")),
              HasSubstr("has no disparity in the format exact; render it with --truth disparity"));
  EXPECT_FALSE(fs::exists(without.folder("out")));
  EXPECT_EQ(complaint_of(without.folder("plain"), "euroc", without.folder("out")), "none");
  const RenderedTwice coarse(dataset_format("tum"), "disparity", TruthFormat::kKitti);
  EXPECT_THAT(complaint_of(coarse.folder("plain"), "middlebury", coarse.folder("out")),
              HasSubstr("has no disparity in the format exact; render it with --truth disparity"));
}

// Mutations: red and blue of flow in the other order; depth looked for in a PFM.
TEST(DatasetExport, OfFloatsInTiffIsThatOfPfm) {
  const RenderedTwice exact(dataset_format("tum"), "disparity,flow");
  const RenderedTwice tiff(dataset_format("tum"), "disparity,flow", TruthFormat::kTiff);
  const auto formats = {&dataset_format("sceneflow"), &dataset_format("tum")};
  export_dataset(exact.folder("plain"), formats, exact.folder("out"), PictureChange{}, [](double) {});
  export_dataset(tiff.folder("plain"), formats, tiff.folder("out"), PictureChange{}, [](double) {});
  int compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(exact.folder("out"))) {
    if (entry.path().extension() != ".pfm" && entry.path().extension() != ".png") continue;
    ++compared;
    EXPECT_EQ(read_text(tiff.folder("out") / fs::relative(entry.path(), exact.folder("out"))),
              read_text(entry.path()))
        << entry.path();
  }
  EXPECT_GT(compared, 10);
}

// Mutations: a flipped bit is exported; another format is read as if it were plain.
TEST(DatasetExport, RefusesWhatIsNotAsItWasRendered) {
  const RenderedTwice drive(dataset_format("tum"));
  EXPECT_THAT(complaint_of(drive.folder("rendered"), "euroc", drive.folder("out")),
              HasSubstr("format: expected none"));
  EXPECT_THAT(complaint_of(drive.folder("nowhere"), "euroc", drive.folder("out")),
              HasSubstr("expected a whole data set"));
  std::string picture = drive.files().read("plain/right/000001.png");
  picture.back() = static_cast<char>(picture.back() ^ 1);
  drive.files().write("plain/right/000001.png", picture);
  EXPECT_THAT(
      complaint_of(drive.folder("plain"), "euroc", drive.folder("out")),
      HasSubstr(
          "1 files are missing or not as they were rendered (the first: right/000001.png); render it again"));
  EXPECT_FALSE(fs::exists(drive.folder("out")));
}

}  // namespace
}  // namespace stereobench::harness
