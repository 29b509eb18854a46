// Options and output of commands that show one stored run.
#pragma once

#include "daemon/store/store.h"
#include "schema/run.h"
#include "tools/mdof/text/analyses/run_text.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct ChosenRun {
  std::string database, run, axis, reference = "fixture";
  bool csv = false, json = false, all_warnings = false;
  Extent extent = Extent::brief;
  std::string out;  // Output file; empty: standard output.
};

void add_chosen_run(CLI::App& command, ChosenRun& choice);

// Loads the run with its errors at the reference point `choice.reference`.
Result<Run> load_run(store::Store& store, const ChosenRun& choice);

// Warns if another run supersedes this run. `database`: the argument of --db.
Status warn_if_superseded(store::Store& store, std::int64_t run, const std::string& database);

// Writes the CSV table, and prints the notices of the run. Writes the warnings that apply ("#
// SIMULATED", "# DOUBTFUL", noise only) as lines before the table, because a user may pass on the
// file alone.
Status write_marked_csv(const Run& run, bool noise_only, const std::string& csv,
                        const ChosenRun& choice);

// Prints the run in the format of mdof show and mdof export.
Status show_run(const ChosenRun& choice);

}  // namespace mdof::tools
