#include <stdexcept>
#include <string>

#include <dlfcn.h>

#include "tests/picture_codecs/codecs.h"

namespace {

const stereobench::test::PictureCodecs& codecs() {
  static const stereobench::test::PictureCodecs& loaded = [] {
    void* const module = ::dlopen(STEREOBENCH_PICTURE_CODECS, RTLD_NOW | RTLD_LOCAL);
    const void* const found = module != nullptr ? ::dlsym(module, "stereobench_picture_codecs") : nullptr;
    if (found == nullptr)
      throw std::runtime_error(std::string("OpenCV's picture files cannot be loaded: ") + ::dlerror());
    return *static_cast<const stereobench::test::PictureCodecs*>(found);
  }();
  return loaded;
}

}  // namespace

namespace cv {

Mat imread(const String& filename, int flags) {
  return codecs().read(filename, flags);
}

bool imwrite(const String& filename, InputArray img, const std::vector<int>& params) {
  return codecs().write(filename, img, params);
}

bool imencode(const String& ext, InputArray img, std::vector<uchar>& buf, const std::vector<int>& params) {
  return codecs().encode(ext, img, buf, params);
}

Mat imdecode(InputArray buf, int flags) {
  return codecs().decode(buf, flags);
}

}  // namespace cv
