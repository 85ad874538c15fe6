#include "harness/process/kept_memory.h"

#include <limits>

#include <malloc.h>

namespace stereobench::harness {

void keep_freed_memory() {
  constexpr int kLargestPicture = 32 << 20;  // bytes; glibc takes no larger ones from its heap
  ::mallopt(M_MMAP_THRESHOLD, kLargestPicture);
  ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

}  // namespace stereobench::harness
