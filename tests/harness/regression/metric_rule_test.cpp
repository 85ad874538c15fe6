#include "harness/regression/metric_rule.h"

#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Mutations: recall that may fall; NIS that may only be smaller; underconfidence that counts in full.
TEST(MetricRule, SaysWhichWayIsWorse) {
  const auto worse = [](const char* metric, double from, double to) {
    const MetricRule rule = rule_of(metric).value();
    return badness(rule, to) > badness(rule, from);
  };
  EXPECT_TRUE(worse("filters.ekf.ate_rms_m", 0.1, 0.2));
  EXPECT_TRUE(worse("vision.recall", 0.9, 0.8));
  EXPECT_TRUE(worse("vision.spurious", 0.0, 1.0));
  for (const char* metric : {"filters.ekf.anees", "filters.ekf.consistency.nis.per_run"}) {
    EXPECT_TRUE(worse(metric, 1.1, 1.2)) << metric;
    EXPECT_TRUE(worse(metric, 0.9, 0.8)) << metric;
    EXPECT_NEAR(2.0 * badness(rule_of(metric).value(), 0.5), badness(rule_of(metric).value(), 2.0), 1e-12);
  }
  EXPECT_TRUE(worse("vision.range_bias_m", 0.1, -0.2));
  EXPECT_TRUE(worse("filters.ekf.consistency.path_coverage.within_95", 0.95, 1.0));
  EXPECT_FALSE(rule_of("vision.visible"));
}

// The last one that fits counts. Mutation: the first.
TEST(MetricRule, TakesTheMarginOfAUser) {
  const std::vector margins = {parse_margin("filters.*.ate_rms_m=2%"),
                               parse_margin("filters.iekf.ate_rms_m=0.003")};
  EXPECT_EQ(rule_of("filters.ekf.ate_rms_m", margins)->relative_margin, 0.02);
  EXPECT_EQ(rule_of("filters.ekf.ate_rms_m", margins)->absolute_margin, 0.0);
  EXPECT_EQ(rule_of("filters.iekf.ate_rms_m", margins)->relative_margin, 0.0);
  EXPECT_EQ(rule_of("filters.iekf.ate_rms_m", margins)->absolute_margin, 0.003);
  EXPECT_EQ(rule_of("filters.ekf.heading_rms_rad", margins)->relative_margin, 0.05);
}

TEST(MetricRule, RefusesAMarginThatIsNone) {
  for (const char* text : {"", "5%", "=5%", "vision.recall", "vision.recall=", "vision.recall=-1",
                           "vision.recall=5 %", "vision.recall=nan", "vision.recall=1%%"})
    EXPECT_THAT([&] { parse_margin(text); },
                ThrowsMessage<std::runtime_error>(HasSubstr("--margin: expected a metric")))
        << text;
}

}  // namespace
}  // namespace stereobench::harness
