#include "renderer/textures/texture_search.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace stereobench::renderer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNames = 20;  // of a complaint

/// A file's place with all links followed, whether or not it exists; empty where links have no end.
fs::path real(const fs::path& path) {
  std::error_code error;
  return fs::weakly_canonical(path, error);
}

/// "its texture a.png", "its textures a.png, b.png", "its textures a.png, ... and 3 more".
std::string listed(const std::vector<std::string_view>& names) {
  const std::size_t shown = std::min(names.size(), kMostNames);
  return fmt::format("its texture{} {}{}", names.size() == 1 ? "" : "s",
                     fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown == names.size() ? "" : fmt::format(" and {} more", names.size() - shown));
}

}  // namespace

TextureFolders::TextureFolders(const fs::path& mesh_file, const std::vector<std::string>& named) {
  const fs::path own = fs::absolute(mesh_file).parent_path();
  folders_.push_back(real(own));
  for (const std::string& folder : named) folders_.push_back(real(folder));
  folders_.push_back(real(own / ".." / "materials" / "textures"));
}

bool TextureFolders::may_read(const fs::path& real) const {
  return std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) {
    return !folder.empty() &&
           std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first == folder.end();
  });
}

TextureFolders::Found TextureFolders::find(std::string name) const {
  constexpr std::string_view kScheme = "file://";
  if (name.starts_with(kScheme)) name.erase(0, kScheme.size());
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path asked(name);
  std::vector<fs::path> places;
  for (const fs::path& folder : folders_) places.push_back(folder / asked);  // an absolute name stays
  for (auto folder = folders_.begin() + 1; folder != folders_.end(); ++folder)
    places.push_back(*folder / asked.filename());
  Found found;
  for (const fs::path& place : places) {
    const fs::path file = real(place);
    std::error_code error;
    if (!may_read(file))
      found.leads_out = true;
    else if (fs::is_regular_file(file, error))
      return {file, false};
  }
  return found;
}

std::string complaint(const std::vector<MissingTexture>& missing) {
  std::vector<std::string_view> gone, outside;
  for (const MissingTexture& texture : missing) (texture.leads_out ? outside : gone).push_back(texture.name);
  std::string line;
  if (!gone.empty())
    line = listed(gone) + (gone.size() == 1 ? " does" : " do") +
           " not exist, beside it, in ../materials/textures or in world.texture_folders";
  if (!outside.empty())
    line +=
        fmt::format("{}{} out of the mesh's folder: world.texture_folders can name others",
                    (line.empty() ? "" : "; ") + listed(outside), outside.size() == 1 ? " leads" : " lead");
  return line;
}

}  // namespace stereobench::renderer
