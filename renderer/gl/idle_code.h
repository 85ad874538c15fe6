/// Code of libraries that has done its work.
#pragma once

#include <cstddef>
#include <string_view>

namespace stereobench::renderer {

/// What shaders are compiled by; a driver compiles one when it draws for the first time.
inline constexpr std::string_view kCompiler = "libLLVM";

/// Takes the pages of libraries' code out of this process. They are the file's: what is called again comes
/// back with the call, from the system's cache of files.
/// @param library part of the name of the libraries' files; none need be loaded
/// @return the bytes of code that these libraries have
std::size_t release_code(std::string_view library);

}  // namespace stereobench::renderer
