/// What a call is refused with.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace stereobench {

/// @return the message of the std::runtime_error that a call throws; "no complaint" when it throws none
template <typename Call>
std::string complaint_of(const Call& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no complaint";
}

/// @return the same, a line each; nothing when it throws none
template <typename Call>
std::vector<std::string> complaints_of(const Call& call) {
  std::vector<std::string> lines;
  try {
    call();
  } catch (const std::runtime_error& error) {
    std::istringstream text(error.what());
    for (std::string line; std::getline(text, line);) lines.push_back(line);
  }
  return lines;
}

}  // namespace stereobench
