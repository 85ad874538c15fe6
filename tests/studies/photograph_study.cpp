#include "tests/studies/photograph_study.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/io/atomic_file.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "harness/report/detection_picture.h"

namespace stereobench {
namespace {

using photograph::Photograph;

constexpr std::uint64_t kMarkedSeed = 900'000;  // of the four that are marked; no others are near

nlohmann::json json_of(const PhotographScore& s) {
  return {s.pictures,         s.whole,    s.found, s.trusted, s.hidden, s.hidden_trusted, s.nothings,
          s.nothings_trusted, s.errors_px};
}

PhotographScore score_in(const nlohmann::json& json) {
  const auto count = [&](std::size_t i) { return json[i].get<long>(); };
  return {count(0), count(1), count(2),
          count(3), count(4), count(5),
          count(6), count(7), json[8].get<std::vector<double>>()};
}

}  // namespace

PhotographScore study_photographs(std::span<const std::uint64_t> seeds, int jobs,
                                  const std::filesystem::path& pictures) {
  const auto palette = palette_of_four_photographs(kMarkedSeed);
  const vision::ColourTable table = vision::table_of(palette, vision::Levels::kSrgb);
  const std::vector<std::string> names(photograph::kNames.begin(), photograph::kNames.end());
  harness::Progress progress("photographs", static_cast<double>(seeds.size()));
  const auto task = [&](std::size_t index, const std::function<void(double)>&) {
    const Photograph photograph = photograph::take(seeds[index]);
    const auto found = look_at(photograph.levels, table);
    if (!pictures.empty()) {
      const auto drawn = pictures / fmt::format("{:06}.png", seeds[index]);
      harness::write_file_atomically(drawn,
                                     harness::draw_outline_picture(photograph.levels, found, 1280, names));
    }
    const auto bytes = nlohmann::json::to_cbor(json_of(score_of(photograph, found)));
    return std::string(bytes.begin(), bytes.end());
  };
  PhotographScore all;
  for (const std::string& bytes :
       harness::run_in_processes(seeds.size(), jobs, task, [&](double done) { progress.show(done); }))
    all.add(score_in(nlohmann::json::from_cbor(bytes)));
  return all;
}

Section section_of(const PhotographScore& s) {
  const auto share = [](long part, long whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  };
  std::vector<double> errors = s.errors_px;
  std::ranges::sort(errors);
  const double median = errors.empty() ? std::nan("") : errors[errors.size() / 2];
  return {"balls of photographs",
          {{"pictures", static_cast<double>(s.pictures)},
           {"whole balls", static_cast<double>(s.whole)},
           {"share of whole balls found", share(s.found, s.whole), 0.0, {.at_least = 0.95}},
           {"share of these trusted", share(s.trusted, s.found), 0.0, {.at_least = 0.80}},
           {"median error of their centres [px]", median},
           {"balls hidden by 15 to 70 %", static_cast<double>(s.hidden)},
           {"share of these trusted", share(s.hidden_trusted, s.hidden)},
           {"detections of nothing a picture", share(s.nothings, s.pictures)},
           {"of these trusted", share(s.nothings_trusted, s.pictures), 0.0, {.at_most = 0.2}}}};
}

}  // namespace stereobench
