#include "daemon/output/report/sections.h"

#include <array>
#include <cmath>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/machine/fixture_chart.h"
#include "daemon/output/report/numbers.h"
#include "schema/axis.h"
#include "schema/imported/series.h"
#include "schema/recording/run_options.h"
#include "schema/rig/report_facts.h"
#include "schema/units.h"

namespace mdof::report {
namespace {

using charts::fixed_text;
using output::Phrase;
using output::phrase;

constexpr std::size_t kMostListedPoints = 2000;

std::string or_missing(const std::string& text, Language language) {
  return text.empty() ? phrase(Phrase::not_stated, language) : text;
}

std::string scans_text(const RunHeader& h, Language language) {
  if (!are_scans_known(h)) return phrase(Phrase::end_not_stored, language);
  const std::string scans = std::to_string(h.scans);
  if (!is_lost_known(h)) return phrase(Phrase::scans_lost_unknown, language, {scans});
  return phrase(Phrase::scans_lost, language, {scans, std::to_string(h.scans_lost)});
}

std::string temperature_of(const RunHeader& h, Language language) {
  if (!h.temperature) return phrase(Phrase::not_recorded, language);
  const auto C = [](double x) { return fixed_text(x, 2); };
  return phrase(Phrase::temperature_value, language,
                {C(h.temperature->mean_C), C(h.temperature->min_C), C(h.temperature->max_C)});
}

std::string declared_temperature(const Rig& rig, Language language) {
  if (!rig.expansion.any) return phrase(Phrase::not_stated, language);
  const auto C = [](const BodyExpansion& body) {
    return charts::number_text(20 + body.above_20_K, 6);
  };
  return phrase(Phrase::temperature_declared, language,
                {C(rig.expansion.scale), C(rig.expansion.fixture)});
}

std::string vector_text(const Vec3& v, double factor) {
  return charts::number_text(v[0] * factor, 6) + ", " + charts::number_text(v[1] * factor, 6) +
         ", " + charts::number_text(v[2] * factor, 6);
}

std::string conformity_text(Conformity conformity, Language language) {
  return phrase(conformity == Conformity::conform       ? Phrase::conform
                : conformity == Conformity::not_conform ? Phrase::not_conform
                                                        : Phrase::undecided,
                language);
}

std::string approach_text(int direction) {
  return direction > 0 ? "+" : direction < 0 ? "−" : "?";
}

std::vector<std::string> point_row(const ReportRun& run, std::size_t row) {
  const auto& [results, uncertainty] = std::tie(run.results.run, run.results.uncertainty);
  const MeasuredPoint& p = results.points[row];
  std::vector<std::string> cells = {std::to_string(p.target), std::to_string(p.run),
                                    approach_text(p.point.direction),
                                    fixed_text(to_mm(p.point.position_m), 4)};
  const Errors5 named = named_from_local(results.header.moving(), p.errors.local);
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const double u = to_key_unit(uncertainty.points[row].u[k]);
    cells.push_back(p.errors.valid ? value_with_u(to_key_unit(named[k]), u) : "–");
  }
  std::string flags = to_string(p.point.flags);
  if (!p.errors.valid) flags += (flags.empty() ? "" : "; ") + p.errors.reason;
  cells.push_back(flags);
  return cells;
}

// The conditions of an imported run: facts on the measurement by the other instrument, and the
// information in its file.
std::vector<std::pair<std::string, std::string>> conditions_of_imported(const Run& run,
                                                                        const std::string& state,
                                                                        Language language) {
  const RunHeader& h = run.header;
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  const ImportedError error = imported_run_error(h);
  const RunOptions options = run_options(h);
  const double u =
      run.points.empty() ? std::nan("") : to_key_unit(deviation_uncertainty(run.points.front()));
  std::string about;
  for (const std::string& line : options.about) about += (about.empty() ? "" : "; ") + line;
  const bool is_positioning = h.provenance.model == positioning_name(h.axis);
  return {{of(Phrase::imported_on), h.started_utc},
          {of(Phrase::state), state},
          {of(Phrase::imported_error), error.name},
          {of(Phrase::stated_in_file), about},
          {of(Phrase::sense_of_deviation),
           !is_positioning
               ? ""
               : of(options.imported.sense == PositioningSense::body ? Phrase::sense_body
                                                                     : Phrase::sense_command)},
          {of(Phrase::declared_u), std::isfinite(u)
                                       ? charts::number_text(u) + " " + key_unit(error.key())
                                       : of(Phrase::not_stated)},
          {of(Phrase::measured_by), h.provenance.software_version},
          {of(Phrase::note), h.note}};
}

void write_readings(Html& html, const Run& run, Language language) {
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  const std::string key = imported_run_error(run.header).key();
  html.element("h3", of(Phrase::readings));
  html.element("p", of(Phrase::readings_explained), "quiet");
  const std::size_t all = run.points.size(), n = std::min(all, kMostListedPoints);
  if (n < all)
    html.element("p",
                 phrase(Phrase::points_left_out, language,
                        {std::to_string(all), std::to_string(n), std::to_string(run.header.id)}));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t row = 0; row < n; ++row) {
    const MeasuredPoint& p = run.points[row];
    const double u = to_key_unit(deviation_uncertainty(p));
    rows.push_back({std::to_string(p.target), std::to_string(p.run),
                    approach_text(p.point.direction), fixed_text(to_mm(p.point.position_m), 4),
                    value_text(to_key_unit(deviation(p)), u), uncertainty_text(u)});
  }
  html.table({of(Phrase::target), of(Phrase::pass), of(Phrase::approach),
              of(Phrase::position) + " / mm", charts::key_label(key), "u / " + key_unit(key)},
             rows, "long points tight");
}

}  // namespace

