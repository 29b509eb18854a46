#include "tools/mdof/commands/results/chosen_run.h"

#include <CLI/CLI.hpp>

#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "schema/base/output/output_files.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"

namespace mdof::tools {

void add_chosen_run(CLI::App& command, ChosenRun& choice) {
  add_run_argument(command, "RUN", choice.run, "Number of the run (see mdof runs), or \"latest\"");
  add_latest_axis_option(command, choice.axis);
  add_reference_option(command, choice.reference)->capture_default_str();
  add_database_option(command, choice.database);
  add_all_warnings_flag(command, choice.all_warnings);
  add_csv_and_json_flags(command, choice.csv, choice.json);
}

Result<Run> load_run(store::Store& store, const ChosenRun& choice) {
  Reference reference{};
  reference_from(choice.reference, reference);  // the option accepts only valid names
  MDOF_TRY(const auto id, run_number(store, choice.run, axis_from(choice.axis)));
  return daemon::restated_run(store, id, reference);
}

Status warn_if_superseded(store::Store& store, std::int64_t run, const std::string& database) {
  MDOF_TRY(const auto by, store.superseded_by(run));
  if (by)
    warn("run " + std::to_string(*by) + " supersedes run " + std::to_string(run) +
         "; see mdof show " + std::to_string(*by) + place_options(database));
  return {};
}

Status write_marked_csv(const Run& run, bool noise_only, const std::string& csv,
                        const ChosenRun& choice) {
  if (run.header.simulated) warn("simulated data: no machine was measured");
  show_notices(run.header.notices, choice.all_warnings);
  const std::string text =
      noise_only_comment(noise_only) + csv_marks(daemon::warning_marks(run)) + csv;
  return choice.out.empty() ? write_out(text) : write_file(choice.out, text, Existing::replace);
}

}  // namespace mdof::tools
