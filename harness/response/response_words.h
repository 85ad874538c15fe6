/// What a response says, in sentences.
#pragma once

#include <string>
#include <vector>

#include "harness/response/response_fit.h"

namespace stereobench::harness {

/// A level with its unit, by the ending of its key: "0.31 px".
std::string level_word(double level, const std::string& parameter);

/// "0.310 (0.250 to 0.400)"; "0.250 or more" where the value has no end. @return "-" where it is not known
std::string value_word(const ResponseValue& value);

/// "0.31 px (0.25 to 0.40)"; "-" where the sensor costs nothing.
std::string knee_word(const ResponseFit& fit, const ResponseLaw& law);

/// What the columns of response_row are.
std::vector<std::string> response_header(const ResponseFit& fit);

/// A curve with its law: name, floor, slope, knee, exponent, the largest deviation, floor over bound.
/// @param curve that has a law
std::vector<std::string> response_row(const ResponseFit& fit, const CurveFit& curve);

/// One sentence for the bound and one for each filter: below which level the error is not the sensor's, and
/// whose it is there.
///
/// The floor is that of odometry, geometry and other noise where the bound has most of its square too, and
/// the filter's where most of its square is above the bound's: the ratio is on one side of sqrt(2), with its
/// interval. This is the rule of the knee, where the sensor has half of the square.
/// @return nothing for curves without a law
std::vector<std::string> response_sentences(const ResponseFit& fit);

}  // namespace stereobench::harness
