#include "renderer/gl/idle_code.h"

#include <cstdint>
#include <string_view>

#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

namespace stereobench::renderer {
namespace {

using Part = ElfW(Phdr);

/// Whether a part of a library is code that nobody has written to: the file has it, too.
bool is_code(const Part& part) {
  return part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0U && (part.p_flags & PF_W) == 0U;
}

std::size_t release(const dl_phdr_info& library) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  std::size_t released = 0;
  for (std::size_t i = 0; i < library.dlpi_phnum; ++i) {
    const Part& part = library.dlpi_phdr[i];
    if (!is_code(part)) continue;
    const std::uintptr_t begin = (library.dlpi_addr + part.p_vaddr) / page * page;
    const std::uintptr_t end = (library.dlpi_addr + part.p_vaddr + part.p_memsz) / page * page;
    if (::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED) == 0) released += end - begin;
  }
  return released;
}

struct LibrarySearch {
  std::string_view name;
  std::size_t released = 0;
};

int visit(dl_phdr_info* library, std::size_t /*size*/, void* data) {
  auto& search = *static_cast<LibrarySearch*>(data);
  if (std::string_view(library->dlpi_name).find(search.name) != std::string_view::npos)
    search.released += release(*library);
  return 0;
}

}  // namespace

std::size_t release_code(std::string_view library) {
  LibrarySearch search{library};
  ::dl_iterate_phdr(visit, &search);
  return search.released;
}

}  // namespace stereobench::renderer
