/// The keys of a collection that change its pictures.
#pragma once

#include "harness/dataset/pictures/picture_change.h"
#include "worlds/yaml/fields.h"

namespace stereobench::harness {

/// every, crop, scale, kind: as the options of `render`.
const worlds::Fields<PictureChange>& picture_keys();

}  // namespace stereobench::harness
