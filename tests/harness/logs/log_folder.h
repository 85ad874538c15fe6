/// A folder with a small log in it, for tests that spoil one file of it.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <zlib.h>

#include "harness/logs/measurement_log_writer.h"
#include "tests/test_folder.h"

namespace stereobench::harness {

/// Writes a file packed by gzip.
inline void write_gz(const std::filesystem::path& path, const std::string& text) {
  gzFile file = gzopen(path.c_str(), "wb");
  ASSERT_NE(gzwrite(file, text.data(), static_cast<unsigned>(text.size())), 0);
  gzclose(file);
}

inline const std::string kOdometry = "t_s,v_mps,w_radps\n0,1,0\n1,1,0.5\n2,0,0\n";
inline const std::string kObservations = "t_s,landmark_id,range_m,bearing_rad\n0.5,7,2,0.1\n1.5,7,1.5,0.2\n";
inline const std::string kTruth = "t_s,x_m,y_m,theta_rad\n0,0,0,0\n1,1,0,0\n2,2,0,0.5\n";
inline const std::string kLandmarks = "landmark_id,x_m,y_m\n7,3,0\n";

/// Writes a log to a folder, which is there.
inline void write_log(const std::filesystem::path& folder, const MeasurementLog& log) {
  for (const LogFile& file : log_files(log)) std::ofstream(folder / file.name, std::ios::binary) << file.text;
}

/// A log of two seconds in CSV files.
inline void write_small_csv_log(const TestFolder& folder) {
  folder.write("log/odometry.csv", kOdometry);
  folder.write("log/observations.csv", kObservations);
  folder.write("log/groundtruth.csv", kTruth);
  folder.write("log/landmarks.csv", kLandmarks);
}

/// The same in MRCLAM's files, with a sighting of another robot and one of a barcode that nobody has.
inline void write_small_mrclam_log(const TestFolder& folder) {
  folder.write("log/Barcodes.dat", "# Subject Barcode\n 1 5\n 7 63\n");
  folder.write("log/Landmark_Groundtruth.dat", "# x y sx sy\n 7 3.0 0.0 0.001 0.001\n");
  folder.write("log/Robot3_Odometry.dat", "# t v w\n100.0 \t 1.0 \t 0.0 \n101.0 1.0 0.5\n102.0 0 0\n");
  folder.write("log/Robot3_Measurement.dat",
               "# t barcode r b\n100.5 63 2.0 0.1\n100.6 5 1.0 0.0\n101.0 99 1 0\n101.5 63 1.5 0.2\n");
  folder.write("log/Robot3_Groundtruth.dat", "100 0 0 0\n101 1 0 0\n102 2 0 0.5\n");
}

}  // namespace stereobench::harness
