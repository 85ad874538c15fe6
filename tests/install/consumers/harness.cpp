// The program with a detector of one's own.
#include "harness/detector/detector_registry.h"
#include "harness/program.h"

using namespace stereobench;

int main(int argc, char** argv) {
  harness::register_detector({"blind", [](const harness::DetectorSetup&) -> harness::Detector {
                                return [](const harness::DetectorInput&) {
                                  return std::vector<vision::BallObservation>();
                                };
                              }});
  return harness::run_program(argc, argv);
}
