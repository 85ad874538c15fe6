/// Memory of pictures that stays with the process.
#pragma once

namespace stereobench::harness {

/// Lets the allocator keep memory that is freed, for the whole process from now on. Otherwise each picture's
/// memory goes back to the kernel and comes again page by page, cleared: 25 MB a pair of pictures with ids
/// and depth. A process then stays as large as it has been.
void keep_freed_memory();

}  // namespace stereobench::harness
