#include <fstream>
#include <string>

#include <Eigen/Core>
#include <assimp/version.h>
#include <fmt/format.h>
#include <glm/detail/setup.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "renderer/backend.h"

namespace stereobench::harness {
namespace {

/// A line of /proc/cpuinfo such as "model name"; empty when there is none.
std::string cpu_line(const std::string& key) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key) && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "";
}

/// Of the instruction sets that can change how pictures are rendered, the ones this CPU has.
std::string cpu_features() {
  const std::string flags = " " + cpu_line("flags") + " ";
  std::string found;
  for (const char* feature : {"sse4_1", "avx", "avx2", "fma", "f16c", "avx512f"})
    if (flags.find(fmt::format(" {} ", feature)) != std::string::npos) found += fmt::format(" {}", feature);
  return found.empty() ? " none of note" : found;
}

int examine(renderer::Backend backend) {
  fmt::print("stereobench {}\n", STEREOBENCH_VERSION);
  fmt::print("CPU         {},{}\n", cpu_line("model name"), cpu_features());
  fmt::print("libraries   OpenCV {}, Eigen {}.{}.{}, GLM {}.{}.{}, assimp {}.{}.{}, nlohmann-json {}.{}.{}\n",
             CV_VERSION, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, GLM_VERSION_MAJOR,
             GLM_VERSION_MINOR, GLM_VERSION_PATCH, aiGetVersionMajor(), aiGetVersionMinor(),
             aiGetVersionPatch(), NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
             NLOHMANN_JSON_VERSION_PATCH);
  const renderer::BackendInfo gl = renderer::backend_info(backend);
  fmt::print("GL          {}: OpenGL {}, {}\n", renderer::name_of(backend), gl.gl_version, gl.gl_renderer);
  const renderer::TestFrame frame = renderer::render_test_frame(backend);
  const bool right = frame.complaint.empty();
  fmt::print("test frame  {}\n", right ? "as expected" : "NOT as expected: " + frame.complaint);
  fmt::print("fingerprint {}\n", renderer::fingerprint(gl, frame));
  return right ? kPassed : kBadInput;
}

}  // namespace

void add_doctor_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("doctor", "say what it runs on and whether a test frame renders as expected");
  auto backend = std::make_shared<renderer::Backend>(renderer::Backend::kSoftware);
  add_backend_option(*command, *backend);
  command->footer(
      "The fingerprint names the pixels that are rendered here: where two are equal, pictures can be "
      "compared "
      "byte for byte.\n"
      "Exits with 2 when there is no GL to render with, or the test frame is wrong.");
  command->callback([backend, &action] { action = [backend] { return examine(*backend); }; });
}

}  // namespace stereobench::harness
