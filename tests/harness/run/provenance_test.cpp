#include "harness/run/provenance.h"

#include <gmock/gmock.h>

#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::EndsWith;

std::vector<std::string> files_of(const std::string& command) {
  std::vector<std::string> names;
  for (const auto& [name, hash] : files_of_command(command)) names.push_back(name);
  return names;
}

// Mutations: the script alone; a virtual environment's files among them.
TEST(FilesOfCommand, AreTheScriptAndWhatItMayImport) {
  TestFolder folder;
  const std::string script = folder.write("detector.py", "import blobs");
  folder.write("blobs.py", "");
  folder.write("tools/rings.py", "");
  folder.write("weights.bin", "");
  folder.write(".cache/old.py", "");
  folder.write("venv/pyvenv.cfg", "");
  folder.write("venv/lib/numpy.py", "");
  EXPECT_THAT(files_of("python3 '" + script + "'"),
              ElementsAre(EndsWith("/blobs.py"), EndsWith("/detector.py"), EndsWith("/tools/rings.py")));
  EXPECT_THAT(files_of("cat '" + (folder.path() / "weights.bin").string() + "'"),
              ElementsAre(EndsWith("/weights.bin")));
  const auto before = files_of_command(script);
  folder.write("blobs.py", "changed");
  EXPECT_NE(files_of_command(script), before);
}

}  // namespace
}  // namespace stereobench::harness
