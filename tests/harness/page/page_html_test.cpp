/// Pages as files: that texts stay texts, and numbers numbers. tests/browser has what browsers make of them.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/seeds.h"
#include "harness/page/base64.h"
#include "harness/page/command_words.h"
#include "harness/page/page.h"
#include "harness/page/page_json.h"
#include "harness/page/text_alternative.h"
#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++found;
  return found;
}

/// A page with a text at every place that takes one.
Page page_saying(const std::string& text) {
  Page page{.title = text, .facts = {text}};
  page.blocks.push_back({.title = text, .note = text, .commands = {text}, .content = PageText{{text}}});
  page.blocks.push_back(
      {.title = "", .note = "", .content = PageTable{{text}, {{{{.text = text, .link = text}}}}, text}});
  page.blocks.push_back({.title = "",
                         .note = "",
                         .content = PageCharts{{{.name = text,
                                                 .x_label = text,
                                                 .y_label = text,
                                                 .x_names = {text},
                                                 .series = {{.name = text, .x = {0.0}, .y = {1.0}}}}}}});
  page.blocks.push_back({.title = "",
                         .note = "",
                         .content = PageMap{.landmarks = {{.colour = text}}, .estimates = {{.name = text}}}});
  const FramePanel panel{text, {}, {{.label = text}}, {{.label = text}}};
  page.blocks.push_back(
      {.title = "", .note = "", .content = PageFrames{.frames = {{text, text, text, {panel}}}}});
  return page;
}

// Law: a page has the same tags whatever its texts are. Mutation: "<" as it is.
TEST(PageHtml, NoTextEndsTheScriptThatItStandsIn) {
  const std::string plain = page_html(page_saying("plain"));
  for (const char* text :
       {"</script><script>alert(1)</script>", "<!--<script>", "</SCRIPT >", "\"}]}</style>"}) {
    const std::string html = page_html(page_saying(text));
    EXPECT_EQ(count(html, "<"), count(plain, "<")) << text;
    EXPECT_THAT(html, HasSubstr("\\u003c"));
  }
}

// Law: the script reads the texts as they were. Mutation: a place of `page_saying` left out of page_json.
TEST(PageHtml, EveryTextIsInItAsItWas) {
  const std::string text = "</script> \\ \" \n \xC3\xA9 & {}";
  const std::string html = page_html(page_saying(text));
  const std::string begin = "<script type=\"application/json\" id=\"page\">";
  const std::size_t from = html.find(begin) + begin.size();
  const auto json = nlohmann::ordered_json::parse(html.substr(from, html.find("</script>", from) - from));
  EXPECT_EQ(json, page_json(page_saying(text)));
  const std::string dumped = nlohmann::json(text).dump();
  // Its 23 places, and three in the words of the chart.
  EXPECT_EQ(count(json.dump(), dumped.substr(1, dumped.size() - 2)), 26U);
}

// Mutation: dump() as it is, which throws.
TEST(PageHtml, BytesThatAreNoTextAreReplaced) {
  EXPECT_THAT(page_html({.title = "a\xFFz"}), HasSubstr("a\xEF\xBF\xBDz"));
}