void write_conditions(Html& html, const ReportRun& run, Language language) {
  const RunHeader& h = run.results.run.header;
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  html.element("h3", of(Phrase::conditions));
  std::string state = output::state_text(h.state, language);
  if (run.superseded_by)
    state += ", " + phrase(Phrase::superseded, language, {std::to_string(*run.superseded_by)});
  if (is_imported(h)) return html.facts(conditions_of_imported(run.results.run, state, language));
  const Phrase time = h.start_known            ? Phrase::started
                      : is_date(h.started_utc) ? Phrase::stated_day
                                               : Phrase::evaluated;
  html.facts({{of(time), h.started_utc},
              {of(Phrase::state), state},
              {of(Phrase::temperature), temperature_of(h, language)},
              {of(Phrase::declared_temperature), declared_temperature(run.rig, language)},
              {of(Phrase::reference_temperature), of(Phrase::not_converted)},
              {of(Phrase::model), h.provenance.model},
              {of(Phrase::moves), std::string(h.sides.moves()) + ", " + h.sides.travel()},
              {of(Phrase::stated_at), reference_text(h.stated)},
              {of(Phrase::scans), scans_text(h, language)},
              {of(Phrase::measured_by), h.provenance.software_version},
              {of(Phrase::note), h.note}});
}

void write_fixture(Html& html, const ReportRun& run, Language language) {
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  html.element("h3", of(Phrase::fixture));
  html.facts({{of(Phrase::rig_name), or_missing(run.rig.name, language)}});
  std::vector<std::vector<std::string>> probes, calibrations;
  for (const Probe& probe : run.rig.probes) {
    probes.push_back({probe.id, vector_text(probe.position_m, 1e3), vector_text(probe.direction, 1),
                      charts::number_text(to_um(probe.range_m))});
    const Calibration& c = probe.calibration;
    calibrations.push_back({probe.id, or_missing(c.certificate, language),
                            or_missing(c.laboratory, language), or_missing(c.calibrated, language),
                            or_missing(c.due, language)});
  }
  html.table({of(Phrase::probe), of(Phrase::probe_position), of(Phrase::probe_direction),
              of(Phrase::probe_range)},
             probes);
  if (!run.rig.probes.empty()) html.figure(charts::fixture_svg(run.rig, language));
  html.element("h3", of(Phrase::calibrations));
  html.table({of(Phrase::probe), of(Phrase::certificate), of(Phrase::laboratory),
              of(Phrase::calibrated), of(Phrase::due)},
             calibrations);
  for (const CalibrationRecord& record : run.rig.records)
    html.element("p", of(Phrase::records_in_place) + ": " +
                          phrase(Phrase::record_text, language,
                                 {record.id, record.kind, record.date,
                                  or_missing(record.valid_until, language)}));
}

