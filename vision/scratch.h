/// Memory for what lives no longer than a frame is looked at.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

namespace stereobench::vision {

/// What a thread keeps between frames: after the first one of a kind nothing more is asked of the system.
/// Under AddressSanitizer it is the system's own, so that nothing is hidden from it.
std::pmr::memory_resource& scratch_memory();

/// Allocates from the scratch memory of the thread that asks; who frees must be the same thread.
template <typename T>
struct ScratchAllocator {
  using value_type = T;

  ScratchAllocator() = default;
  template <typename Other>
  ScratchAllocator(const ScratchAllocator<Other>&) {
  }  // NOLINT(google-explicit-constructor): as all allocators

  T* allocate(std::size_t count) {
    return static_cast<T*>(scratch_memory().allocate(count * sizeof(T), alignof(T)));
  }
  void deallocate(T* memory, std::size_t count) {
    scratch_memory().deallocate(memory, count * sizeof(T), alignof(T));
  }
  template <typename Other>
  bool operator==(const ScratchAllocator<Other>&) const {
    return true;
  }
};

/// A vector that is gone by the end of the frame.
template <typename T>
using ScratchVector = std::vector<T, ScratchAllocator<T>>;

}  // namespace stereobench::vision
