/// A word that a shell may put in place of one that is being written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stereobench::harness {

struct Candidate {
  std::string text;      ///< the whole word
  std::string says;      ///< what it is; may be empty
  bool is_whole = true;  ///< false: more of the same word follows, as behind "camera."
};

/// Those whose text begins with `word`, in the order that they have.
std::vector<Candidate> that_begin_with(std::string_view word, std::vector<Candidate> candidates);

}  // namespace stereobench::harness
