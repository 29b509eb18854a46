#include "daemon/measure/several_runs/comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "daemon/words/words.h"
#include "schema/axis.h"
#include "schema/base/json_writer.h"
#include "schema/notice/notice_json.h"
#include "schema/run_json.h"
#include "schema/uncertainty/budget_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr double kSameEnd_m = 1e-4;

ComparedFigure compared(const Budget& before, const Budget& after) {
  ComparedFigure figure{before, after, {}, Effect::not_shown};
  Budget& change = figure.change;
  change.figure = before.figure;
  change.value = std::abs(after.value) - std::abs(before.value);
  change.u_random = std::hypot(before.u_random, after.u_random);
  change.is_single_run = before.is_single_run || after.is_single_run;
  change.not_declared = before.not_declared;
  for (const std::string& key : after.not_declared)
    if (std::find(change.not_declared.begin(), change.not_declared.end(), key) ==
        change.not_declared.end())
      change.not_declared.push_back(key);
  for (const Budget* of : {&before, &after}) {
    BudgetLine line;
    line.name = of == &before ? "before" : "after";
    line.distribution = "t";
    line.contribution = of->u;
    line.freedom = of->freedom;
    change.lines.push_back(line);
  }
  algo::complete(change);
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

// What a figure depends on and need not be the same in both.
Notices differences(const Run& before, const Run& after) {
  Notices found;
  const auto a = travel_of(before), b = travel_of(after);
  if (std::abs(a.first - b.first) > kSameEnd_m || std::abs(a.second - b.second) > kSameEnd_m)
    found.push_back(notice(NoticeCode::travel_differs, "",
                           {{"before_from_mm", to_mm(a.first)},
                            {"before_to_mm", to_mm(a.second)},
                            {"after_from_mm", to_mm(b.first)},
                            {"after_to_mm", to_mm(b.second)}}));
  const Provenance &of_a = before.header.provenance, &of_b = after.header.provenance;
  if (of_a.rig_text != of_b.rig_text) found.push_back(notice(NoticeCode::rigs_differ));
  if (of_a.model != of_b.model)
    found.push_back(
        notice(NoticeCode::models_differ, "", {{"before", of_a.model}, {"after", of_b.model}}));
  return found;
}

}  // namespace

const char* to_string(Effect effect) {
  switch (effect) {
    case Effect::reduced:
      return "reduced";
    case Effect::increased:
      return "increased";
    case Effect::not_shown:
      break;
  }
  return "not shown";
}

Result<Comparison> compare_runs(store::Store& store, const ComparisonRequest& request) {
  if (request.before == request.after)
    return fail(ErrorCode::usage, "run " + std::to_string(request.before) +
                                      " is given twice; give two different runs of one axis");
  MDOF_TRY(const Run before, store.run(request.before));
  MDOF_TRY(const Run after, store.run(request.after));
  if (before.header.axis != after.header.axis)
    return bad_input("run " + std::to_string(request.before) + " measures axis " +
                     letter(before.header.axis) + " and run " + std::to_string(request.after) +
                     " axis " + letter(after.header.axis) + "; compare two runs of one axis");
  MDOF_TRY(auto first, run_budgets(store, {request.before, request.reference, "", {}, {}}));
  MDOF_TRY(auto second, run_budgets(store, {request.after, request.reference, "", {}, {}}));
  Comparison found{request.before,
                   request.after,
                   before.header.axis,
                   first.stated,
                   {},
                   differences(before, after),
                   std::move(first.notices),
                   first.simulated || second.simulated};
  for (const Budget& budget : first.budgets)
    if (const Budget* other = find_budget(second.budgets, budget.figure))
      found.figures.push_back(compared(budget, *other));
  if (found.figures.empty())
    return bad_input("runs " + std::to_string(request.before) + " and " +
                     std::to_string(request.after) +
                     " cannot be compared, because no figure has a value in both runs");
  for (Notice& notice : second.notices) found.notices.push_back(std::move(notice));
  return found;
}

std::string comparison_json(const Comparison& c) {
  JsonWriter json;
  json.begin_object()
      .field("axis", std::string(1, letter(c.axis)))
      .field("before", c.before)
      .field("after", c.after);
  write_reference(json, c.stated);
  json.field("coverage", 0.95).field("simulated", c.simulated);
  std::vector<Budget> changes;
  for (const ComparedFigure& figure : c.figures) changes.push_back(figure.change);
  write_covers(json, changes);
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
    json.field("effect", to_string(figure.effect)).end_object();
  }
  json.end_object();
  Notices notices = c.differences;
  append(notices, c.notices);
  write_notices(json, "notices", notices, words::text);
  json.end_object();
  return json.take();
}

}  // namespace mdof::daemon
