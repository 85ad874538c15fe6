/// libFuzzer's way in: one program for all entries, STEREOBENCH_FUZZ says which. With "--seeds FOLDER" as its
/// only arguments it writes the entry's seeds instead.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "tests/fuzz/entries.h"

namespace {

const stereobench::fuzz::Entry& chosen() {
  const char* name = std::getenv("STEREOBENCH_FUZZ");
  for (const auto& entry : stereobench::fuzz::entries())
    if (name != nullptr && std::string_view(name) == entry.name) return entry;
  std::fprintf(stderr, "STEREOBENCH_FUZZ: expected one of");
  for (const auto& entry : stereobench::fuzz::entries()) std::fprintf(stderr, " %s", entry.name);
  std::fprintf(stderr, "\n");
  std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  if (*count != 3 || std::string_view((*arguments)[1]) != "--seeds") return 0;
  const std::filesystem::path folder = (*arguments)[2];
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const std::string& seed : chosen().seeds())
    std::ofstream(folder / ("seed" + std::to_string(number++)), std::ios::binary) << seed;
  std::exit(0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto& entry = chosen();
  entry.check({data, size});
  return 0;
}
