// The methods run.analyse, run.budget, run.compare, run.trend, squareness.budget and
// parallelism.fit.
#include "daemon/measure/budgets.h"

#include "daemon/measure/analysis/analysis.h"
#include "daemon/measure/several_runs/comparison.h"
#include "daemon/measure/several_runs/trends_json.h"
#include "daemon/methods/methods.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;

// With this number of points, the calculation takes about 0.2 s (0.02 s with 110 points).
constexpr std::int64_t kMostPoints = 5'000;

// Limits the time of a call on the thread "query", because other clients wait for this thread.
Status check_size(store::Store& store, std::int64_t run) {
  MDOF_TRY(const std::int64_t points, store.count_points(run));
  if (points <= kMostPoints) return {};
  return bad_input("run " + std::to_string(run) + " has " + std::to_string(points) +
                       " points (limit for a budget in one call: " + std::to_string(kMostPoints) +
                       ")",
                   Remedy::budget_run);
}

Result<QueryThread::Work> analyse_run(Methods&, const Params& params) {
  MDOF_TRY(const Reference reference, reference_param(params));
  return [id = params.integer("run"), reference](store::Store& store) -> Result<std::string> {
    MDOF_TRY(const std::int64_t points, store.count_points(id));
    if (points > kMostPoints)
      return bad_input("run " + std::to_string(id) + " has " + std::to_string(points) +
                           " points (limit of one call: " + std::to_string(kMostPoints) + ")",
                       Remedy::analyse_run);
    MDOF_TRY(const Run run, restated_run(store, id, reference));
    return analysis_document(store, run);
  };
}

Result<QueryThread::Work> run_budget(Methods&, const Params& params) {
  RunBudgetsRequest request;
  request.run = params.integer("run");
  request.figure = params.string("figure");
  if (params.has("at_mm")) request.at_m = from_mm(params.number("at_mm"));
  MDOF_TRY(request.reference, reference_param(params));
  return [request](store::Store& store) -> Result<std::string> {
    MDOF_CHECK(check_size(store, request.run));
    MDOF_TRY(const FoundBudgets found, run_budgets(store, request));
    return budgets_json(found);
  };
}

Result<QueryThread::Work> squareness_budget(Methods&, const Params& params) {
  MDOF_TRY(const SquarenessRequest request, squareness_param(params));
  return [request](store::Store& store) -> Result<std::string> {
    MDOF_CHECK(check_size(store, request.run_a));
    MDOF_CHECK(check_size(store, request.run_b));
    MDOF_TRY(const FoundBudgets found, squareness_budgets(store, request, {}));
    return budgets_json(found);
  };
}

Result<QueryThread::Work> parallelism(Methods&, const Params& params) {
  const ParallelismRequest request{params.integer("run_a"), params.integer("run_b"),
                                   params.boolean("partial", false)};
  return [request](store::Store& store) -> Result<std::string> {
    MDOF_CHECK(check_size(store, request.run_a));
    MDOF_CHECK(check_size(store, request.run_b));
    MDOF_TRY(const FoundParallelism found, find_parallelism(store, request));
    return parallelism_json(found);
  };
}

Result<QueryThread::Work> compare(Methods&, const Params& params) {
  ComparisonRequest request{params.integer("before"), params.integer("after"), {}};
  MDOF_TRY(request.reference, reference_param(params));
  return [request](store::Store& store) -> Result<std::string> {
    MDOF_CHECK(check_size(store, request.before));
    MDOF_CHECK(check_size(store, request.after));
    MDOF_TRY(const Comparison found, compare_runs(store, request));
    return comparison_json(found);
  };
}

Result<QueryThread::Work> trend(Methods&, const Params& params) {
  TrendRequest request;
  if (params.has("axis")) {
    MDOF_TRY(request.axis, axis_param(params));
  }
  request.figure = params.string("figure");
  request.baseline = static_cast<std::size_t>(params.integer("baseline"));
  request.mixed = params.boolean("mixed");
  if (params.has("without")) {
    MDOF_TRY(request.without, params.integers("without"));
  }
  return [request](store::Store& store) -> Result<std::string> {
    MDOF_TRY(const auto found, trends(store, request));
    return trends_json(found);
  };
}

}  // namespace

