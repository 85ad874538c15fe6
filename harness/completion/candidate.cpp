#include "harness/completion/candidate.h"

#include <utility>

namespace stereobench::harness {

std::vector<Candidate> that_begin_with(std::string_view word, std::vector<Candidate> candidates) {
  std::erase_if(candidates, [word](const Candidate& one) { return !one.text.starts_with(word); });
  return candidates;
}

}  // namespace stereobench::harness
