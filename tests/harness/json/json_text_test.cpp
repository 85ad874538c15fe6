#include "harness/json/json_text.h"

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

TEST(JsonText, HasAListOfValuesOnOneLine) {
  const Json json = {{"a", {1, 2.5, nullptr}},
                     {"b", {{"c", "d"}}},
                     {"e", Json::array()},
                     {"f", {{1}, {2}}},
                     {"g", Json::object()}};
  EXPECT_EQ(json_text(json), R"({
  "a": [1, 2.5, null],
  "b": {
    "c": "d"
  },
  "e": [],
  "f": [
    [1],
    [2]
  ],
  "g": {}
}
)");
}

// Mutations: a key or a text without its escapes; an empty object as a list.
TEST(JsonText, SaysWhatItWasMadeFrom) {
  const Json json = {
      {"quote \" and \n", "\t\\"}, {"", Json::object()}, {"deep", {{"er", {{{"x", 1e-300}}}}}}};
  EXPECT_EQ(Json::parse(json_text(json)), json);
  for (const Json& plain : {Json(nullptr), Json(3), Json("x"), Json::array(), Json::object()})
    EXPECT_EQ(Json::parse(json_text(plain)), plain);
}

}  // namespace
}  // namespace stereobench::harness
