#include "harness/verify/geometry/link_statistics.h"

#include <algorithm>
#include <numeric>

namespace stereobench::harness {

double scale_px(LinkKind kind) {
  constexpr double kMeasured_px = 0.5, kUnmeasured_px = 0.05;
  return is_measured(kind) ? kMeasured_px : kUnmeasured_px;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double median(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Residuals residuals_of(const Claims& claims, const std::vector<Link>& links) {
  Residuals all;
  for (const Link& link : links) {
    const auto residual = residual_px(claims, link);
    if (!residual) continue;
    KindResiduals& kind = all[link.kind];
    kind.length_px.push_back(residual->norm());
    kind.in_tolerances.push_back(residual->norm() / link.tolerance_px);
  }
  return all;
}

ChangedResiduals compared(const Claims& claims, const Claims& changed, const std::vector<Link>& links) {
  std::vector<Link> common;
  for (const Link& link : links)
    if (residual_px(claims, link) && residual_px(changed, link)) common.push_back(link);
  return {residuals_of(claims, common), residuals_of(changed, common)};
}

double share_of_limit(LinkKind kind, const KindResiduals& residuals, double among) {
  return is_measured(kind) ? quantile(residuals.length_px, among) / kGross_px
                           : quantile(residuals.in_tolerances, among);
}

bool is_suspicious(LinkKind kind, const KindResiduals& residuals) {
  return share_of_limit(kind, residuals, kMostLinks) > 1.0;
}

bool is_bad(LinkKind kind, const KindResiduals& residuals) {
  return share_of_limit(kind, residuals, kHalfOfLinks) > 1.0;
}

double disagreement(const Residuals& residuals, const Residuals& otherwise) {
  double sum = 0.0;
  Residuals all = residuals;
  all.insert(otherwise.begin(), otherwise.end());
  for (const auto& [kind, of_kind] : all) {
    sum += mean(of_kind.length_px) / scale_px(kind);
  }
  return sum;
}

}  // namespace stereobench::harness
