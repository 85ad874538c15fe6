// A key that is added to a table is read, written and described, without a line elsewhere: what the guide's
// "Add a scenario key" promises, on a struct that no scenario has.
#include "worlds/yaml/fields.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.h"

namespace stereobench::worlds {
namespace {

using testing::HasSubstr;

enum class Colour { kRed, kGreen };

struct Bulb {
  double power_w = 40.0;
};

/// A lamp, as somebody would add it.
struct Lamp {
  double angle_rad = 0.5;
  int blinks = 3;
  bool is_on = true;
  Colour colour = Colour::kGreen;
  Eigen::Vector2d at_m = {1.0, 2.5};
  std::optional<double> height_m;
  Bulb bulb;
  std::vector<Bulb> spares;
};

const Fields<Bulb>& bulb_keys() {
  static const Fields<Bulb> keys({number("power_w", {0.0, 100.0}, "Power, in watts.").fills(&Bulb::power_w)});
  return keys;
}

const Fields<Lamp>& lamp_keys() {
  static const Fields<Lamp> keys({
      number("angle", {0.0, 8.0}, "Angle, in halves of a radian.").times(0.5).fills(&Lamp::angle_rad),
      whole("blinks", 0, 9, "How often.").fills(&Lamp::blinks),
      flag("is_on", "Whether.").written_if_changed().fills(&Lamp::is_on),
      choice("colour", {"red", "green"}, "Which.").fills(&Lamp::colour),
      number("at_m", {-9.0, 9.0}, "Where: x, y.").fills(&Lamp::at_m),
      number("height_m", {0.0, 9.0}, "How high.").otherwise_says("none").fills(&Lamp::height_m),
      number("power_w", {0.0, 100.0}, "Of the bulb.").fills(&Lamp::bulb, &Bulb::power_w),
      group("spares", bulb_keys(), "More bulbs.").list(0, 3).fills(&Lamp::spares),
  });
  return keys;
}

Lamp lamp_of(const std::string& yaml) {
  const YamlDocument document{"lamp.yaml", {}, YAML::Load(yaml)};
  const YamlValue top(document, "", document.root, document.root.Mark());
  check_keys(top, lamp_keys());
  return lamp_keys().read(top);
}

std::string text_of(const Lamp& lamp) {
  YAML::Emitter text;
  text << lamp_keys().write(lamp);
  return text.c_str();
}

const std::string kAll =
    "{angle: 3, blinks: 7, is_on: false, colour: red, at_m: [4, -1.5], height_m: 2, power_w: 60, spares: "
    "[{power_w: 5}, {power_w: 6}]}";

// Mutations: the unit left out, or divided by; the inner member's value written into the outer one.
TEST(Fields, FillTheMembersThatTheyAreBoundTo) {
  const Lamp lamp = lamp_of(kAll);
  EXPECT_EQ(lamp.angle_rad, 1.5);
  EXPECT_EQ(lamp.blinks, 7);
  EXPECT_FALSE(lamp.is_on);
  EXPECT_EQ(lamp.colour, Colour::kRed);
  EXPECT_EQ(lamp.at_m, Eigen::Vector2d(4.0, -1.5));
  EXPECT_EQ(lamp.height_m, 2.0);
  EXPECT_EQ(lamp.bulb.power_w, 60.0);
  ASSERT_EQ(lamp.spares.size(), 2U);
  EXPECT_EQ(lamp.spares[1].power_w, 6.0);
}

// Law: what was read is written as it was. Mutations: a key that is not written; a unit that is read alone.
TEST(Fields, AreWrittenAsTheyWereRead) {
  EXPECT_EQ(text_of(lamp_of(kAll)), kAll);
}

// Mutations: `written_if_changed` without effect, or of all keys; an empty optional written.
TEST(Fields, LeaveOutWhatIsNotThereAndWhatMayBeLeftOut) {
  EXPECT_EQ(text_of(Lamp{}), "{angle: 1, blinks: 3, colour: green, at_m: [1, 2.5], power_w: 40, spares: []}");
}

// The default stands in the struct's initialiser alone. Mutations: the default not divided by the unit; a key
// that is left out set to zero.
TEST(Fields, HaveTheDefaultsOfTheirMembers) {
  EXPECT_EQ(text_of(lamp_of("{}")), text_of(Lamp{}));
  const auto fallback = [](std::string_view key) { return lamp_keys().find(key)->fallback; };
  EXPECT_EQ(fallback("angle"), "1");
  EXPECT_EQ(fallback("is_on"), "true");
  EXPECT_EQ(fallback("colour"), "green");
  EXPECT_EQ(fallback("at_m"), "[1, 2.5]");
  EXPECT_EQ(fallback("height_m"), "");
  EXPECT_EQ(lamp_keys().find("at_m")->lengths.most, 2U) << "as long as the member";
}

/// A lamp that hangs somewhere.
struct HungLamp {
  Lamp lamp = {.blinks = 5};
  double cable_m = 1.5;
};

std::vector<Field<HungLamp>> hung_lamp_fields() {
  std::vector<Field<HungLamp>> fields = lifted(&HungLamp::lamp, lamp_keys().fields());
  insert_behind("blinks", {number("cable_m", {0.0, 9.0}, "Length.").fills(&HungLamp::cable_m)}, fields);
  return joined<HungLamp>({fields, {group("read_by_hand", bulb_keys(), "A bulb.")}});
}

// A table may be made of another one's. Mutations: a lifted default that is not the outer struct's; a key
// that is read by hand read by nobody's function; a key put before the named one.
TEST(Fields, OfAMemberStandAmongOthers) {
  const Fields<HungLamp> keys(hung_lamp_fields());
  EXPECT_EQ(keys.keys.at(2).name, "cable_m");
  EXPECT_EQ(keys.keys.size(), lamp_keys().keys.size() + 2);
  EXPECT_EQ(keys.find("blinks")->fallback, "5");
  EXPECT_EQ(keys.find("angle")->fallback, "1");
  const YamlDocument document{"lamp.yaml", {}, YAML::Load("{angle: 3, cable_m: 2, read_by_hand: {}}")};
  const HungLamp hung = keys.read(YamlValue(document, "", document.root, document.root.Mark()));
  EXPECT_EQ(hung.lamp.angle_rad, 1.5);
  EXPECT_EQ(hung.lamp.blinks, 5);
  EXPECT_EQ(hung.cable_m, 2.0);
  EXPECT_FALSE(keys.write(hung)["read_by_hand"]);
  std::vector<Field<HungLamp>> none;
  EXPECT_THROW(insert_behind("blinks", {}, none), std::logic_error);
}

TEST(Fields, RefuseWhatTheirKeysDoNotDeclare) {
  const auto complaint = [](const std::string& yaml) { return complaint_of([&] { lamp_of(yaml); }); };
  EXPECT_THAT(complaint("{angle: 9}"), HasSubstr("lamp.yaml:1: angle: expected a number from 0 to 8"));
  EXPECT_THAT(complaint("{at_m: 3}"), HasSubstr("at_m: expected a list of 2"));
  EXPECT_THAT(complaint("{spares: [{power_w: x}]}"), HasSubstr("spares[0].power_w: expected a number"));
  EXPECT_THAT(complaint("{blink: 3}"), HasSubstr("did you mean blinks?"));
}

}  // namespace
}  // namespace stereobench::worlds
