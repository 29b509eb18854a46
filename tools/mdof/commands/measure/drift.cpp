// mdof drift LOG: decides from a log of a parked axis whether the system has warmed up.
#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>

#include "daemon/measure/replay/parked_log.h"
#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/plot_files.h"
#include "schema/base/files.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/progress_bar.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/parked_text.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

constexpr double kSecondsPerHour = 3600;
constexpr double kPerHour = 3600e9;  // nm/h per m/s

struct DriftCommand {
  std::string log, rig, plots;
  std::optional<double> limit_nm_per_h, limit_urad_per_h, window_s;
  bool json = false, all_warnings = false;
};

Result<daemon::ParkedRequest> request_of(const DriftCommand& c) {
  for (const auto& x : {c.limit_nm_per_h, c.limit_urad_per_h, c.window_s})
    if (x && !std::isfinite(*x))
      return fail(ErrorCode::usage,
                  "--limit-nm-per-h, --limit-urad-per-h and --window-s must be finite numbers");
  daemon::ParkedRequest request;
  request.log = c.log;
  request.rig_source = c.rig;
  if (!c.rig.empty()) {
    MDOF_TRY(request.rig_text, read_text_file(c.rig));
  }
  if (c.limit_nm_per_h) request.limit_m_per_s = *c.limit_nm_per_h / kPerHour;
  if (c.limit_urad_per_h)
    request.angle_limit_rad_per_s = from_urad(*c.limit_urad_per_h) / kSecondsPerHour;
  request.window_s = c.window_s;
  return request;
}

Status drift(const DriftCommand& command) {
  MDOF_TRY(const auto request, request_of(command));
  ProgressBar bar("drift");
  MDOF_TRY(const auto log, daemon::read_parked_log(request, [&](const Progress& progress) {
             bar.show(progress);
             return true;
           }));
  show_notices(log.notices, command.all_warnings);
  const algo::WarmUp found = algo::warm_up(log.readings);
  if (!command.plots.empty())
    MDOF_CHECK(write_plots(
        {{"drift.svg", charts::warm_up_svg(log, found, words::Language::english)}}, command.plots));
  MDOF_CHECK(command.json ? write_line(parked_json(log, found))
                          : write_out(parked_text(log, found, terminal_columns())));
  if (!found.limited || found.ready_after_s) return {};
  return fail(ErrorCode::check, parked_verdict(log, found));
}

Action declare_drift(CLI::App& command) {
  const auto o = std::make_shared<DriftCommand>();
  command.add_option("LOG", o->log, "Log of an axis at rest (CSV or .mdofrec)")
      ->required()
      ->type_name("");
  command
      .add_option("--rig", o->rig,
                  "Rig file, which describes probes and axis [default if LOG is a recording: the "
                  "rig stored in this recording]")
      ->type_name("RIG.toml");
  command
      .add_option(
          "--limit-nm-per-h", o->limit_nm_per_h,
          "Largest permitted drift of probes and straightness errors [default: from the rig]")
      ->check(positive_number());
  command
      .add_option("--limit-urad-per-h", o->limit_urad_per_h,
                  "Largest permitted drift of the angles [default: no limit]")
      ->check(positive_number());
  command
      .add_option("--window-s", o->window_s,
                  "Length of the window over which each drift rate is calculated [default: a "
                  "twelfth of the log]")
      ->check(positive_number());
  add_plot_option(command, o->plots);
  add_all_warnings_flag(command, o->all_warnings);
  add_json_flag(command, o->json);
  return [o] { return drift(*o); };
}

}  // namespace

Command drift_command() {
  return {.name = "drift",
          .summary = "Find when the system has warmed up, from a log of an axis at rest",
          .footer =
              "Exit code 1: the system has not warmed up yet. To see the drift of a run, use: mdof "
              "show RUN --figures\n"
              "Example:\n"
              "  mdof drift parked.csv --rig rig_X.toml --limit-nm-per-h 100",
          .declare = declare_drift};
}

}  // namespace mdof::tools
