// What a separation is made of, as the command line gives it: stored runs, or CSV files.
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
  std::vector<std::string> sources;  // numbers of runs or latest, else names of files
  std::string surface, turned_about, database;
  std::string probe;                            // runs
  std::string axis = "X", moves, travel = "+";  // files
  bool axis_given = false, sides_given = false;
  double at_mm = 0;
  std::optional<double> u_um;
  double match_mm = 0.02;
  bool partial = false;
};

void add_source_options(CLI::App& command, SourceOptions& options);

// All set-ups, not turned nor shifted yet, with what they are called.
struct LoadedSources {
  algo::SeparationRequest request;
  SeparationRecord record;  // without its result
  Notices notices;          // of the runs, and what they have in them
};

// Errors: files beside runs, runs of several axes or sides, a rig that subtracts a height map
// already, the same readings twice, and what reading them gives.
Result<LoadedSources> load_sources(const SourceOptions& options);

// By 180° about which axis the turned ones were turned: --turned-about, else the motion.
Axis turned_about(const SourceOptions& options, Axis motion);

}  // namespace mdof::tools