void write_results(Html& html, const ReportRun& run, Language language) {
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  const StatedFigures& figures = run.results.figures;
  html.element("h3", of(Phrase::results));
  std::vector<std::vector<std::string>> rows;
  const std::string unknown = of(Phrase::unknown);
  for (const Budget& b : figures.budgets) {
    const double U = to_key_unit(b.U), u = to_key_unit(b.u);
    const bool known = std::isfinite(b.u);
    const std::string U_text = known ? uncertainty_text(U) : unknown;
    rows.push_back(
        {charts::split_key(b.figure).name, value_text(to_key_unit(b.value), u), key_unit(b.figure),
         known ? uncertainty_text(u) : unknown,
         known && b.U_by_trials ? phrase(Phrase::by_monte_carlo, language, {U_text}) : U_text,
         known ? fixed_text(b.coverage_factor, 2) : unknown});
  }
  if (figures.budgets.empty()) {
    for (const StraightnessFigure& f : run.results.run.straightness)
      if (f.approach == "mean")
        rows.push_back({f.error_key.substr(0, 3) + "_straightness",
                        value_text(to_um(f.straightness_least_squares_m), std::nan("")), "µm",
                        unknown, unknown, unknown});
    for (const AngleFigure& f : run.results.run.angles)
      if (f.approach == "mean")
        rows.push_back({f.error_key.substr(0, 3) + "_range",
                        value_text(to_urad(f.max_rad - f.min_rad), std::nan("")), "µrad", unknown,
                        unknown, unknown});
  }
  if (!rows.empty())
    html.table({of(Phrase::figure), of(Phrase::value), of(Phrase::unit), "u", "U (95 %)", "k"},
               rows, "numbers");
  if (!is_imported(run.results.run.header))
    html.element("p", of(Phrase::U_explained), "quiet");
  else if (!figures.budgets.empty())
    html.element("p", of(Phrase::U_explained_imported), "quiet");
  if (const std::string approach = daemon::only_approach(run.results.run); !approach.empty())
    html.element("p", phrase(Phrase::one_approach, language,
                             {of(approach == "forward" ? Phrase::forward : Phrase::reverse)}));
  if (figures.budgets.empty() || !figures.why.empty())
    html.element(
        "p", phrase(figures.budgets.empty() ? Phrase::U_missing_because : Phrase::left_out_because,
                    language,
                    {figures.why.empty() ? "the run has no calculated results" : figures.why}));
  if (!figures.budgets.empty())
    html.element(
        "p", phrase(Phrase::u_covers, language, {words::text(covers(figures.budgets), language)}));
  std::string keys;
  for (const std::string& key : run.results.uncertainty.not_declared)
    keys += (keys.empty() ? "" : ", ") + key;
  if (!keys.empty()) html.element("p", phrase(Phrase::not_declared, language, {keys}));
}

void write_decisions(Html& html, const ReportRun& run, Language language) {
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  html.element("h3", of(Phrase::decision));
  if (run.decided.empty()) {
    html.element("p", of(Phrase::no_decision));
    return;
  }
  write_decided(html, run.decided, run.results.figures.budgets, language);
}

void write_decided(Html& html, const std::vector<Decided>& decided,
                   const std::vector<Budget>& budgets, Language language) {
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  std::vector<std::vector<std::string>> rows;
  for (const auto& [figure, decision] : decided) {
    const Budget* budget = find_budget(budgets, figure);
    rows.push_back({charts::split_key(figure).name,
                    budget ? value_text(to_key_unit(budget->value), to_key_unit(budget->u)) : "–",
                    charts::number_text(to_key_unit(decision.limit), 6), key_unit(figure),
                    conformity_text(decision.conformity, language),
                    decision.rule +
                        (std::isnan(decision.guard_band)
                             ? ""
                             : " = " + uncertainty_text(to_key_unit(decision.guard_band))) +
                        (decision.reason.empty() ? "" : "; " + decision.reason)});
  }
  html.table({of(Phrase::figure), of(Phrase::value), of(Phrase::tolerance), of(Phrase::unit),
              of(Phrase::conformity), of(Phrase::reason)},
             rows, "tight");
}

void write_notices(Html& html, const ReportRun& run, Language language) {
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  html.element("h3", of(Phrase::notices));
  std::vector<std::vector<std::string>> rows;
  const std::array<std::pair<Severity, Phrase>, 3> severities = {
      {{Severity::invalid, Phrase::invalid},
       {Severity::doubtful, Phrase::doubtful},
       {Severity::information, Phrase::information}}};
  for (const auto& [severity, name] : severities)
    for (const Notice& notice : run.results.run.header.notices)
      if (notice.severity == severity) rows.push_back({of(name), words::text(notice, language)});
  if (rows.empty())
    html.element("p", of(Phrase::no_notices));
  else
    html.table({of(Phrase::severity), of(Phrase::notices)}, rows, "long");
}

void write_charts(Html& html, const ReportRun& run, Language language) {
  html.element("h3", phrase(Phrase::charts, language));
  const charts::RunCharts drawn = charts::charts_of_run(run.results, language);
  for (const charts::NamedChart& chart : drawn.charts) html.figure(chart.svg);
  for (const std::string& text : drawn.left_out)
    html.element("p", phrase(Phrase::left_out, language, {text}));
}

void write_points(Html& html, const ReportRun& run, Language language) {
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  const RunHeader& h = run.results.run.header;
  if (is_imported(h)) return write_readings(html, run.results.run, language);
  const std::size_t all = run.results.run.points.size(), n = std::min(all, kMostListedPoints);
  html.element("h3", of(Phrase::points));
  html.element("p", of(Phrase::points_explained), "quiet");
  if (n < all)
    html.element("p", phrase(Phrase::points_left_out, language,
                             {std::to_string(all), std::to_string(n), std::to_string(h.id)}));
  std::vector<std::string> head = {of(Phrase::target), of(Phrase::pass), of(Phrase::approach),
                                   of(Phrase::position) + " / mm"};
  for (const ErrorName& name : error_names(h.axis)) head.push_back(charts::key_label(name.key));
  head.push_back(of(Phrase::flags));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t row = 0; row < n; ++row) rows.push_back(point_row(run, row));
  html.table(head, rows, "long points tight");
}

}  // namespace mdof::report
