#include "vision/scratch.h"

namespace stereobench::vision {

#if defined(__SANITIZE_ADDRESS__)
std::pmr::memory_resource& scratch_memory() {
  return *std::pmr::new_delete_resource();
}
#else
std::pmr::memory_resource& scratch_memory() {
  constexpr std::size_t kLargest_bytes = std::size_t{1} << 22U;  // larger blocks are the system's
  thread_local std::pmr::unsynchronized_pool_resource memory({0, kLargest_bytes});
  return memory;
}
#endif

}  // namespace stereobench::vision
