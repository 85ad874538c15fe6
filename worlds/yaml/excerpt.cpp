#include "worlds/yaml/excerpt.h"

namespace stereobench::worlds {

std::string excerpt(std::string_view text, std::size_t most) {
  std::string shown(text.substr(0, most));
  for (char& letter : shown)
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F) letter = ' ';
  return text.size() > most ? shown + "..." : shown;
}

}  // namespace stereobench::worlds
