#include "harness/io/gzip.h"

#include <limits>
#include <new>
#include <stdexcept>

#include <zlib.h>

namespace stereobench::harness {

std::string gzip(std::string_view bytes) {
  constexpr int kWindow = 15 + 16;  // the largest, and the header of gzip
  constexpr int kMemory = 8;
  if (bytes.size() > std::numeric_limits<uInt>::max() / 2)
    throw std::length_error("gzip: more than two gigabytes at once");
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int outcome = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (outcome != Z_STREAM_END) throw std::logic_error("gzip: the bound of the packed size does not hold");
  return packed;
}

}  // namespace stereobench::harness
