// mdof solve FRAMES.csv: calculates five errors for each row of positions and readings.
//
//   thread "csv read" -> this thread: parse, calibrate and solve -> thread "write rows"
//   The use of memory does not depend on the size of the file.
#include <CLI/CLI.hpp>

#include "daemon/measure/replay/replay.h"
#include "drivers/calibration.h"
#include "drivers/csv/csv_rows.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/solve/error_rows.h"
#include "tools/mdof/solve/frame_solver.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

struct SolveCommand {
  std::string frames, rig, model = "rigid";
  bool csv = false, json = false;
};

// Options with which no row is skipped, because each input row must have one output row.
drivers::CsvRowsOptions reading_options() {
  drivers::CsvRowsOptions options;
  options.kind = CsvKind::frames;
  options.limits.bad_lines = 0;
  options.sha256 = false;
  return options;
}

Status solve_rows(drivers::CsvRows& frames, FrameSolver& solver, ErrorRows& out) {
  SampleBlock block;
  for (;;) {
    MDOF_TRY(const drivers::ReadState state, frames.next(block));
    if (state == drivers::ReadState::end) return {};
    SolvedRows* const rows = out.next();
    if (!rows) return {};  // finish() returns the error
    MDOF_CHECK(solver.solve(block, *rows));
    out.put();
  }
}

void warn_of_missing(const drivers::CsvRows& frames, const FrameSolver& solver) {
  show_notices(frames.notices(), true);
  if (solver.without_reading() == 0) return;
  warn(std::to_string(solver.without_reading()) + " of " + std::to_string(solver.rows()) +
       " rows have a missing probe reading; the errors that need this reading are empty");
}

Status judge(const FrameSolver& solver) {
  if (solver.over_range() > 0) {
    warn(std::to_string(solver.over_range()) + " of " + std::to_string(solver.rows()) +
         " rows have a probe reading at the end of the range; the errors of these rows may be "
         "wrong");
  }
  if (solver.unsolved() == 0) return {};
  return fail(ErrorCode::check,
              std::to_string(solver.unsolved()) + " of " + std::to_string(solver.rows()) +
                  " rows have no result; first row without result: " + solver.why_unsolved());
}

Status solve(const SolveCommand& command) {
  Model model{};
  model_from(command.model, model);
  MDOF_TRY(const Rig rig, load_rig(command.rig));
  MDOF_TRY(const auto frames, drivers::CsvRows::open(command.frames, reading_options()));
  const CsvHeader& header = frames->header();
  MDOF_CHECK(daemon::check_axis(header.source, header.comments, rig));
  MDOF_CHECK(daemon::check_channels(header.source, header.channels, rig));
  MDOF_TRY(FrameSolver solver, FrameSolver::create(rig, model, header.channels));
  ErrorRows out(command.json ? RowForm::json : RowForm::csv, rig.moving(), model);
  MDOF_CHECK(solve_rows(*frames, solver, out));
  MDOF_CHECK(out.finish());
  warn_of_missing(*frames, solver);
  show_notices(drivers::unused_scales(rig, header.channels), true);
  show_notices(solver.map_notices(rig), true);
  show_notices(solver.calibrated_range_notices(), true);
  show_notices(solver.correction_notices(), true);
  return judge(solver);
}

Action declare_solve(CLI::App& command) {
  const auto o = std::make_shared<SolveCommand>();
  command
      .add_option("FRAMES", o->frames,
                  "File with the column encoder_mm and a column for each probe: CSV, CSV.gz, or - "
                  "for standard input")
      ->required()
      ->type_name("");
  command.add_option("--rig", o->rig, "Rig file, which describes probes and axis")
      ->required()
      ->type_name("RIG.toml");
  add_model_option(command, o->model);
  auto* csv = command.add_flag("--csv", o->csv, "Write CSV (the default)");
  command.add_flag("--json", o->json, "Write one JSON document")->excludes(csv);
  return [o] { return solve(*o); };
}

}  // namespace

Command solve_command() {
  return {
      .name = "solve",
      .summary = "Calculate the five errors of an axis from each row of a file",
      .footer = "Example:\n  mdof solve frames_X.csv --rig rig_X.toml --model exact > errors.csv",
      .declare = declare_solve};
}

}  // namespace mdof::tools
