#include "tests/picture_codecs/codecs.h"

/// Found by its name with dlsym.
extern "C" __attribute__((visibility("default")))
const stereobench::test::PictureCodecs stereobench_picture_codecs = {
    .read = cv::imread, .write = cv::imwrite, .encode = cv::imencode, .decode = cv::imdecode};
