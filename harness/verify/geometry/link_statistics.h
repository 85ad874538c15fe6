/// Residuals of many links, kind by kind.
#pragma once

#include <map>
#include <vector>

#include "harness/verify/geometry/link.h"

namespace stereobench::harness {

/// Of corners: a median that random errors of corners do not have.
inline constexpr double kGross_px = 1.5;

/// In which unit the residuals of a kind are counted, px: kinds that files say exactly, and those of corners.
double scale_px(LinkKind kind);

/// The value that a share of all values are below; 0 of none.
double quantile(std::vector<double> values, double share);
double median(const std::vector<double>& values);
double mean(const std::vector<double>& values);

/// The links of one kind under some claims.
struct KindResiduals {
  std::vector<double> length_px;
  std::vector<double> in_tolerances;  ///< the same, divided by what rounding may do
};

using Residuals = std::map<LinkKind, KindResiduals>;

Residuals residuals_of(const Claims& claims, const std::vector<Link>& links);

/// What a change of claims makes of the links that both claims say something of.
struct ChangedResiduals {
  Residuals before, after;
};

ChangedResiduals compared(const Claims& claims, const Claims& changed, const std::vector<Link>& links);

/// Of suspicious kinds, and of bad ones: which share of the links the residual is greater than.
inline constexpr double kMostLinks = 0.9, kHalfOfLinks = 0.5;

/// What some share of a kind's residuals are below, as a share of what they may be.
/// @param among of all residuals, from the least on
double share_of_limit(LinkKind kind, const KindResiduals& residuals, double among);

/// Whether so many links are off that a cause is looked for: those of a few frames are enough.
bool is_suspicious(LinkKind kind, const KindResiduals& residuals);

/// Whether most links are off.
bool is_bad(LinkKind kind, const KindResiduals& residuals);

/// How much all kinds disagree; each counts as much, however many links it has.
/// @param otherwise of kinds that residuals say nothing of
double disagreement(const Residuals& residuals, const Residuals& otherwise);

}  // namespace stereobench::harness
