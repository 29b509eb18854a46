#include "daemon/measure/several_runs/comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/sequence/usable_runs.h"
#include "daemon/measure/gate/added_table.h"
#include "daemon/measure/imported/imported_run.h"
#include "daemon/measure/imported/positioning_figures.h"
#include "daemon/measure/several_runs/change_at_targets.h"
#include "daemon/words/words.h"
#include "schema/axis.h"
#include "schema/base/json_writer.h"
#include "schema/imported/series.h"
#include "schema/notice/notice_json.h"
#include "schema/recording/run_options.h"
#include "schema/rig/report_facts.h"
#include "schema/run_json.h"
#include "schema/sample.h"
#include "schema/uncertainty/budget_json.h"
#include "schema/uncertainty/run_uncertainty.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr double kSameEnd_m = 1e-4;

// For a figure that has changed its sign: the effects that both runs share do not cancel but add
// up, so u of the change becomes the sum u_before + u_after.
void add_shared(Budget& change, double u_before, double u_after) {
  const double freedom = change.freedom, k = change.coverage_factor;
  BudgetLine shared;
  shared.name = {ContributorKind::shared_by_runs};
  shared.distribution = "normal";
  shared.contribution = std::sqrt(2 * u_before * u_after);
  change.lines.push_back(shared);
  algo::complete(change);
  change.freedom = freedom;  // as before the shared effects were added
  change.coverage_factor = k;
  change.U = k * change.u;
}

ComparedFigure compared(const Budget& before, const Budget& after) {
  ComparedFigure figure{before, after, {}, kNaN, Effect::not_shown};
  Budget& change = figure.change;
  change.figure = before.figure;
  change.value = std::abs(after.value) - std::abs(before.value);
  change.u_random = std::hypot(before.u_random, after.u_random);
  change.is_imported = before.is_imported;
  change.is_single_run = before.is_single_run || after.is_single_run;
  change.not_declared = before.not_declared;
  for (const std::string& key : after.not_declared)
    if (std::find(change.not_declared.begin(), change.not_declared.end(), key) ==
        change.not_declared.end())
      change.not_declared.push_back(key);
  for (const Budget* of : {&before, &after}) {
    BudgetLine line;
    line.name = {of == &before ? ContributorKind::run_before : ContributorKind::run_after};
    if (declares(*of)) line.key = "declared";
    line.distribution = "t";
    line.contribution = of->u;
    line.freedom = of->freedom;
    change.lines.push_back(line);
  }
  if (std::isnan(before.u) || std::isnan(after.u)) {
    change.u = change.U = change.freedom = change.coverage_factor = kNaN;
    change.lines.clear();
    figure.effect = Effect::unknown;
    return figure;
  }
  algo::complete(change);
  if (before.value * after.value < 0) add_shared(change, before.u, after.u);
  // Only the calculation by trials includes the bias that noise causes in a range, and the few
  // degrees of freedom. So U is between the root sum of squares of both U (normal distributions)
  // and their sum (Student's t with one degree of freedom), and a factor of t does not enlarge it
  // again.
  if (before.U_by_trials || after.U_by_trials) {
    change.U = std::clamp(change.U, std::hypot(before.U, after.U), before.U + after.U);
    change.U_by_trials = true;
    if (change.u > 0) change.coverage_factor = change.U / change.u;
  }
  change.noise_only = before.noise_only && after.noise_only;
  if (change.value < -change.U) figure.effect = Effect::reduced;
  if (change.value > change.U) figure.effect = Effect::increased;
  return figure;
}

std::pair<double, double> travel_of(const Run& run) {
  std::pair<double, double> ends{HUGE_VAL, -HUGE_VAL};
  for (const auto& point : run.points) {
    ends.first = std::min(ends.first, point.point.position_m);
    ends.second = std::max(ends.second, point.point.position_m);
  }
  return ends;
}

// Whether started_utc is the time of the measurement.
bool has_time(const RunHeader& header) {
  return !is_imported(header) && header.start_known;
}