void add_budget_methods(rpc::MethodTable& table, Methods& m) {
  const rpc::Param reference{"reference", ParamType::string,
                             "reference point of the errors: fixture, carriage or tool", false,
                             "\"fixture\""};
  table.add(
      {.name = "run.analyse",
       .summary = "Calculates the results of a run: the straightness for each reference line, the "
                  "angles, the uncertainty of each result, and the drift.",
       .params = {{"run", ParamType::integer, "id of the run", true}, reference},
       .members =
           "{run, axis, model, simulated, superseded_by, ...reference, ...covers, straightness: "
           "{E{linear}{axis}_um?: {{approach}: straightness_figure}}, straightness_lines: "
           "{E{linear}{axis}_um?: {{approach}: lines}}, angles: {E{angular}{axis}_urad?: "
           "{{approach}: angle_figure}}, ...stated_figures, drift: {significant, not_seen: string, "
           "length_s, level: number, errors: {E{linear}{axis}_um?: drift_series, "
           "E{angular}{axis}_urad?: drift_series}, probes: {*: drift_series}, closures: [{run: "
           "integer, after_s, same_side, ...errors}], straightness_without: {E{linear}{axis}_um?: "
           "{{approach}: straightness_figure}}}}",
       .example = R"({"run": 1})",
       .handler = on_query(m, analyse_run)});
  table.add(
      {.name = "run.budget",
       .summary =
           "Calculates the uncertainty budget of one result of a run, such as a straightness.",
       .params = {{"run", ParamType::integer, "id of the run", true},
                  {"figure", ParamType::string,
                   "name of the result, such as EYX_straightness_um, EYX_slope_urad or "
                   "EAX_range_urad; if at_mm is given, the name of an error, such as EYX_um",
                   true},
                  {"at_mm", ParamType::number,
                   "position of the error; mdofd uses the target nearest to this position", false},
                  reference},
       .members = "budgets",
       .example = R"({"run": 1, "figure": "EYX_straightness_um"})",
       .handler = on_query(m, run_budget)});
  table.add(
      {.name = "run.compare",
       .summary = "Compares the results of two runs of one axis: a run before and a run after a "
                  "compensation.",
       .params = {{"before", ParamType::integer, "id of the run before the compensation", true},
                  {"after", ParamType::integer, "id of the run after the compensation", true},
                  reference},
       .result = "two imported runs of positioning errors have the figures E, E_forward, E_reverse "
                 "and B of ISO 230-2. Notices state whether the travel, the rig or the model of "
                 "the two runs differs",
       .members = "{axis, before: integer, after: integer, ...reference?, coverage, simulated, "
                  "...covers, figures: {{figure}: {before: stated, after: stated, change!: stated, "
                  "effect, change_at_targets}}, points: [{position_mm: number, forward: "
                  "compared_errors, reverse: "
                  "compared_errors, reversal: compared_errors}], points_reason?, ...notices}",
       .example = R"({"before": 1, "after": 2})",
       .handler = on_query(m, compare)});
  table.add(
      {.name = "run.trend",
       .summary =
           "Calculates control charts (Shewhart) of the results of the stored runs over time.",
       .params =
           {{"axis", ParamType::string,
             "X, Y or Z: only results of this axis [all axes, and squareness]"},
            {"figure", ParamType::string,
             "only this result, such as EYX_straightness_um or EC0Y_urad [all results]"},
            {"baseline",
             ParamType::integer,
             "number of oldest values from which the control limits are calculated [all values "
             "except the newest]",
             false,
             {},
             {.least = algo::kLeastBaselineValues, .most = 100'000}},
            {"mixed", ParamType::boolean,
             "also use runs with other rigs, models or evaluation options", false, "false"},
            {"without", ParamType::array,
             "ids of runs that are left out, for example a run with a known fault of the set-up"}},
       .members = "{reference, figures: {{figure}?: {values: [{runs: [integer], started_utc, "
                  "...stated, low, high, signal}], centre, sigma, baseline, moved: "
                  "{since_runs, by, u_by}, ...covers, left_out: [string], ...notices}}}",
       .example = R"({"figure": "EYX_straightness_um"})",
       .handler = on_query(m, trend)});
  table.add({.name = "squareness.budget",
             .summary =
                 "Calculates the uncertainty budget of the squareness of two axes (EC0Y, EB0Z or "
                 "EA0Z) from a run along each axis. The rigs state the angle of the artefact.",
             .params = squareness_params(),
             .members = "budgets",
             .example = R"({"run_x": 1, "run_y": 2})",
             .handler = on_query(m, squareness_budget)});
  table.add(
      {.name = "parallelism.fit",
       .summary = "Calculates the parallelism of two motions along one axis (ISO 230-1): the angle "
                  "between the reference lines of the two straightness errors. The result contains "
                  "uncertainty budgets. Nothing is stored.",
       .params = {{"run_a", ParamType::integer, "id of the reference run (datum)", true},
                  {"run_b", ParamType::integer,
                   "id of the run that is compared with run_a; both runs are along the same axis",
                   true},
                  {"partial", ParamType::boolean, "also accept partial runs", false, "false"}},
       .members =
           "{axis, run_a, run_b, ...reference, from_mm, to_mm, simulated, parallelism: "
           "{E{linear}{axis}: {end_point: parallel_line, least_squares: parallel_line, "
           "minimum_zone: parallel_line}}, ...covers, figures: {{figure}: budget}, ...notices}",
       .example = R"({"run_a": 1, "run_b": 2})",
       .handler = on_query(m, parallelism)});
}

}  // namespace mdof::daemon
