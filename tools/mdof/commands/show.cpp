// mdof show RUN, mdof analyse RUN: a stored run, whole or its figures.
#include <CLI/CLI.hpp>

#include "daemon/doer.h"
#include "daemon/measure/evaluation.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/history_text.h"
#include "tools/mdof/text/run_csv.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/warnings.h"

namespace mdof::tools {
namespace {

struct ShowCommand {
  std::string database, run, axis, reference = "fixture";
  bool csv = false, json = false, all_warnings = false;
};

// run_json() with two members more.
std::string with_hash_and_history(std::string json, const std::string& sha256,
                                  const std::vector<Deed>& deeds) {
  json.pop_back();
  JsonWriter history;
  daemon::write_deeds(history, deeds);
  return json + ",\"result_sha256\":\"" + sha256 + "\",\"history\":" + history.take() + "}";
}

Result<Run> load(store::Store& store, const ShowCommand& command) {
  Reference reference{};
  reference_from(command.reference, reference);  // the option takes no other
  MDOF_TRY(const auto id, run_number(store, command.run, axis_from(command.axis)));
  return daemon::run_stated_at(store, id, reference);
}

// Beside a table of bare numbers: what people must know of them.
void warn_of(const Run& run, bool all) {
  if (run.header.simulated) warn("simulated data: no machine was measured");
  for (const auto& warning : summarised(run.header.warnings, all)) warn(warning);
}

Status show(const ShowCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const Run run, load(store, command));
  if (command.csv) {
    warn_of(run, command.all_warnings);
    return write_out(points_csv(run));
  }
  MDOF_TRY(const std::string sha256, store.result_sha256(run.header.id));
  MDOF_TRY(const auto deeds, store.deeds_of_run(run.header.id));
  if (command.json) return write_line(with_hash_and_history(run_json(run), sha256, deeds));
  const std::size_t width = terminal_columns();
  return write_out(show_text(run, sha256, width, command.all_warnings) +
                   history_text(deeds, width));
}

std::string analysis_json(const Run& run) {
  JsonWriter json;
  json.begin_object()
      .field("run", run.header.id)
      .field("axis", std::string_view(std::string(1, letter(run.header.axis))))
      .field("model", run.header.provenance.model)
      .field("simulated", run.header.simulated);
  write_reference(json, run.header.stated);
  json.key("straightness");
  write_straightness(json, run.straightness);
  json.key("angles");
  write_angles(json, run.angles);
  json.end_object();
  return json.take();
}

Status analyse(const ShowCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const Run run, load(store, command));
  if (command.csv) {
    warn_of(run, command.all_warnings);
    return write_out(figures_csv(run));
  }
  if (command.json) return write_line(analysis_json(run));
  const std::size_t width = terminal_columns();
  return write_out(head_text(run.header, "", width, command.all_warnings) + "\n" +
                   figures_text(run, width));
}

CLI::App* declare(CLI::App& app, const char* name, const char* what, ShowCommand& o) {
  auto* command = app.add_subcommand(name, what);
  add_run_argument(*command, "RUN", o.run, "Number of the run, see mdof runs; or latest");
  add_axis_of_latest(*command, o.axis);
  add_reference_option(*command, o.reference)->capture_default_str();
  add_database_option(*command, o.database);
  add_all_warnings_flag(*command, o.all_warnings);
  add_csv_and_json_flags(*command, o.csv, o.json);
  return command;
}

}  // namespace

void add_show(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<ShowCommand>();
  auto* command = declare(app, "show", "Show the points of a run with uncertainty and flags", *o);
  command->footer(
      "Examples:\n"
      "  mdof show 12\n"
      "  mdof show latest --axis X --csv > points_X.csv");
  command->callback([o, &chosen] { chosen = [o] { return show(*o); }; });
}

void add_analyse(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<ShowCommand>();
  auto* command = declare(app, "analyse", "Show straightness by both lines, and angles", *o);
  command->footer(
      "Examples:\n"
      "  mdof analyse latest\n"
      "  mdof analyse 12 --csv > figures.csv");
  command->callback([o, &chosen] { chosen = [o] { return analyse(*o); }; });
}

}  // namespace mdof::tools
