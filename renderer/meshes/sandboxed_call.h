/// Work on what cannot be trusted, done by a child process that may crash, hang or eat memory in our place.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace stereobench::renderer {

/// A machine with other work may need so many times as long; more than that, and the child sleeps.
inline constexpr double kPatience = 30.0;

struct ChildLimits {
  double seconds = 4.0;  ///< of its processor; on the wall's clock, kPatience times as much
  std::size_t memory_bytes = std::size_t{1} << 30U;  ///< beyond what this process had when it forked
};

/// Calls `work` in a forked child and gives what it returned.
///
/// The child prints nothing, leaves no core, and dies with its parent; whatever happens, none is left when
/// this returns. `work` must not touch what belongs to threads of the parent, a GL context least of all.
///
/// @throws std::runtime_error with the message of a std::exception that `work` threw, or saying that it took
///   too long, needed too much memory, or crashed
std::string call_in_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace stereobench::renderer
