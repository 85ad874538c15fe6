#include "slam/association/map_management.h"

namespace stereobench::slam {

LandmarkStatus founded_by(const Sighting& sighting, const Existence& existence) {
  return {sighting.colour_class, {}, sighting.number, existence.founded()};
}

void note_sighting(LandmarkStatus& status, const Sighting& sighting, Outcome outcome,
                   const Existence& existence) {
  if (outcome == Outcome::kRefuse) {
    status.record.contradict();
  } else if (outcome == Outcome::kMove) {
    status = {status.colour_class, {}, sighting.number, existence.founded()};
  } else {
    status.record.agree();
    status.log_odds = existence.seen(status.log_odds, sighting.observation);
  }
}

}  // namespace stereobench::slam