// Notices about differences that influence the figures. Also a notice if the run "after" was
// measured before the run "before".
Notices differences(const Run& before, const Run& after) {
  Notices found;
  const std::string &began = before.header.started_utc, &other = after.header.started_utc;
  if (has_time(before.header) && has_time(after.header) && other < began)
    found.push_back(
        notice(NoticeCode::runs_in_reverse_order, "", {{"before", began}, {"after", other}}));
  const auto a = travel_of(before), b = travel_of(after);
  if (std::abs(a.first - b.first) > kSameEnd_m || std::abs(a.second - b.second) > kSameEnd_m)
    found.push_back(notice(NoticeCode::travel_differs, "",
                           {{"before_from_mm", to_mm(a.first)},
                            {"before_to_mm", to_mm(a.second)},
                            {"after_from_mm", to_mm(b.first)},
                            {"after_to_mm", to_mm(b.second)}}));
  const Provenance &of_a = before.header.provenance, &of_b = after.header.provenance;
  if (result_content(of_a.rig_text) != result_content(of_b.rig_text))
    found.push_back(notice(NoticeCode::rigs_differ));
  if (of_a.model != of_b.model)
    found.push_back(
        notice(NoticeCode::models_differ, "", {{"before", of_a.model}, {"after", of_b.model}}));
  if (const std::string why = algo::readings_in_common(before, after); !why.empty())
    found.push_back(notice(NoticeCode::readings_in_common, "", {{"reason", why}}));
  return found;
}

// Error: no figure exists in both runs.
Status add_figures(Comparison& found, const std::vector<Budget>& before,
                   const std::vector<Budget>& after) {
  for (const Budget& budget : before)
    if (const Budget* other = find_budget(after, budget.figure))
      found.figures.push_back(compared(budget, *other));
  if (!found.figures.empty()) return {};
  return bad_input("runs " + std::to_string(found.before) + " and " + std::to_string(found.after) +
                   " cannot be compared, because no result has a value in both runs");
}

void add_change_at_targets(Comparison& found) {
  for (ComparedFigure& figure : found.figures) {
    figure.at_targets = change_at_targets(figure.before, figure.after, found.points);
    if (figure.effect == Effect::not_shown && figure.at_targets > figure.before.U + figure.after.U)
      figure.effect = Effect::changed;
  }
}

// Error: a run is not imported, or contains another error than positioning.
Status check_positioning(const Run& before, const Run& after) {
  for (const Run* run : {&before, &after}) {
    const std::string name = "run " + std::to_string(run->header.id);
    if (!is_imported(run->header))
      return bad_input(name +
                       " was measured with probes, but the other run is imported; compare two "
                       "measured runs, or two imported runs of positioning errors");
    if (run->header.provenance.model != positioning_name(run->header.axis))
      return bad_input(name + " was imported as " + run->header.provenance.model +
                       "; mdof compares imported runs only if they contain positioning errors (" +
                       positioning_name(run->header.axis) + ")");
  }
  return {};
}

Result<Comparison> compare_positioning(store::Store& store, const Run& before, const Run& after) {
  MDOF_CHECK(check_positioning(before, after));
  Comparison found;
  found.before = before.header.id;
  found.after = after.header.id;
  found.axis = before.header.axis;
  found.is_imported = true;
  found.differences = differences(before, after);
  found.simulated = before.header.simulated || after.header.simulated;
  MDOF_TRY(BuiltTable first, calculate_table(store, imported_table_request(before, after)));
  MDOF_TRY(BuiltTable second, calculate_table(store, imported_table_request(after, before)));
  append(found.notices, std::move(first.notices));
  append(found.notices, std::move(second.notices));
  const TabledRun a{before, first.table}, b{after, second.table};
  const auto figures_of = has_unknown_approach(before) || has_unknown_approach(after)
                              ? positioning_range
                              : positioning_figures;
  MDOF_CHECK(add_figures(found, figures_of(before).budgets, figures_of(after).budgets));
  found.points = compared_points(a, b);
  add_change_at_targets(found);
  if (found.points.points.empty())
    found.no_points_reason = "the runs have no target in common (within 0.1 mm)";
  return found;
}

