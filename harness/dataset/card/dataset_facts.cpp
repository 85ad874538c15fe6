#include "harness/dataset/card/dataset_facts.h"

#include <map>

#include <fmt/format.h>

#include "harness/dataset/card/format_layout.h"
#include "harness/dataset/drive_json.h"

namespace stereobench::harness {

std::vector<FileGroup> file_groups(const DatasetFacts& facts) {
  const std::string format = format_of(facts);
  std::map<const LayoutEntry*, FileGroup> described;  // in the order of the table: entries of one array
  std::vector<FileGroup> others;
  for (const auto& [name, hash] : facts.files) {
    const LayoutEntry* const entry = layout_entry_of(format, name);
    FileGroup& group = entry != nullptr ? described[entry] : others.emplace_back();
    if (entry != nullptr) group.says = entry->says;
    group.glob = entry != nullptr ? std::string(entry->glob) : name;
    group.names.push_back(name);
    group.bytes += std::filesystem::file_size(facts.folder / name);
  }
  std::vector<FileGroup> groups;
  for (auto& [entry, group] : described) groups.push_back(std::move(group));
  groups.insert(groups.end(), others.begin(), others.end());
  return groups;
}

std::string format_of(const DatasetFacts& facts) {
  return facts.marker.value("format", std::string("plain"));
}

std::string lack_of_pictures(const DatasetFacts& facts) {
  return has_pictures(format_of(facts)) ? "" : " as a log, without the pictures";
}

std::string drive_name_of(const DatasetFacts& facts) {
  const auto drive = facts.marker.find(kDrive);
  return drive == facts.marker.end() ? "drive" : drive->at("name").get<std::string>();
}

std::string title_of(const DatasetFacts& facts) {
  const auto seed = facts.marker.find("seed");
  return seed == facts.marker.end() ? drive_name_of(facts)
                                    : fmt::format("{}, seed {}", drive_name_of(facts), seed->dump());
}

}  // namespace stereobench::harness
