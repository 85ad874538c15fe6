/// KITTI's text files of calibrations: a key, a colon and numbers on each line.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// The numbers by key; lines whose words are no numbers (a date) are left out.
/// @param separator between key and numbers, ':' for KITTI and '=' for Middlebury
/// @throws std::runtime_error where the file cannot be read
std::map<std::string, std::vector<double>> keyed_numbers(const std::filesystem::path& file,
                                                         char separator = ':');

/// What a rounded product was made of, e.g. the baseline of P1[3] = -f B. A division gives it back but for
/// its last digit.
/// @return the shortest decimal number that times `factor` is the product, to the bit; where there is none,
/// the
///   quotient
double shortest_quotient(double product, double factor);

/// A rectified camera of a 3 x 4 projection; the body is KITTI's camera 0.
/// @throws std::runtime_error "file: P2: expected 12 numbers"
ViewCamera projected_camera(const std::filesystem::path& file,
                            const std::map<std::string, std::vector<double>>& numbers,
                            const std::string& key);

}  // namespace stereobench::harness
