// Reads the inputs of a separation that the user names: stored runs or CSV files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algo/separation/separate.h"
#include "algo/separation/sides.h"
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

// The set-ups with their names. The command then sets the turn or shift of each set-up.
struct LoadedSources {
  algo::SeparationRequest request;
  SeparationRecord record;  // The record without the result.
  Notices notices;          // Notices of the runs, and notices about the set-ups.
  // For runs: the probes at the surface in the rig of each set-up.
  std::vector<std::vector<algo::ProbeAcross>> probes;
};

// Errors:
// - the sources are files and runs
// - the runs differ in the axis, the moving body or its direction
// - a rig already subtracts a height map
// - two sources have the same readings
// - a source cannot be read
Result<LoadedSources> load_sources(const SourceOptions& options);

// The axis about which the target was turned by 180° in the turned set-ups: --turned-about, or the
// axis of motion if this option is missing.
Axis turned_about(const SourceOptions& options, Axis motion);

}  // namespace mdof::tools
