// A picture, in software: OpenGL is looked for when the program runs.
#include <cstdio>

#include "renderer/backend.h"
#include "renderer/camera/camera_view.h"

using namespace stereobench;

int main() {
  const renderer::TestFrame frame = renderer::render_test_frame(renderer::Backend::kSoftware);
  std::printf("%s\n", frame.complaint.empty() ? "as expected" : frame.complaint.c_str());
  return frame.complaint.empty() ? 0 : 1;
}
