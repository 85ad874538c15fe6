#include "worlds/yaml/parse_yaml.h"

#include <algorithm>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

namespace stereobench::worlds {
namespace {

/// Measures the nesting of a document while it is parsed, and ends the parsing where it is too deep, or would
/// never end. No node exists by then.
class NestingLimit : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override {
    // Before a stray separator the parser finds one empty document after another, and never ends.
    if (mark.pos == begun_at_)
      throw YAML::ParserException(mark, "a ',', ']' or '}' outside of any list or map");
    begun_at_ = mark.pos;
    open_.clear();
    heights_.clear();
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t anchor) override { heights_[anchor] = 0; }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t anchor, const std::string&) override {
    heights_[anchor] = 0;
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto known = heights_.find(anchor);
    if (known == heights_.end()) throw YAML::ParserException(mark, "an alias within what it stands for");
    reach(mark, known->second);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(mark, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin(mark, anchor);
  }
  void OnMapEnd() override { end(); }

 private:
  /// A list or map that has begun.
  struct Group {
    YAML::anchor_t anchor;
    int height;  ///< levels of lists and maps within it so far
  };

  void begin(const YAML::Mark& mark, YAML::anchor_t anchor) {
    reach(mark, 1);
    open_.push_back({anchor, 0});
  }
  void end() {
    const Group group = open_.back();
    open_.pop_back();
    heights_[group.anchor] = group.height + 1;
    if (!open_.empty()) open_.back().height = std::max(open_.back().height, group.height + 1);
  }
  /// Something of this height stands within what is open.
  void reach(const YAML::Mark& mark, int height) {
    if (static_cast<int>(open_.size()) + height > kMostNesting)
      throw YAML::ParserException(mark, fmt::format("lists and maps at most {} deep", kMostNesting));
    if (!open_.empty()) open_.back().height = std::max(open_.back().height, height);
  }

  int begun_at_ = -1;  ///< the last document, in characters
  std::vector<Group> open_;
  std::map<YAML::anchor_t, int> heights_;  ///< of finished nodes by anchor; nodes without one share an entry
};

}  // namespace

std::vector<YAML::Node> parse_yaml(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  NestingLimit limit;
  while (parser.HandleNextDocument(limit)) {
  }
  return YAML::LoadAll(text);
}

}  // namespace stereobench::worlds
