/// Bytes packed as gzip does.
#pragma once

#include <string>
#include <string_view>

namespace stereobench::harness {

/// Packs bytes into a gzip member (RFC 1952) without name and time: equal bytes give equal bytes. Members one
/// after the other are a file of all that is in them.
std::string gzip(std::string_view bytes);

}  // namespace stereobench::harness
