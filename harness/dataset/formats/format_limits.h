/// What formats refuse, since they have no place for it.
#pragma once

#include <string_view>

#include "harness/dataset/dataset_drive.h"

namespace stereobench::harness {

/// A format as its refusals call it.
struct FormatLimits {
  std::string_view format;  ///< its name
  std::string_view holds;   ///< what it has a place for, as the message says it

  /// @throws std::runtime_error, one line that names the scenario's key
  [[noreturn]] void refuse(std::string_view key) const;

  /// Refuses lenses, and pixels that are not square.
  void require_undistorted(const DatasetDrive& drive) const;

  /// Refuses a rig that is not rectified.
  void require_rectified(const DatasetDrive& drive) const;

  /// Refuses a rig that vision is told wrong.
  void require_believed(const DatasetDrive& drive) const;

  /// Refuses rows that look one after another.
  void require_whole_pictures(const DatasetDrive& drive) const;

  /// Refuses cameras that look one after the other, and rows that do.
  void require_one_instant(const DatasetDrive& drive) const;

  /// Refuses what is no rectified pair of one instant whose rig vision knows.
  void require_pairs(const DatasetDrive& drive) const;

  /// Refuses frames that come late without anyone saying so.
  void require_in_time(const DatasetDrive& drive) const;

  /// Refuses frames that are lost.
  void require_all_frames(const DatasetDrive& drive) const;
};

}  // namespace stereobench::harness
