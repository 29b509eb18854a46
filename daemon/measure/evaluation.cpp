#include "daemon/measure/evaluation.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "algo/compensation/compensation.h"
#include "algo/compensation/declared_uncertainty.h"
#include "algo/compensation/imported_table.h"
#include "algo/compensation/residuals/residuals.h"
#include "algo/iso230/squareness_lines.h"
#include "algo/iso230/straightness.h"
#include "algo/model/restate.h"
#include "algo/sequence/usable_runs.h"
#include "algo/uncertainty/budget/two_runs.h"
#include "daemon/history.h"
#include "daemon/measure/gate/added_table.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/measure/machine/volumetric.h"
#include "daemon/paths.h"
#include "daemon/words/error_text.h"
#include "daemon/words/words.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/imported/series.h"
#include "schema/iso230/iso230_json.h"

namespace mdof::daemon {

Result<Rig> rig_of(const RunHeader& run) {
  MDOF_CHECK(check_measured(run, "this"));
  const std::string of = run.id == 0 ? "the run" : "run " + std::to_string(run.id);
  MDOF_TRY(Rig rig, parse_rig(run.provenance.rig_text, of + " (its rig)"));
  if (rig.machine.known() || run.provenance.configuration.empty()) return rig;
  MDOF_TRY(auto configuration,
           TomlTable::parse(run.provenance.configuration, of + " (its mdofd.toml)"));
  rig.machine = read_machine(configuration);
  return rig;
}

namespace {

Result<Run> run_at_reference(Run stored, Reference reference) {
  if (reference != Reference::tool) return algo::restate(std::move(stored), {reference, {}});
  MDOF_TRY(const Rig rig, rig_of(stored.header));
  MDOF_TRY(const StatedAt at, stated_at(rig, reference));
  return algo::restate(std::move(stored), at);
}

}  // namespace

Result<Run> restated_run(store::Store& store, std::int64_t run, Reference reference) {
  MDOF_TRY(Run stored, store.run(run));
  return run_at_reference(std::move(stored), reference);
}

Result<Run> restated_points(store::Store& store, std::int64_t run, std::int64_t offset,
                            std::int64_t count, Reference reference) {
  Run page;
  MDOF_TRY(page.header, store.run_header(run));
  MDOF_TRY(page.points, store.points(run, 0, 1));
  MDOF_TRY(auto asked, store.points(run, offset, count));
  std::move(asked.begin(), asked.end(), std::back_inserter(page.points));
  return run_at_reference(std::move(page), reference);
}

namespace {

// Notices of a table of these runs: the notices of each run, and the notices that compare the runs.
Result<Notices> table_notices(const std::vector<Run>& runs) {
  Notices notices = algo::inherited_notices(algo::all_of(runs));
  if (runs.size() < 2) return notices;
  MDOF_TRY(Notices differences, differences_of_runs(runs));
  append(notices, std::move(differences));
  return notices;
}

constexpr std::size_t kMostRuns = 64;
// All points are in memory at the same time (about 150 MB).
constexpr std::int64_t kMostPoints = 200'000;

// Checks the runs before their points are read. Rejects a run that is given twice, too many runs,
// and runs with too many points.
Status check_table_runs(store::Store& store, const std::vector<std::int64_t>& runs) {
  if (runs.size() > kMostRuns)
    return fail(ErrorCode::usage,
                "at most " + std::to_string(kMostRuns) + " runs are allowed for a table, but " +
                    std::to_string(runs.size()) + " runs are given; give fewer runs");
  const std::set<std::int64_t> different(runs.begin(), runs.end());
  if (different.size() < runs.size())
    return bad_input(
        "a run is given twice, and readings that count twice make the uncertainty too small; give "
        "each run once");
  std::int64_t points = 0;
  for (const std::int64_t run : runs) {
    MDOF_TRY(const std::int64_t of_run, store.count_points(run));
    points += of_run;
  }
  if (points <= kMostPoints) return {};
  return bad_input("these runs have a total of " + std::to_string(points) +
                   " points (limit of a table: " + std::to_string(kMostPoints) +
                   "); leave some runs out");
}

}  // namespace

Status store_table(store::Store& store, CompensationTable& table,
                   const std::optional<HistoryEntry>& action) {
  table.created_utc = utc_now();
  table.sha256 = table_sha256(table);
  MDOF_TRY(table.id, store.add_table(table, action));
  return {};
}

namespace {

// Builds a table from imported runs. The caller has checked that the first run is imported.
Result<BuiltTable> build_positioning(store::Store& store, const TableRequest& request) {
  std::vector<Run> runs;
  for (const std::int64_t id : request.runs) {
    MDOF_TRY(Run run, store.run(id));
    runs.push_back(std::move(run));
  }
  MDOF_TRY(CompensationTable table, algo::build_positioning_table(runs, request.against_command));
  MDOF_CHECK(algo::check_limits(table, request.limits));
  Notices notices = algo::inherited_notices(algo::all_of(runs));
  append(notices, algo::positioning_notices(runs));
  return BuiltTable{std::move(table), std::move(notices), doubtful_notices(runs)};
}

// The newest table of positioning errors of the axis that was built before, from other runs.
Result<std::optional<std::int64_t>> earlier_positioning(store::Store& store,
                                                        const CompensationTable& table) {
  constexpr std::int64_t kPage = 50;
  for (std::int64_t offset = 0;; offset += kPage) {
    MDOF_TRY(const auto tables, store.list_tables(offset, kPage, table.axis));
    if (tables.empty()) return std::nullopt;
    for (const CompensationTable& earlier : tables)
      if (earlier.has_positioning() && earlier.runs != table.runs) return std::optional(earlier.id);
  }
}

}  // namespace

Result<BuiltTable> build_table(store::Store& store, const TableRequest& request) {
  MDOF_TRY(BuiltTable built, calculate_table(store, request));
  if (built.table.has_positioning()) {
    MDOF_TRY(const auto earlier, earlier_positioning(store, built.table));
    if (earlier)
      built.notices.push_back(
          notice(NoticeCode::perhaps_measured_with_table, "", {{"table", *earlier}}));
  }
  MDOF_CHECK(store_table(store, built.table, request.action));
  return built;
}

Result<BuiltTable> calculate_table(store::Store& store, const TableRequest& asked) {
  MDOF_CHECK(check_table_runs(store, asked.runs));
  TableRequest request = asked;
  std::optional<CompensationTable> applied;
  if (asked.add_to) {
    MDOF_TRY(applied, applied_table(store, request));
  }
  if (!request.runs.empty()) {
    MDOF_TRY(const RunHeader first, store.run_header(request.runs.front()));
    if (is_imported(first)) return build_positioning(store, request);
  }
  std::vector<Run> runs;
  std::vector<Rig> rigs;
  algo::TableOptions options;
  options.remove_slope = !request.keep_slope;
  options.take_partial = request.partial;
  for (const std::int64_t id : request.runs) {
    MDOF_TRY(Run run, store.run(id));
    MDOF_TRY(const Rig rig, rig_of(run.header));
    MDOF_TRY(const StatedAt at, request.reference ? stated_at(rig, *request.reference)
                                                  : Result<StatedAt>(default_reference(rig)));
    if (!runs.empty() && (rig.machine != options.machine || at != options.stated))
      return bad_input(
          "the rigs of runs " + std::to_string(request.runs.front()) + " and " +
          std::to_string(id) +
          " differ in [machine] or in tool_point_mm; build a table from runs of one set-up");
    options.machine = rig.machine;
    options.stated = at;
    runs.push_back(std::move(run));
    rigs.push_back(rig);
  }
  MDOF_TRY(CompensationTable table, algo::build_table(runs, options));
  const Status declared = algo::add_declared_uncertainty(table, rigs, runs, options);
  for (const Rig& rig : rigs) add_declarations(table, rig);
  if (applied) MDOF_CHECK(algo::add_applied(*applied, table));
  MDOF_CHECK(algo::check_limits(table, request.limits));
  MDOF_TRY(Notices notices, table_notices(runs));
  MDOF_TRY(Notices of_runs, source_run_notices(store, request.runs, table.added_to));
  append(notices, std::move(of_runs));
  if (applied) {
    MDOF_TRY(Notices added, added_notices(store, table));
    append(notices, std::move(added));
    notices.push_back(statement_of_sum(table));
  }
  if (!declared)
    notices.push_back(
        notice(NoticeCode::declared_not_in_u, "", {{"reason", words::text(declared.error())}}));
  MDOF_TRY(Notices doubtful, doubtful_notices(store, table));
  return BuiltTable{std::move(table), std::move(notices), std::move(doubtful)};
}

Result<CompensationTable> means_by_target(const Run& run) {
  MDOF_TRY(const Rig rig, rig_of(run.header));
  algo::TableOptions options;
  options.remove_slope = false;
  options.take_partial = true;
  options.machine = rig.machine;
  options.stated = run.header.stated;
  MDOF_TRY(CompensationTable table, algo::build_table({run}, options));
  MDOF_CHECK(algo::add_declared_uncertainty(table, {rig}, {run}, options));
  MDOF_CHECK(algo::join_approaches({run}, options, table));
  add_declarations(table, rig);
  return table;
}

Result<store::Activation> activate_table(store::Store& store, const ActivationRequest& request) {
  MDOF_TRY(const store::Marks marks, check_activation(store, request));
  return activate_checked(store, request, marks);
}

Result<store::Activation> activate_checked(store::Store& store, const ActivationRequest& request,
                                           const store::Marks& marks) {
  MDOF_TRY(const bool volumetric, store.is_volumetric(request.table));
  const std::string actor = actor_text(request.action.by);
  const auto& [table, consent, action, expected] = request;
  MDOF_TRY(auto done, volumetric
                          ? store.change_volumetric(table, actor, action.utc, action, expected)
                          : store.activate(table, actor, action.utc, action, expected));
  done.marks = marks;
  return done;
}

Result<store::Marks> check_activation(store::Store& store, const ActivationRequest& request) {
  MDOF_CHECK(store.check_generation(request.expected_generation));
  MDOF_TRY(const bool volumetric, store.is_volumetric(request.table));
  if (volumetric) return check_volumetric_activation(store, request.table, request.consent);
  MDOF_TRY(const CompensationTable table, store.table(request.table));
  if (table.has_positioning())
    return fail(ErrorCode::conflict,
                "table " + std::to_string(table.id) + " contains " + positioning_name(table.axis) +
                    " and is not activated. An axis can have only one active table, so table " +
                    std::to_string(table.id) +
                    " would replace the table that contains the straightness and the angles. Build "
                    "a table of a plane or a volume from both tables; mdofd then also serves the "
                    "positioning errors. Or let the controller read the positioning errors from a "
                    "file",
                Remedy::export_table);
  MDOF_TRY(const Judged judged, judged_table(store, table));
  const auto now = store.active(table.axis);
  const bool is_active = now && now->table.id == request.table;
  if (!is_active) MDOF_CHECK(check_no_volumetric(store));
  if (!is_active) MDOF_CHECK(check_gate(judged, request.consent, "the table is not activated"));
  return store::Marks{judged.simulated, !judged.doubtful.empty()};
}

Status store_squareness(store::Store& store, Squareness& squareness,
                        const std::optional<HistoryEntry>& action) {
  MDOF_TRY(const auto before, store.squareness_of(squareness.run_a, squareness.run_b));
  for (const Squareness& stored : before) {
    squareness.id = stored.id;
    squareness.created_utc = stored.created_utc;
    if (squareness == stored) return {};
  }
  squareness.created_utc = utc_now();
  MDOF_TRY(squareness.id, store.add_squareness(squareness, action));
  return {};
}

namespace {

// Sets the combined standard uncertainties in `s`.
Result<std::vector<Budget>> state_uncertainty(Squareness& s, const Run& a, const Rig& rig_a,
                                              const Run& b, const Rig& rig_b,
                                              const algo::StatedPair& at = {}) {
  MDOF_TRY(auto budgets, algo::squareness_and_slope_budgets(rig_a, a, rig_b, b, s.artefact, at));
  budgets[0].value = s.error_rad;  // a stored value may be from an older version
  s.u_error_rad = budgets[0].u;
  s.u_slope_a_rad = budgets[1].u;
  s.u_slope_b_rad = budgets[2].u;
  return std::vector(std::make_move_iterator(budgets.begin()),
                     std::make_move_iterator(budgets.end()));
}

Status check_axes(const SquarenessRequest& request, const Run& a, const Run& b) {
  if (!request.axes) return {};
  const std::pair<const Run*, Axis> asked[] = {{&a, request.axes->a}, {&b, request.axes->b}};
  for (const auto& [run, axis] : asked)
    if (run->header.axis != axis)
      return bad_input("run " + std::to_string(run->header.id) + " measures axis " +
                       letter(run->header.axis) + ", not axis " + letter(axis) +
                       "; give a run of axis " + letter(axis));
  return {};
}

}  // namespace

namespace {

Result<Notices> squareness_notices(store::Store& store, const Run& a, const Run& b) {
  Notices notices = algo::inherited_notices({&a, &b});
  MDOF_TRY(Notices of_runs, source_run_notices(store, {a.header.id, b.header.id}));
  append(notices, std::move(of_runs));
  return notices;
}

}  // namespace

Result<FittedSquareness> fit_squareness(store::Store& store, const SquarenessRequest& request) {
  MDOF_TRY(FittedSquareness fitted, calculate_squareness(store, request));
  MDOF_CHECK(store_squareness(store, fitted.squareness, request.action));
  return fitted;
}

Result<SquarenessRuns> squareness_runs(store::Store& store, const SquarenessRequest& request) {
  MDOF_TRY(Run a, store.run(request.run_a));
  MDOF_TRY(Run b, store.run(request.run_b));
  MDOF_CHECK(check_axes(request, a, b));
  MDOF_TRY(Rig rig_a, rig_of(a.header));
  MDOF_TRY(Rig rig_b, rig_of(b.header));
  if (const auto pair = algo::pair_of(a, b); !pair) return tl::unexpected(pair.error());
  MDOF_TRY(const SquareArtefact artefact, algo::combined_artefact(rig_a, rig_b, request.given));
  MDOF_TRY(Squareness fitted, algo::squareness(a, b, artefact, request.partial));
  return SquarenessRuns{std::move(a), std::move(b), std::move(rig_a), std::move(rig_b),
                        std::move(fitted)};
}

Result<FittedSquareness> calculate_squareness(store::Store& store,
                                              const SquarenessRequest& request) {
  MDOF_TRY(SquarenessRuns of, squareness_runs(store, request));
  MDOF_TRY(auto budgets, state_uncertainty(of.fitted, of.a, of.rig_a, of.b, of.rig_b));
  MDOF_TRY(Notices notices, squareness_notices(store, of.a, of.b));
  return FittedSquareness{std::move(of.fitted), std::move(budgets), std::move(notices)};
}

Result<FittedSquareness> stored_squareness(store::Store& store, Squareness squareness,
                                           const algo::StatedPair& at) {
  MDOF_TRY(const Run a, store.run(squareness.run_a));
  MDOF_TRY(const Run b, store.run(squareness.run_b));
  MDOF_TRY(const Rig rig_a, rig_of(a.header));
  MDOF_TRY(const Rig rig_b, rig_of(b.header));
  if (at != algo::StatedPair{}) {
    MDOF_TRY(const Squareness there, algo::squareness(a, b, squareness.artefact, true, at));
    squareness.error_rad = there.error_rad;
    squareness.slope_a_rad = there.slope_a_rad;
    squareness.slope_b_rad = there.slope_b_rad;
    squareness.form_rad = there.form_rad;
  }
  MDOF_TRY(auto budgets, state_uncertainty(squareness, a, rig_a, b, rig_b, at));
  MDOF_TRY(Notices notices, squareness_notices(store, a, b));
  return FittedSquareness{std::move(squareness), std::move(budgets), std::move(notices)};
}

std::string run_document(const RunMembers& members, const std::string& result_sha256,
                         const std::vector<HistoryEntry>& actions) {
  JsonWriter json;
  json.begin_object();
  write_run_members(json, members, words::text);
  json.key("straightness_lines");
  write_straightness_lines(
      json, algo::straightness_lines(members.run.header.moving(), members.run.points));
  json.field("result_sha256", result_sha256).key("history");
  write_actions(json, actions);
  json.end_object();
  return json.take();
}

Result<SquarenessByLine> squareness_by_reference_line(store::Store& store,
                                                      const Squareness& squareness) {
  MDOF_TRY(const Run a, store.run(squareness.run_a));
  MDOF_TRY(const Run b, store.run(squareness.run_b));
  return algo::squareness_lines(a, b, squareness);
}

std::string squareness_document(const FittedSquareness& fitted, const SquarenessByLine& lines) {
  const auto& [squareness, budgets, notices] = fitted;
  JsonWriter json;
  json.begin_object();
  write_squareness_members(json, squareness, budgets);
  write_notices(json, "notices", notices, words::text);
  json.key("lines");
  write_squareness_lines(json, squareness, lines);
  json.end_object();
  return json.take();
}

}  // namespace mdof::daemon
