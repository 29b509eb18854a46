#include "tools/mdof/text/imported_text.h"

#include <cmath>

#include "daemon/measure/imported/imported_run.h"
#include "schema/imported/series.h"
#include "schema/recording/probe_log.h"
#include "schema/recording/run_options.h"
#include "schema/units.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/text/analyses/budget_text.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

bool is_positioning(const Run& run) {
  return run.header.provenance.model == positioning_name(run.header.axis);
}

std::string sense_text(const Run& run) {
  if (!is_positioning(run)) return "";
  return run_options(run.header).imported.sense == PositioningSense::body
             ? ", positive if the moving body is too far in the + direction of the machine axis"
             : ", positive in the + direction of the controller coordinates";
}

}  // namespace

std::string imported_csv(const Run& run) {
  const std::string key = imported_run_error(run.header).key();
  const std::string covers = covers_text(daemon::readings_coverage(run));
  const ImportedSense stated = run_options(run.header).imported;
  const std::string travel = !stated.against_command ? "" : *stated.against_command ? "-" : "+";
  CsvText csv;
  csv.cells({"target", "run", "direction", "position_mm", key, "u_" + key});
  if (is_positioning(run)) csv.cell(kSenseColumn).cell("travel");
  csv.cell("u_covers").end_row();
  for (const MeasuredPoint& p : run.points) {
    csv.cell(std::to_string(p.target)).cell(std::to_string(p.run));
    csv.cell(p.point.direction == 0 ? std::string() : std::to_string(p.point.direction));
    csv.cell(to_mm(p.point.position_m)).cell(to_key_unit(deviation(p)));
    csv.cell(to_key_unit(deviation_uncertainty(p)));
    if (is_positioning(run)) csv.cell(to_string(stated.sense)).cell(travel);
    csv.cell(covers).end_row();
  }
  return csv.take();
}

std::string imported_text(const Run& run, const StatedFigures& figures,
                          const std::string& result_sha256, std::size_t width, bool all_warnings) {
  const ImportedError error = imported_run_error(run.header);
  TextTable table({"target", "run", "dir", "at/mm", error_label(error.key())});
  for (const MeasuredPoint& p : run.points)
    table.add({std::to_string(p.target), std::to_string(p.run), arrow(p.point.direction),
               in_mm(p.point.position_m),
               error.angle ? in_urad(p.point.probe_m.at(0)) : in_um(p.point.probe_m.at(0))});
  const double u =
      run.points.empty() ? std::nan("") : to_key_unit(deviation_uncertainty(run.points.front()));
  return "IMPORTED: measured by another instrument; contains " + run.header.provenance.model +
         " only.\n" + head_text(run.header, result_sha256, width, all_warnings) + "\n" +
         table.text(width) +
         wrapped("deviation = actual - nominal, as in the file" + sense_text(run) +
                     ". Declared standard uncertainty: " +
                     (std::isnan(u) ? std::string("none")
                                    : fixed(u, 4) + (error.angle ? " µrad" : " µm")),
                 width) +
         "\n" + (figures.budgets.empty() ? "" : "\n" + budgets_text(figures.budgets, width)) +
         (figures.why.empty() ? "" : wrapped("Not calculated: " + figures.why + ".", width) + "\n");
}

}  // namespace mdof::tools
