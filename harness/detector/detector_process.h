/// Somebody's program in place of our detector.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/detector/detector.h"
#include "harness/experiment/types.h"
#include "harness/process/process_pool.h"
#include "harness/process/supervised_process.h"

namespace stereobench::harness {

/// A detector's program hung, crashed, or answered what it should not.
class DetectorFault : public RunCrash {
 public:
  using RunCrash::RunCrash;
};

/// A program that is shown frames and answers with detections, by the protocol of protocol.h.
///
/// The pictures lie in a temporary folder until they are answered. With the object the program ends, and all
/// that it has started, and the folder is gone.
class DetectorProcess {
 public:
  /// Starts the program.
  /// @param where messages say that it was, e.g. "seed 3"
  /// @throws std::runtime_error when there is no place for pictures, or no process left
  DetectorProcess(const DetectorProgram& program, const DetectorSetup& setup, std::string where);

  /// Shows it a frame.
  /// @throws DetectorFault: what was expected, what came instead, its last error; below, up to ten lines of
  ///   its errors where there are several;
  ///   std::runtime_error when the command cannot be started, or a picture cannot be written
  std::vector<vision::BallObservation> operator()(const DetectorInput& input);

  /// Tells it that there are no more frames, and waits for its end.
  /// @throws DetectorFault when it has said more than it was asked, does not end, or fails in the end
  void finish();

 private:
  /// How long it may take now, its start included until its first answer. [s]
  double patience_s() const;
  /// The same in words.
  std::string patience() const;
  SupervisedProcess::Time deadline() const;
  /// Explains why there is no answer.
  [[noreturn]] void fail(const std::string& when, Heard heard, const std::string& line);
  [[noreturn]] void fault(const std::string& when, const std::string& what);

  DetectorProgram program_;
  DetectorSetup setup_;
  std::string where_;
  std::filesystem::path scratch_;
  std::unique_ptr<SupervisedProcess> process_;
  bool has_answered_ = false;
};

}  // namespace stereobench::harness
