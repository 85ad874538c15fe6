/// Where the pictures lie that mesh files name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stereobench::renderer {

/// A texture that a mesh file names and that cannot be had.
struct MissingTexture {
  std::string name;        ///< as the file writes it
  bool leads_out = false;  ///< there is a place that it names, in none of the folders that may be read
  bool operator==(const MissingTexture&) const = default;
};

/// Finds the files that a mesh file names. It may reach its own folder and what is below it, the
/// ../materials/textures beside that, where simulators' models keep them, and folders that the user names:
/// nothing else, whether by "..", by an absolute name or by a link.
class TextureFolders {
 public:
  /// @param named by the user; they may be anywhere
  TextureFolders(const std::filesystem::path& mesh_file, const std::vector<std::string>& named);

  struct Found {
    std::filesystem::path file;  ///< empty where there is none
    bool leads_out = false;
  };
  /// The file of a name: from each of the folders, then by its last part alone in each but the mesh's own.
  /// @param name with either slash
  Found find(std::string name) const;

 private:
  bool may_read(const std::filesystem::path& real) const;

  std::vector<std::filesystem::path> folders_;  // the mesh's own first, without links
};

/// What is wrong with textures that cannot be had, in one line: "its textures a.png, b.png do not exist ...".
std::string complaint(const std::vector<MissingTexture>& missing);

}  // namespace stereobench::renderer
