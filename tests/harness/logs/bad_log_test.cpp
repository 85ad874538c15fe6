#include <cctype>

#include <gmock/gmock.h>

#include "harness/logs/measurement_log_reader.h"
#include "tests/complaint.h"
#include "tests/harness/logs/log_folder.h"

namespace stereobench::harness {
namespace {

/// A file of the small log that is spoilt, and what the message must say.
struct BadLog {
  const char* name;
  const char* file;
  const char* text;
  const char* message;
};

void PrintTo(const BadLog& bad, std::ostream* stream) {
  *stream << bad.name;
}

std::string message_of(const std::filesystem::path& path) {
  return complaint_of([&] { read_log(path, {}); });
}

/// "file:line: ..." when the message begins with a line, else "file: ...".
std::string located(const BadLog& bad) {
  const bool has_line = std::isdigit(static_cast<unsigned char>(bad.message[0])) != 0;
  return std::string(bad.file) + (has_line ? ":" : ": ") + bad.message;
}

class BadCsvLog : public testing::TestWithParam<BadLog> {};
class BadMrclamLog : public testing::TestWithParam<BadLog> {};

// Each case is a mutation of the reader's: leave out the check, and the case is read.
TEST_P(BadCsvLog, IsRefusedByFileLineAndColumn) {
  const TestFolder folder;
  write_small_csv_log(folder);
  folder.write(std::string("log/") + GetParam().file, GetParam().text);
  const std::string message = message_of(folder.path() / "log");
  EXPECT_THAT(message, testing::HasSubstr(located(GetParam())));
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST_P(BadMrclamLog, IsRefusedByFileLineAndColumn) {
  const TestFolder folder;
  write_small_mrclam_log(folder);
  folder.write(std::string("log/") + GetParam().file, GetParam().text);
  const std::string message = message_of(folder.path() / "log");
  EXPECT_THAT(message, testing::HasSubstr(located(GetParam())));
}

// Found by fuzzing: a clock that jumps made a hundred million steps. Mutation: no look at the span (out of
// memory).
TEST(BadLog, OfElevenDaysIsRefusedWithItsLongestGap) {
  const TestFolder folder;
  write_small_csv_log(folder);
  folder.write("log/observations.csv",
               "t_s,landmark_id,range_m,bearing_rad\n0.5,7,2,0.1\n107777771.5,7,1.5,0.2\n");
  EXPECT_THAT(message_of(folder.path() / "log"),
              testing::AllOf(testing::HasSubstr("log: expected a log of at most 1000000 s"),
                             testing::HasSubstr("and 107777772 s: is a time in another unit")));
}

const char* const kObs = "observations.csv";
const char* const kOdo = "odometry.csv";
#define OBS "t_s,landmark_id,range_m,bearing_rad\n"
#define FULL "t_s,landmark_id,range_m,bearing_rad,colour_class,range_var_m2,cov_m_rad,bearing_var_rad2\n"

INSTANTIATE_TEST_SUITE_P(
    Cases, BadCsvLog,
    testing::Values(
        BadLog{"empty file", kOdo, "", "1: the file is empty, expected the header 't_s,v_mps,w_radps'"},
        BadLog{"header only", kOdo, "t_s,v_mps,w_radps\n", "expected at least one reading"},
        BadLog{"other header", kOdo, "time,v,w\n0,1,0\n",
               "1: expected the header 't_s,v_mps,w_radps' or 't_s,v_mps,steering_rad"},
        BadLog{"no header", kOdo, "0,1,0\n", "1: expected the header"},
        BadLog{"binary", kOdo,
               "\x7f"
               "ELF\x01\x02",
               "1: expected the header 't_s,v_mps,w_radps' or "},
        BadLog{"too few fields", kOdo, "t_s,v_mps,w_radps\n0,1\n",
               "2: expected 3 fields (t_s, v_mps, w_radps), found 2"},
        BadLog{"too many fields", kOdo, "t_s,v_mps,w_radps\n0,1,0,\n",
               "2: expected 3 fields (t_s, v_mps, w_radps), found 4"},
        BadLog{"blank line", kOdo, "t_s,v_mps,w_radps\n0,1,0\n\n1,1,0\n", "3: expected 3 fields"},
        BadLog{"not a number", kOdo, "t_s,v_mps,w_radps\n0,fast,0\n",
               "2: v_mps: expected a finite number, found 'fast'"},
        BadLog{"empty field", kOdo, "t_s,v_mps,w_radps\n0,,0\n",
               "2: v_mps: expected a finite number, found ''"},
        BadLog{"number with a tail", kOdo, "t_s,v_mps,w_radps\n0,1m,0\n",
               "2: v_mps: expected a finite number, found '1m'"},
        BadLog{"decimal comma blank", kOdo, "t_s,v_mps,w_radps\n0, 1,0\n",
               "2: v_mps: expected a finite number, found ' 1'"},
        BadLog{"not finite", kOdo, "t_s,v_mps,w_radps\n0,1,nan\n",
               "2: w_radps: expected a finite number, found 'nan'"},
        BadLog{"infinite", kOdo, "t_s,v_mps,w_radps\n0,-inf,0\n",
               "2: v_mps: expected a finite number, found '-inf'"},
        BadLog{"overflow", kOdo, "t_s,v_mps,w_radps\n0,1e999,0\n",
               "2: v_mps: expected a finite number, found '1e999'"},
        BadLog{"time is a word", kOdo, "t_s,v_mps,w_radps\nnow,1,0\n",
               "2: t_s: expected a time in seconds within 9e9, found 'now'"},
        BadLog{"time in nanoseconds", kOdo, "t_s,v_mps,w_radps\n1248446188457000000,1,0\n",
               "2: t_s: expected a time in seconds within 9e9"},
        BadLog{"time not finite", kOdo, "t_s,v_mps,w_radps\nnan,1,0\n", "2: t_s: expected a time in seconds"},
        BadLog{"time backwards", kOdo, "t_s,v_mps,w_radps\n1,1,0\n0.999999999,1,0\n",
               "3: t_s: expected a time not before the line above, found '0.999999999'"},
        BadLog{"truncated last line", kOdo, "t_s,v_mps,w_radps\n0,1,0\n1,1", "3: expected 3 fields"},
        BadLog{"negative range", kObs, OBS "0,1,-0.5,0\n",
               "2: range_m: expected a range of at least 0, found '-0.5'"},
        BadLog{"range not finite", kObs, OBS "0,1,inf,0\n", "2: range_m: expected a finite number"},
        BadLog{"bearing in degrees", kObs, OBS "0,1,1,45\n",
               "2: bearing_rad: expected radians, at most a full turn, found '45'"},
        BadLog{"sightings backwards", kObs, OBS "1,1,1,0\n0,1,1,0\n",
               "3: t_s: expected a time not before the line above"},
        BadLog{"identity is a fraction", kObs, OBS "0,1.5,1,0\n",
               "2: landmark_id: expected a whole number of at least -1, found '1.5'"},
        BadLog{"identity negative", kObs, OBS "0,-2,1,0\n",
               "2: landmark_id: expected a whole number of at least -1"},
        BadLog{"identity too large", kObs, OBS "0,99999999999,1,0\n",
               "2: landmark_id: expected a whole number"},
        BadLog{"colour negative", kObs, FULL "0,1,1,0,-2,1,0,1\n",
               "2: colour_class: expected a whole number of at least -1"},
        BadLog{"range variance", kObs, FULL "0,1,1,0,3,-1,0,1\n",
               "2: range_var_m2: expected a variance of at least 0"},
        BadLog{"bearing variance", kObs, FULL "0,1,1,0,3,1,0,-1\n",
               "2: bearing_var_rad2: expected a variance of at least 0"},
        BadLog{"covariance", kObs, FULL "0,1,1,0,3,1,1.1,1\n",
               "2: cov_m_rad: expected a covariance no larger than the variances allow"},
        BadLog{"truth twice", "groundtruth.csv", "t_s,x_m,y_m,theta_rad\n0,0,0,0\n0,1,0,0\n",
               "3: t_s: expected a time after the line above"},
        BadLog{"truth in degrees", "groundtruth.csv", "t_s,x_m,y_m,theta_rad\n0,0,0,90\n",
               "2: theta_rad: expected radians"},
        BadLog{"landmark twice", "landmarks.csv", "landmark_id,x_m,y_m\n7,0,0\n7,1,0\n",
               "3: landmark_id: expected each identity once"},
        BadLog{"landmark unknown", "landmarks.csv", "landmark_id,x_m,y_m\n-1,0,0\n",
               "2: landmark_id: expected a whole number of at least 0"},
        BadLog{"landmark not finite", "landmarks.csv", "landmark_id,x_m,y_m\n1,nan,0\n",
               "2: x_m: expected a finite number"},
        BadLog{"no instants", "instants.csv", "t_s\n", "expected at least one instant"},
        BadLog{"instant twice", "instants.csv", "t_s\n0.5\n0.5\n",
               "3: t_s: expected a time after the line above"}));

INSTANTIATE_TEST_SUITE_P(
    Cases, BadMrclamLog,
    testing::Values(
        BadLog{"barcode twice", "Barcodes.dat", "1 5\n7 5\n", "2: Barcode #: expected each barcode once"},
        BadLog{"barcode word", "Barcodes.dat", "1 x\n",
               "1: Barcode #: expected a whole number of at least 0, found 'x'"},
        BadLog{"subject zero", "Barcodes.dat", "# comment\n0 5\n",
               "2: Subject #: expected a whole number of at least 1"},
        BadLog{"fields", "Robot3_Odometry.dat", "0 1\n",
               "1: expected 3 fields (Time [s], forward velocity [m/s], angular velocity[rad/s]), found 2"},
        BadLog{"only comments", "Robot3_Odometry.dat", "# nothing\n", "expected at least one reading"},
        BadLog{"backwards", "Robot3_Measurement.dat", "2 63 1 0\n1 63 1 0\n",
               "2: Time [s]: expected a time not before the line above"},
        BadLog{"negative range", "Robot3_Measurement.dat", "1 63 -1 0\n",
               "1: range [m]: expected a range of at least 0"},
        BadLog{"robot negative range", "Robot3_Measurement.dat", "1 5 -1 0\n",
               "1: range [m]: expected a range of at least 0"},
        BadLog{"deviation", "Landmark_Groundtruth.dat", "7 0 0 -1 0\n",
               "1: x std-dev [m]: expected a deviation of at least 0"},
        BadLog{"truth", "Robot3_Groundtruth.dat", "1 0 0 zero\n",
               "1: orientation [rad]: expected a finite number"}));

TEST(BadLogFolder, SaysWhatItExpected) {
  const TestFolder folder;
  EXPECT_THAT(message_of(folder.path() / "none"), testing::HasSubstr("none: no such file or folder"));
  EXPECT_THAT(message_of(folder.path()),
              testing::HasSubstr("expected odometry.csv or Robot<k>_Odometry.dat"));
  folder.write("notes.txt", "x");
  EXPECT_THAT(message_of(folder.path() / "notes.txt"),
              testing::HasSubstr("notes.txt: expected a log's folder"));
}

TEST(BadLogFolder, NamesTheMissingFile) {
  const TestFolder folder;
  write_small_csv_log(folder);
  std::filesystem::remove(folder.path() / "log/observations.csv");
  EXPECT_THAT(message_of(folder.path() / "log"), testing::HasSubstr("observations.csv[.gz]: no such file"));
}

TEST(BadLogFolder, AsksWhichOfSeveralRobots) {
  const TestFolder folder;
  write_small_mrclam_log(folder);
  folder.write("log/Robot1_Odometry.dat", "100 0 0\n");
  EXPECT_THAT(message_of(folder.path() / "log"), testing::HasSubstr("holds robots 1, 3; name one, as in"));
  EXPECT_EQ(message_of(folder.path() / "log/Robot3_Odometry.dat"), "no complaint");
}

TEST(BadLogFolder, AFolderInTheFilesPlaceIsNamed) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "log/odometry.csv");
  EXPECT_THAT(message_of(folder.path() / "log"),
              testing::HasSubstr("odometry.csv: is a folder, expected a file"));
}

// Mutation: not asking zlib for its verdict at the end; a download that broke off would pass as a short log.
TEST(BadLogFolder, ATruncatedOrDamagedGzipIsNamed) {
  const TestFolder folder;
  write_small_csv_log(folder);
  std::string long_csv = "t_s,v_mps,w_radps\n";
  for (int i = 0; i < 20'000; ++i)
    long_csv += std::to_string(i) + ",0." + std::to_string(i * 7919 % 1000) + ",0\n";
  write_gz(folder.path() / "log/odometry.csv.gz", long_csv);
  std::filesystem::remove(folder.path() / "log/odometry.csv");
  ASSERT_EQ(message_of(folder.path() / "log"), "no complaint");
  const std::string packed = folder.read("log/odometry.csv.gz");
  for (const std::size_t kept : {packed.size() - 1, packed.size() - 9, packed.size() / 2}) {
    folder.write("log/odometry.csv.gz", packed.substr(0, kept));
    EXPECT_THAT(message_of(folder.path() / "log"),
                testing::HasSubstr("odometry.csv.gz: gzip data are damaged"));
  }
  std::string damaged = packed;
  damaged[packed.size() - 6] = static_cast<char>(damaged[packed.size() - 6] ^ 1);  // in the check sum
  folder.write("log/odometry.csv.gz", damaged);
  EXPECT_THAT(message_of(folder.path() / "log"),
              testing::HasSubstr("odometry.csv.gz: gzip data are damaged"));
}

TEST(BadLogFolder, ASightingOutsideTheStatedInstantsIsNamed) {
  const TestFolder folder;
  write_small_csv_log(folder);
  folder.write("log/instants.csv", "t_s\n0.5\n1.499\n");
  EXPECT_EQ(message_of(folder.path() / "log"), "no complaint");
  folder.write("log/instants.csv", "t_s\n0.5\n1.4989\n");
  EXPECT_THAT(message_of(folder.path() / "log"),
              testing::HasSubstr("observations.csv:3: t_s: expected one of the times of instants.csv"));
}

TEST(BadLogNoise, MustBePositive) {
  EXPECT_THROW(read_log(".", {0.0, 0.1}), std::invalid_argument);
  EXPECT_THROW(read_log(".", {0.1, std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
