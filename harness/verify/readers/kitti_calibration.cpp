#include "harness/verify/readers/kitti_calibration.h"

#include <charconv>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/text_file.h"

namespace stereobench::harness {

std::map<std::string, std::vector<double>> keyed_numbers(const std::filesystem::path& file, char separator) {
  std::istringstream lines(read_text(file));
  std::map<std::string, std::vector<double>> all;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    std::string rest = line.substr(at + 1);
    for (char& letter : rest)
      if (letter == '[' || letter == ']' || letter == ';') letter = ' ';
    std::istringstream words(rest);
    words.imbue(std::locale::classic());
    std::vector<double> numbers;
    for (double number = 0.0; words >> number;) numbers.push_back(number);
    if (words.eof()) all[line.substr(0, at)] = std::move(numbers);
  }
  return all;
}

double shortest_quotient(double product, double factor) {
  const double quotient = product / factor;
  for (int decimals = 0; decimals < std::numeric_limits<double>::digits10; ++decimals) {
    const std::string text = fmt::format("{:.{}e}", quotient, decimals);
    double shorter = quotient;
    std::from_chars(text.data(), text.data() + text.size(), shorter);
    if (shorter * factor == product) return shorter;
  }
  return quotient;
}

ViewCamera projected_camera(const std::filesystem::path& file,
                            const std::map<std::string, std::vector<double>>& numbers,
                            const std::string& key) {
  const auto found = numbers.find(key);
  if (found == numbers.end() || found->second.size() != 12 || !(found->second[0] > 0.0))
    throw std::runtime_error(
        fmt::format("{}: {}: expected 12 numbers, a focal length first", file.string(), key));
  const std::vector<double>& p = found->second;
  ViewCamera camera;
  camera.pinhole = {0, 0, p[0], p[2], p[6]};
  camera.lens.pixel_aspect = p[5] / p[0];
  const double z_m = p[11];
  camera.body_from_camera.translation() << -shortest_quotient(p[3] - p[2] * z_m, p[0]),
      -shortest_quotient(p[7] - p[6] * z_m, p[5]), -z_m;
  return camera;
}

}  // namespace stereobench::harness
