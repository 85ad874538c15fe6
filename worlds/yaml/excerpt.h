/// Text from outside, made fit for one line of a message.
#pragma once

#include <string>
#include <string_view>

namespace stereobench::worlds {

/// The first letters of a text on one line, without control characters; "..." says that there is more.
/// @param most letters that are shown
std::string excerpt(std::string_view text, std::size_t most = 160);

}  // namespace stereobench::worlds
