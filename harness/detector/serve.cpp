#include "harness/detector/serve.h"

#include <istream>
#include <ostream>
#include <string>

#include "harness/detector/detection_lines.h"
#include "harness/detector/protocol.h"
#include "harness/io/picture_reader.h"

namespace stereobench::harness {

void serve_detections(std::istream& requests, std::ostream& answers) {
  std::string line;
  std::getline(requests, line);
  const DetectorSetup setup = read_setup(line);
  const Detector detect = our_detector(setup);
  while (std::getline(requests, line)) {
    const FrameRequest request = read_request(line);
    const vision::StereoPair pair = {read_picture(request.left), read_picture(request.right)};
    const auto balls = detect({request.frame, request.stamp_ns, pair, setup.rig});
    answers << detections_line(request.frame, balls) << '\n' << std::flush;
  }
}

}  // namespace stereobench::harness
