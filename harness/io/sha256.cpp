#include "harness/io/sha256.h"

#include <array>
#include <fstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <openssl/evp.h>

namespace stereobench::harness {
namespace {

template <typename State>
EVP_MD_CTX* context(const State& state) {
  return static_cast<EVP_MD_CTX*>(state.get());
}

void expect(int succeeded) {
  if (succeeded != 1) throw std::runtime_error("libcrypto cannot compute SHA-256");
}

}  // namespace

void Sha256::Free::operator()(void* state) const {
  EVP_MD_CTX_free(static_cast<EVP_MD_CTX*>(state));
}

Sha256::Sha256() : state_(EVP_MD_CTX_new()) {
  expect(EVP_DigestInit_ex(context(state_), EVP_sha256(), nullptr));
}

void Sha256::add(std::string_view bytes) {
  expect(EVP_DigestUpdate(context(state_), bytes.data(), bytes.size()));
}

std::string Sha256::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  expect(EVP_DigestFinal_ex(context(state_), digest.data(), &size));
  std::string digits;
  for (unsigned int i = 0; i < size; ++i) digits += fmt::format("{:02x}", digest[i]);
  return digits;
}

std::string sha256_of(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> part(std::size_t{1} << 16U);
  Sha256 hash;
  while (stream.read(part.data(), std::ssize(part)) || stream.gcount() > 0)
    hash.add({part.data(), static_cast<std::size_t>(stream.gcount())});
  if (!stream.eof()) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  return hash.hex();
}

}  // namespace stereobench::harness
