#include "harness/page/base64.h"

#include <vector>

#include <openssl/evp.h>

namespace stereobench::harness {

std::string base64(std::string_view bytes) {
  std::vector<unsigned char> text(4 * ((bytes.size() + 2) / 3) + 1);
  const std::vector<unsigned char> data(bytes.begin(), bytes.end());
  const int length = EVP_EncodeBlock(text.data(), data.data(), static_cast<int>(data.size()));
  return {text.begin(), text.begin() + length};
}

}  // namespace stereobench::harness
