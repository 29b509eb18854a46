// The stored run that a command shows.
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
  std::string out;  // file to write; empty: standard output
};

void add_chosen_run(CLI::App& command, ChosenRun& choice);

// With its errors stated at the reference that was chosen.
Result<Run> load_run(store::Store& store, const ChosenRun& choice);

// A warning to read another run instead.
Status warn_if_superseded(store::Store& store, std::int64_t run);

// A table of bare numbers, with what people must know of them: lines "# SIMULATED", "# DOUBTFUL"
// before it, so that the file says it wherever it goes, and notices.
Status write_csv_of(const Run& run, bool noise_only, const std::string& csv,
                    const ChosenRun& choice);

// The run whole, as mdof show and mdof export write it.
Status show_run(const ChosenRun& choice);

}  // namespace mdof::tools
