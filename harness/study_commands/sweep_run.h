/// A sweep from its plan to its result.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/commands/scenario_arguments.h"
#include "harness/run/provenance.h"
#include "harness/run/seed_drive.h"
#include "harness/sweep/sweep_result.h"

namespace stereobench::harness {

/// What a command line says of a sweep.
struct SweepArguments {
  ScenarioArguments scenario;
  std::vector<std::string> variations;
  std::string paired_to;  ///< empty: cells are not compared
  int adaptive = 0;       ///< further values that may be chosen
};

/// A cell before it is run.
struct CellPlan {
  Cell values;
  std::vector<std::string> overrides;
  Experiment experiment;
  Provenance made_from;
  std::vector<DriveTask> tasks;  ///< they refer to the experiment
};

/// Plans stay where they are while others are added: tasks refer to them.
using CellPlans = std::deque<CellPlan>;

/// A sweep before it is run.
struct SweepPlan {
  SweepResult sweep;  ///< its name and what it varies; no cells yet
  CellPlans cells;
  std::string pixels;             ///< as of pixels_of; empty before plan_drives
  bool keeps_sights = false;      ///< whether cells that come later are the same to the detector
  std::vector<DriveTask> drives;  ///< of all cells, one after the other; none before plan_drives
};

/// Reads the scenario of each cell, and checks its gates.
/// @throws std::runtime_error where the command line asks for what does not go together, or a cell's scenario
///   cannot be read, or its gates name no number of run.json
SweepPlan plan_sweep(const SweepArguments& arguments);

/// Gives the cells their drives.
void plan_drives(const SweepArguments& arguments, SweepPlan& plan);

/// What a sweep gave.
struct SweepOutcome {
  SweepResult sweep;
  std::string gate_lines;  ///< for people
  std::size_t broken = 0;  ///< gates
};

/// Runs all cells in processes and writes the files of the sweep. What a killed sweep left there is made use
/// of.
/// @param out an existing folder that can be written
/// @param plan with its drives; cells may be added to it
SweepOutcome sweep_into(const std::filesystem::path& out, const SweepArguments& arguments, SweepPlan& plan);

}  // namespace stereobench::harness