// Calculates a table of each run, for the comparison at the targets. If no table can be calculated,
// the figures are still compared.
void add_points(store::Store& store, const Run& before, const Run& after, Reference reference,
                Comparison& found) {
  TableRequest request;
  request.partial = true;
  request.reference = reference;
  request.runs = {before.header.id};
  const auto first = calculate_table(store, request);
  request.runs = {after.header.id};
  const auto second = calculate_table(store, request);
  if (!first || !second) {
    found.no_points_reason = (first ? second : first).error().message;
    return;
  }
  found.points = compared_points({before, first->table}, {after, second->table});
  if (found.points.points.empty())
    found.no_points_reason = "the runs have no target in common (within 0.1 mm)";
}

}  // namespace

const char* to_string(Effect effect) {
  switch (effect) {
    case Effect::reduced:
      return "reduced";
    case Effect::increased:
      return "increased";
    case Effect::changed:
      return "changed";
    case Effect::unknown:
      return "unknown";
    case Effect::not_shown:
      break;
  }
  return "not shown";
}

Result<Comparison> compare_runs(store::Store& store, const ComparisonRequest& request) {
  if (request.before == request.after)
    return bad_input("run " + std::to_string(request.before) +
                     " is given twice; give two different runs of the same axis");
  MDOF_TRY(const Run before, store.run(request.before));
  MDOF_TRY(const Run after, store.run(request.after));
  if (before.header.axis != after.header.axis)
    return bad_input("run " + std::to_string(request.before) + " measures axis " +
                     letter(before.header.axis) + ", but run " + std::to_string(request.after) +
                     " measures axis " + letter(after.header.axis) +
                     "; compare two runs of the same axis");
  if (is_imported(before.header) || is_imported(after.header))
    return compare_positioning(store, before, after);
  MDOF_TRY(auto first, run_budgets(store, {request.before, request.reference, "", {}, {}}));
  MDOF_TRY(auto second, run_budgets(store, {request.after, request.reference, "", {}, {}}));
  Comparison found;
  found.before = request.before;
  found.after = request.after;
  found.axis = before.header.axis;
  found.stated = first.stated;
  found.differences = differences(before, after);
  found.notices = std::move(first.notices);
  found.simulated = first.simulated || second.simulated;
  MDOF_CHECK(add_figures(found, first.budgets, second.budgets));
  add_points(store, before, after, request.reference, found);
  add_change_at_targets(found);
  append(found.notices, std::move(second.notices));
  MDOF_TRY(Notices of_table, check_run_notices(store, request.after));
  append(found.notices, std::move(of_table));
  return found;
}

Covers covers(const Comparison& c) {
  std::vector<Budget> changes;
  for (const ComparedFigure& figure : c.figures) changes.push_back(figure.change);
  return covers(changes);
}

std::string comparison_json(const Comparison& c) {
  JsonWriter json;
  json.begin_object()
      .field("axis", std::string(1, letter(c.axis)))
      .field("before", c.before)
      .field("after", c.after);
  if (!c.is_imported) write_reference(json, c.stated);
  json.field("coverage", 0.95).field("simulated", c.simulated);
  write_covers(json, covers_text(c), c.figures.front().change.not_declared);
  json.key("figures").begin_object();
  for (const ComparedFigure& figure : c.figures) {
    json.key(figure.change.figure).begin_object();
    for (const auto& [key, budget] : {std::pair{"before", &figure.before},
                                      {"after", &figure.after},
                                      {"change", &figure.change}}) {
      json.key(key).begin_object();
      write_stated_members(json, *budget);
      json.end_object();
    }
    json.field("change_at_targets", to_key_unit(figure.at_targets))
        .field("effect", to_string(figure.effect))
        .end_object();
  }
  json.end_object();
  write_compared_points(json, c.points);
  if (!c.no_points_reason.empty()) json.field("points_reason", c.no_points_reason);
  Notices notices = c.differences;
  append(notices, c.notices);
  write_notices(json, "notices", notices, words::text);
  json.end_object();
  return json.take();
}

}  // namespace mdof::daemon
