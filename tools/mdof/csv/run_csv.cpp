#include "tools/mdof/csv/run_csv.h"

#include <cmath>

#include "daemon/output/charts/svg.h"
#include "schema/rig/reference.h"
#include "schema/sample.h"
#include "schema/units.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

// A noise of 0 means that the noise is unknown; the cell is then empty.
double known_noise(double u) {
  return u > 0 ? to_key_unit(u) : kNaN;
}

// Writes the last two cells of a row: the reference point of straightness, and its coordinates with
// a space between two numbers. The carriage moves, so its cell of the coordinates is empty.
void add_reference(CsvText& csv, const StatedAt& at) {
  std::vector<std::string> mm;
  for (const double x : at.point_m) mm.push_back(charts::exact_text(to_mm(x)));
  csv.cells({to_string(at.reference), at.reference == Reference::carriage ? "" : joined(mm, " ")})
      .end_row();
}

void add_point(CsvText& csv, const MovingAxis& moving, const MeasuredPoint& p,
               const ErrorsUncertainty& uncertainty, const RunUncertainty& of_run,
               const StatedAt& at) {
  const Errors5 named = named_from_local(moving, p.errors.local);
  const bool valid = p.errors.valid;
  csv.cell(static_cast<long long>(p.target)).cell(to_mm(p.target_m));
  csv.cell(static_cast<long long>(p.run)).cell(static_cast<long long>(p.point.direction));
  csv.cell(to_mm(p.point.position_m));
  for (const double error : named) csv.cell(valid ? to_key_unit(error) : kNaN);
  for (const double u : uncertainty.u) csv.cell(to_key_unit(u));
  for (const double u : uncertainty.u_random) csv.cell(known_noise(u));
  for (const double U : uncertainty.U) csv.cell(to_key_unit(U));
  csv.cell(static_cast<long long>(p.point.samples)).cell(to_string(p.point.flags));
  csv.cell(valid ? "" : p.errors.reason);
  csv.cells({covers_text(of_run), joined(of_run.not_declared, " ")});
  add_reference(csv, at);
}

}  // namespace

std::string points_csv(const Run& run, const RunUncertainty& uncertainty) {
  CsvText csv;
  csv.cells({"target", "target_mm", "run", "direction", "position_mm"});
  for (const auto& name : error_names(run.header.axis)) csv.cell(std::string_view(name.key));
  for (const std::string of : {"u_", "u_random_", "U_"})
    for (const auto& name : error_names(run.header.axis)) csv.cell(of + name.key);
  csv.cells(
      {"samples", "flags", "reason", "u_covers", "not_declared", "reference", "reference_mm"});
  csv.end_row();
  for (std::size_t j = 0; j < run.points.size(); ++j)
    add_point(csv, run.header.moving(), run.points[j], uncertainty.points[j], uncertainty,
              run.header.stated);
  return csv.take();
}

namespace {

// Writes u and U of the figure if it belongs to the mean of both approaches and has a budget.
void add_uncertainty(CsvText& csv, const StatedFigures& figures, const std::string& approach,
                     const std::string& figure) {
  const Budget* budget = approach == "mean" ? find_budget(figures.budgets, figure) : nullptr;
  csv.cell(budget ? to_key_unit(budget->u) : kNaN);
  csv.cell(budget ? to_key_unit(budget->U) : kNaN);
}

void add_covers(CsvText& csv, const StatedFigures& figures, const StatedAt& at) {
  const bool any = !figures.budgets.empty();
  csv.cell(any ? covers_text(figures.budgets) : figures.why);
  csv.cell(any ? joined(figures.budgets.front().not_declared, " ") : "");
  add_reference(csv, at);
}

}  // namespace

std::string figures_csv(const Run& run, const StatedFigures& figures) {
  CsvText csv;
  csv.cells({"error",
             "approach",
             "least_squares_um",
             "u_least_squares_um",
             "U_least_squares_um",
             "end_point_um",
             "slope_least_squares_urad",
             "u_slope_least_squares_urad",
             "U_slope_least_squares_urad",
             "form_urad",
             "slope_end_point_urad",
             "peak_mm",
             "valley_mm",
             "start_urad",
             "min_urad",
             "max_urad",
             "range_urad",
             "u_range_urad",
             "U_range_urad",
             "u_covers",
             "not_declared",
             "reference",
             "reference_mm"});
  csv.end_row();
  for (const auto& f : run.straightness) {
    const std::string error = f.error_key.substr(0, 3);
    csv.cells({error, f.approach}).cell(to_um(f.straightness_least_squares_m));
    add_uncertainty(csv, figures, f.approach, error + "_straightness_um");
    csv.cell(to_um(f.straightness_end_point_m)).cell(to_urad(f.slope_least_squares_rad));
    add_uncertainty(csv, figures, f.approach, error + "_slope_urad");
    csv.cell(to_urad(f.form_rad)).cell(to_urad(f.slope_end_point_rad));
    csv.cell(to_mm(f.peak_position_m)).cell(to_mm(f.valley_position_m));
    csv.cells({"", "", "", "", "", ""});
    add_covers(csv, figures, run.header.stated);
  }
  for (const auto& f : run.angles) {
    const std::string error = f.error_key.substr(0, 3);
    csv.cells({error, f.approach, "", "", "", "", "", "", "", "", "", "", ""});
    csv.cell(to_urad(f.start_rad)).cell(to_urad(f.min_rad)).cell(to_urad(f.max_rad));
    csv.cell(to_urad(f.max_rad - f.min_rad));
    add_uncertainty(csv, figures, f.approach, error + "_range_urad");
    add_covers(csv, figures, run.header.stated);
  }
  return csv.take();
}

}  // namespace mdof::tools
