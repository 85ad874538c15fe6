/// What OpenCV's reader of KITTI odometry finds in a folder, as JSON. usage: opencv_slam_kitti FOLDER/
#include <iomanip>
#include <iostream>
#include <string>

#include <opencv2/datasets/slam_kitti.hpp>

namespace {

template <class Values>
void print_list(const char* key, const Values& values) {
  std::cout << '"' << key << "\": [";
  for (std::size_t i = 0; i < values.size(); ++i) std::cout << (i == 0 ? "" : ", ") << values[i];
  std::cout << "]";
}

}  // namespace

int main(int, char** argv) {
  const auto reader = cv::datasets::SLAM_kitti::create();
  reader->load(argv[1]);
  const auto& train = reader->getTrain();
  const auto& test = reader->getTest();
  const auto* const sequence =
      static_cast<const cv::datasets::SLAM_kittiObj*>((train.empty() ? test : train).at(0).get());
  std::cout << std::setprecision(17) << "{\"name\": \"" << sequence->name << "\", ";
  for (int camera = 0; camera < 4; ++camera) {
    std::cout << "\"images_" << camera << "\": " << sequence->images[camera].size() << ", ";
    print_list(("p" + std::to_string(camera)).c_str(), sequence->p[camera]);
    std::cout << ", ";
  }
  print_list("times", sequence->times);
  std::cout << ", \"poses\": [";
  for (std::size_t i = 0; i < sequence->posesArray.size(); ++i) {
    std::cout << (i == 0 ? "[" : ", [");
    for (int k = 0; k < 12; ++k) std::cout << (k == 0 ? "" : ", ") << sequence->posesArray[i].elem[k];
    std::cout << "]";
  }
  std::cout << "]}\n";
}