// Mutations: a style sheet, a script or a font of another place.
TEST(PageHtml, AsksNobody) {
  const std::string html = page_html(page_saying("plain"));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  for (const char* asking : {"src=\"http", "href=\"http", "@import", "url(", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(count(html, asking), 0U) << asking;
  EXPECT_THAT(html, HasSubstr("Chart.js v3"));
}

// Mutation: a clock, or an address in memory.
TEST(PageHtml, EqualPagesGiveEqualBytes) {
  EXPECT_EQ(page_html(page_saying("x")), page_html(page_saying("x")));
}

Page with(auto content) {
  return {.blocks = {{.title = "", .note = "", .content = std::move(content)}}};
}

// Mutations: five digits; NaN as it is, which JSON has not; counts with decimals.
TEST(PageJson, NumbersHaveSixDigitsAndWhatIsNoneIsNull) {
  const Series series{
      .name = "",
      .x = {1.0, 2.0, 3.0, 4.0, 5.0},
      .y = {0.123456789, kNan, std::numeric_limits<double>::infinity(), -1.23456789e-12, 7.0}};
  const auto y = page_json(
      with(PageCharts{{{.series = {series}}}}))["blocks"][0]["content"]["charts"][0]["series"][0]["y"];
  EXPECT_EQ(y.dump(), "[0.123457,null,null,-1.23457e-12,7]");
}

TEST(PageJson, RefusesRowsAndSeriesThatDoNotFit) {
  EXPECT_THROW(page_json(with(PageTable{{"a", "b"}, {{{{"1"}}}}})), std::invalid_argument);
  const auto refused = [](const Series& series) {
    EXPECT_THROW(page_json(with(PageCharts{{{.series = {series}}}})), std::invalid_argument);
  };
  refused({.x = {1.0}, .y = {}});
  refused({.x = {1.0}, .y = {1.0}, .low = {1.0, 2.0}, .high = {1.0, 2.0}});
  refused({.x = {1.0}, .y = {1.0}, .low = {1.0}, .high = {}});
  refused({.look = Look::kBand, .x = {1.0}, .y = {1.0}, .low = {1.0}, .high = {1.0}});
}

// RFC 4648, chapter 10. Mutation: no padding.
TEST(Base64, IsThatOfTheStandard) {
  const std::array<std::pair<const char*, const char*>, 7> vectors = {{{"", ""},
                                                                       {"f", "Zg=="},
                                                                       {"fo", "Zm8="},
                                                                       {"foo", "Zm9v"},
                                                                       {"foob", "Zm9vYg=="},
                                                                       {"fooba", "Zm9vYmE="},
                                                                       {"foobar", "Zm9vYmFy"}}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64(std::string("\0\xff\xfe", 3)), "AP/+");
}

std::string said_by_shell(const std::string& line) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(("printf '%s|' " + line).c_str(), "r"),
                                                             pclose);
  std::string text;
  for (int c = 0; (c = std::fgetc(pipe.get())) != EOF;) text += static_cast<char>(c);
  return text;
}

// Law: a shell reads back the words that were meant, whatever is in them. Mutations: no quotes; quotes within
// words as they are; a character too many among the plain ones.
TEST(ShellLine, IsReadBackByAShell) {
  slam::RandomStream random(5, slam::Stream::kWorld);
  for (int i = 0; i < 40; ++i) {
    std::vector<std::string> words;
    std::string expected;
    for (int word = 0; word < 12; ++word) {
      words.emplace_back();
      for (int letter = 0; letter < word; ++letter)
        words.back() += static_cast<char>(' ' + static_cast<int>(random.uniform() * 95.0));
      expected += words.back() + "|";
    }
    EXPECT_EQ(said_by_shell(shell_line(words)), expected);
  }
  EXPECT_EQ(shell_word("--set"), "--set");
}

// Law: --seeds reads back the same seeds. Mutation: a range where one is missing.
TEST(SeedsWord, IsReadBack) {
  for (const std::vector<std::uint64_t>& seeds : std::vector<std::vector<std::uint64_t>>{
           {0}, {3}, {0, 1, 2, 3}, {5, 6}, {0, 1, 3}, {3, 2, 1}, {7, 100, 8}})
    EXPECT_EQ(parse_seeds(seeds_word(seeds)), seeds);
  EXPECT_EQ(seeds_word(std::vector<std::uint64_t>{0, 1, 2}), "0..2");
}

// Mutations: what is not finite counted; a band's ends left out.
TEST(TextAlternative, SaysWhatAChartShows) {
  const Chart chart{.x_label = "time [s]",
                    .y_label = "error [m]",
                    .series = {{.name = "ekf", .x = {0.0, 1.0, 2.0}, .y = {0.25, kNan, 0.125}},
                               {.name = "seeds", .look = Look::kPoints, .x = {0.5}, .y = {7.0}},
                               {.name = "band", .look = Look::kBand, .x = {1.0}, .low = {0.5}, .high = {1.5}},
                               {.name = "none"}}};
  EXPECT_EQ(
      text_alternative(chart),
      "Chart of error [m] over time [s] from 0 to 2.00. ekf: 2 points from 0.125 to 0.250, the last 0.125. "
      "seeds: 1 point from 7.00 to 7.00. band: a band within 0.500 to 1.50. none: nothing.");
}

TEST(TextAlternative, SaysHowFarEstimatesAreOffInTheEnd) {
  const PageMap map{.time_s = {0.0, 1.0},
                    .truth = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 0)},
                    .landmarks = {{}, {}},
                    .estimates = {{.name = "ekf", .path = {{0.0, 0.0}, {4.0, 5.0}}}, {.name = "lost"}}};
  EXPECT_EQ(text_alternative(map), "Map of 2 instants with 2 landmarks. ekf ends 5.00 m from the truth.");
}

}  // namespace
}  // namespace stereobench::harness
