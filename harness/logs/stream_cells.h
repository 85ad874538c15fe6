/// Rows of tables as the values of streams, shared by the CSV and the MRCLAM reader.
#pragma once

#include "harness/io/number_table.h"
#include "harness/logs/recorded_streams.h"

namespace stereobench::harness {

/// Columns t, v, w.
std::vector<OdometryReading> odometry_from(const NumberTable& table);

/// Columns t, x, y, heading.
std::vector<StampedPose> truth_from(const NumberTable& table);

/// Columns id, x, y and whatever follows; identities must differ.
std::vector<LandmarkTruth> landmarks_from(const NumberTable& table);

/// Columns t, id, range, bearing and whatever follows, without the identity.
LoggedSighting sighting_from(const NumberTable& table, const TableRow& row, const SensorNoise& noise);

/// A cell in radians, at most a full turn either way, brought into (-pi, pi].
double angle_in(const NumberTable& table, const TableRow& row, std::size_t column);

/// The stamps of column 0, which must not run backwards.
std::vector<std::int64_t> stamps_from(const NumberTable& table);

}  // namespace stereobench::harness
