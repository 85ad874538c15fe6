/// The example of docs/guide/detectors.md: stereobench with a detector of one's own linked in.
#include <vector>

#include "harness/detector/detector_registry.h"
#include "harness/program.h"

int main(int argc, char** argv) {
  using namespace stereobench;
  // Ours, but for the right third of the left picture.
  const auto monocular = [](const harness::DetectorSetup& setup) -> harness::Detector {
    return [ours = harness::our_detector(setup)](const harness::DetectorInput& input) {
      std::vector<vision::BallObservation> balls = ours(input);
      std::erase_if(balls, [&](const auto& ball) {
        return 3.0 * ball.left_px.x() > 2.0 * input.rig.intrinsics.width_px;
      });
      return balls;
    };
  };
  harness::register_detector({"monocular", monocular});
  return harness::run_program(argc, argv);
}
