// The inputs of a separation from the command line: stored runs or CSV files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algo/separation/separate.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/separation/separation.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct SourceOptions {
  std::vector<std::string> sources;  // Run numbers or latest, otherwise file names.
  std::string surface, turned_about, database;
  std::string probe;                            // For runs only.
  std::string axis = "X", moves, travel = "+";  // For files only.
  bool axis_given = false, sides_given = false;
  double at_mm = 0;
  std::optional<double> u_um;
  double match_mm = 0.02;
  bool partial = false;
};

void add_source_options(CLI::App& command, SourceOptions& options);

// All set-ups before turns and shifts, with their names.
struct LoadedSources {
  algo::SeparationRequest request;
  SeparationRecord record;  // Without its result.
  Notices notices;          // Notices of the runs and of their contents.
};

// Errors: files together with runs, runs of several axes or sides, a rig that already subtracts a
// height map, the same readings twice, and errors of reading.
Result<LoadedSources> load_sources(const SourceOptions& options);

// The axis of the 180° turn of the turned set-ups: --turned-about, otherwise the axis of motion.
Axis turned_about(const SourceOptions& options, Axis motion);

}  // namespace mdof::tools
