#include "harness/shards/drive_costs.h"

#include "harness/io/json_file.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {
namespace {

constexpr double kMostSeconds = 1e9;
constexpr std::int64_t kMostDrivesMeasured = 1'000'000'000;

}  // namespace

void DriveCosts::add(const std::string& kind, double seconds) {
  for (Sum* const sum : {&sums_[kind], &all_}) {
    sum->seconds += seconds;
    ++sum->drives;
  }
}

double DriveCosts::seconds(const std::string& kind) const {
  const auto found = sums_.find(kind);
  const Sum& sum = found == sums_.end() ? all_ : found->second;
  return sum.drives == 0 ? 1.0 : sum.seconds / static_cast<double>(sum.drives);
}

std::string DriveCosts::json() const {
  nlohmann::ordered_json kinds = nlohmann::ordered_json::object();
  for (const auto& [kind, sum] : sums_) kinds[kind] = {{"seconds", sum.seconds}, {"drives", sum.drives}};
  return json_text({{"measured_plan", measured_plan}, {"kinds", kinds}});
}

DriveCosts read_costs(const std::filesystem::path& file) {
  return read_json_file(file, [](const JsonValue& json) {
    DriveCosts costs;
    costs.measured_plan = json.at("measured_plan").text();
    for (const auto& [kind, value] : json.at("kinds").entries()) {
      const DriveCosts::Sum sum = {
          value.at("seconds").number(0.0, kMostSeconds),
          static_cast<std::size_t>(value.at("drives").integer(1, kMostDrivesMeasured))};
      costs.sums_[kind] = sum;
      costs.all_.seconds += sum.seconds;
      costs.all_.drives += sum.drives;
    }
    return costs;
  });
}

}  // namespace stereobench::harness
