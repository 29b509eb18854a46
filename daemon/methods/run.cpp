// The methods run.start, run.resume, run.stop, run.list, run.get and run.points.
#include <algorithm>
#include <cmath>
#include <memory>

#include "daemon/measure/budgets.h"
#include "daemon/measure/configuration/sources.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/imported/imported_run.h"
#include "daemon/measure/imported/positioning_figures.h"
#include "daemon/methods/methods.h"
#include "daemon/methods/run_pages.h"
#include "daemon/methods/run_replies.h"
#include "daemon/paths.h"
#include "daemon/rpc/params/list_page.h"
#include "daemon/run_item.h"
#include "daemon/station/resume.h"
#include "daemon/words/error_text.h"
#include "daemon/words/words.h"
#include "schema/base/append_new.h"
#include "schema/base/json_page.h"
#include "schema/base/number/number_text.h"
#include "schema/imported/series.h"
#include "schema/plausibility/plausibility_json.h"
#include "schema/run_json.h"
#include "schema/targets.h"
#include "schema/uncertainty/budget_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::count_param;
using rpc::offset_param;
using rpc::Params;
using rpc::ParamType;
using rpc::Reply;

constexpr std::int64_t kMaxPointsPage = 100;
// If the matrix n_ij (plausibility.h) has more values, the reply does not contain the matrix.
constexpr std::size_t kMaxVisits = 1500;
constexpr std::int64_t kMaxRunsPage = 100;
// All points are read for the figures; this takes about 0.3 s.
constexpr std::int64_t kMaxRunPoints = 100'000;
constexpr std::size_t kMaxTargets = 1500;  // the reply contains all targets in one line
constexpr double kFarthestTarget_mm = 10e3;

// Reads the targets: a list of positions, or equal intervals.
Result<std::vector<double>> read_targets(const Params& params) {
  if (!params.has("from_mm") && !params.has("to_mm") && !params.has("interval_mm")) {
    for (const char* key : {"jitter_mm", "seed"})
      if (params.has(key))
        return fail(ErrorCode::usage, std::string(key) +
                                          " applies only to targets at equal intervals; leave it "
                                          "out, or give from_mm, to_mm and interval_mm");
    return params.numbers("targets_mm");
  }
  if (params.has("targets_mm"))
    return fail(ErrorCode::usage,
                "targets_mm and an interval (from_mm, to_mm, interval_mm) are both given; give "
                "only one of the two");
  for (const char* key : {"from_mm", "to_mm", "interval_mm"})
    if (!params.has(key))
      return fail(
          ErrorCode::usage,
          std::string(key) + " is missing; give all three of from_mm, to_mm and interval_mm");
  const TargetSpacing spacing{params.number("from_mm"), params.number("to_mm"),
                              params.number("interval_mm"), params.number("jitter_mm", 0),
                              params.integer("seed", 1)};
  if (const auto wrong = check_spacing(spacing))
    return fail(ErrorCode::usage, std::string(wrong->key) + " " + wrong->why);
  return spaced_targets_mm(spacing);
}

Result<RunRequest> read_run_request(const Params& params) {
  RunRequest request;
  request.note = params.string("note");
  request.repeats = static_cast<int>(params.integer("repeats", 0));
  MDOF_TRY(const auto targets_mm, read_targets(params));
  if (targets_mm.size() > kMaxTargets)
    return fail(ErrorCode::usage, "interval_mm gives " + std::to_string(targets_mm.size()) +
                                      " targets (limit " + std::to_string(kMaxTargets) +
                                      "); give a larger interval_mm");
  for (const double target_mm : targets_mm) {
    if (std::abs(target_mm) > kFarthestTarget_mm)
      return fail(ErrorCode::usage, "the target at " + plain_number(target_mm) +
                                        " mm is more than 10 m from zero; give the targets in mm");
    if (!request.targets_m.empty() && from_mm(target_mm) <= request.targets_m.back()) {
      return fail(ErrorCode::usage, "targets_mm must be in ascending order");
    }
    // + 0.0 converts -0 to 0; a replay reads 0.
    request.targets_m.push_back(from_mm(target_mm) + 0.0);
  }
  if (request.repeats > 0 && request.targets_m.empty()) {
    return fail(ErrorCode::usage,
                "\"repeats\" needs targets; give targets_mm, or from_mm, to_mm and interval_mm");
  }
  if (auto hidden = scale_period_notice(targets_mm, params.number("scale_period_um", 0)))
    request.notices.push_back(std::move(*hidden));
  return request;
}

// If the station has several devices: one notice for each whose clock drift is not known yet.
Notices unsettled_clock_notices(const Station& station) {
  const auto devices = station.devices();
  Notices found;
  if (devices.size() < 2) return found;
  for (const auto& device : devices)
    if (device.info.clock && !device.info.clock->settled)
      found.push_back(notice(NoticeCode::clock_not_settled, device.info.name));
  return found;
}

// Notices about troubles of devices at the start of the run. The notices about later troubles are
// added at the end of the run.
Notices present_troubles(const Station& station) {
  Notices found;
  for (const auto& device : station.devices())
    for (const auto& trouble : device.standing)
      found.push_back(notice(NoticeCode::trouble_at_start, trouble.device,
                             {{"kind", to_string(trouble.kind)}, {"reason", trouble.text}}));
  return found;
}

// Notices about settings of devices that affect the readings, such as filters.
Notices device_setting_notices(const Station& station) {
  Notices found;
  for (const auto& device : station.devices())
    for (const Notice& of_device : device.info.notices)
      found.push_back(inherited("device \"" + device.info.name + "\"", of_device));
  return found;
}

// Error: the run has ended, but the end is not stored yet.
Status check_end_is_stored(const Methods& m, std::int64_t run) {
  const std::string why = m.keeper.still_open_reason(run);
  if (why.empty()) return {};
  return fail(ErrorCode::conflict, "run " + std::to_string(run) + " has ended; " + why);
}

// Error: this axis shares its probes with another axis, and a run of the other axis uses the probes
// now.
Status check_probes_free(const Methods& m, const Station& station) {
  for (const auto& other : m.stations) {
    const std::int64_t run = other->run();
    if (other.get() == &station || run == 0) continue;
    const std::string device = shared_probes_device(station.config(), other->config());
    if (device.empty()) continue;
    MDOF_CHECK(check_end_is_stored(m, run));
    return fail(
        ErrorCode::conflict,
        "the probes of device \"" + device + "\" are in use for axis " +
            letter(other->config().rig.axis) + ": " +
            (run > 0 ? "run " + std::to_string(run) + " is under way; stop this run first"
                     : "a run is about to begin, or the axis position is being stored; try again"));
  }
  return {};
}

// Error: two devices provide one channel. The columns of a script are known only when it runs.
Status check_open_sources(const Station& station) {
  return check_no_channel_twice(station.config().rig, open_sources(station.devices()));
}

void begin_run(const Methods& m, Station& station, RunRequest request, Reply reply) {
  if (auto free = check_probes_free(m, station); !free) return reply(tl::unexpected(free.error()));
  if (auto once = check_open_sources(station); !once) return reply(tl::unexpected(once.error()));
  // If the run is resumed, request.notices contains some of these notices already.
  append_new(request.notices, present_troubles(station));
  append_new(request.notices, unsettled_clock_notices(station));
  append_new(request.notices, device_setting_notices(station));
  // The reply contains the notice that the datum is missing. The stored run does not need this
  // notice, because its options contain the kind of its datum. However, the options do not show
  // that the positions now have another zero (offset_mm of the configuration, the zero of the
  // device, the reference mark) than the position that a user had set.
  const EncoderState encoder = station.encoder();
  const bool is_replaced = encoder.notice && encoder.notice->code == NoticeCode::position_lost &&
                           encoder.datum.kind != EncoderDatum::Kind::none;
  if (is_replaced) append_new(request.notices, {*encoder.notice});
  RunRequest told = request;
  if (encoder.notice && !is_replaced) told.notices.push_back(*encoder.notice);
  auto done = answer_with_run(std::move(reply), station.config().rig.axis, told);
  station.start_run(request, done);
}

void start_run(Methods& m, const Params& params, Reply reply) {
  const auto axis = axis_param(params);
  if (!axis) return reply(tl::unexpected(axis.error()));
  const auto station = find_station(m, *axis);
  if (!station) return reply(tl::unexpected(station.error()));
  auto request = read_run_request(params);
  if (!request) return reply(tl::unexpected(request.error()));
  request->action = caller_action(params, "run.start");
  begin_run(m, **station, *request, std::move(reply));
}

void resume_run(Methods& m, const Params& params, Reply reply) {
  const std::int64_t run = params.integer("run");
  if (auto free = check_end_is_stored(m, run); !free) return reply(tl::unexpected(free.error()));
  const auto header = m.reader.run_header(run);
  if (!header) return reply(tl::unexpected(header.error()));
  const auto station = find_station(m, header->axis);
  if (!station) return reply(tl::unexpected(station.error()));
  auto request = request_to_resume(m.reader, run, (*station)->config());
  if (!request) return reply(tl::unexpected(request.error()));
  request->action = caller_action(params, "run.resume");
  begin_run(m, **station, *request, std::move(reply));
}

void stop_run(Methods& m, const Params& params, Reply reply) {
  const std::int64_t id = params.integer("run");
  if (auto free = check_end_is_stored(m, id); !free) return reply(tl::unexpected(free.error()));
  for (auto& station : m.stations) {
    if (id < 1 || station->run() != id) continue;  // 0: no run; -1: a run is about to begin
    const bool abort = params.boolean("abort");
    return station->stop_run(abort, caller_action(params, abort ? "run.abort" : "run.stop"),
                             answer_with_end(m, std::move(reply), station->config().rig.axis));
  }
  reply(fail(ErrorCode::not_found, "run " + std::to_string(id) +
                                       " is not under way; server.info lists the runs under way"));
}

// If the stored state is `open` but the run is not measured any more, sets the state to `ended` and
// adds the reason.
void explain(const Methods& m, RunHeader& header) {
  if (header.state != RunState::open) return;
  std::string why = m.keeper.still_open_reason(header.id);
  if (why.empty()) return;
  header.state = RunState::ended;
  header.notices.push_back(notice(NoticeCode::run_still_open, "", {{"reason", why}}));
}

Result<QueryThread::Work> list_runs(Methods& m, const Params& params) {
  std::optional<Axis> axis;
  if (params.has("axis")) {
    MDOF_TRY(axis, axis_param(params));
  }
  const rpc::ListPage page = read_list_page(params, kMaxRunsPage);
  const RunListRequest request{page.offset, page.count, axis, params.boolean("all", false)};
  return [&m, request](store::Store& store) {
    return run_list_document(store, request, kPageBytes,
                             [&m](RunHeader& header) { explain(m, header); });
  };
}

// Limits the time of a call, because other clients wait. For a run with too many points, no figures
// with uncertainty are calculated.
StatedRun limited_stated_run(const Run& run) {
  // With this number of points, the calculation takes about 0.2 s (0.02 s with 110 points).
  constexpr std::size_t kMostStated = 5'000;
  if (run.points.size() <= kMostStated) return stated_run(run);
  Run beginning = run;
  beginning.points.resize(1);
  return {uncertainty_of(beginning),
          {{},
           "the run has too many points for one call (limit " + std::to_string(kMostStated) +
               "); " + words::remedy(Remedy::analyse_run)}};
}

Result<std::string> whole_run_json(const Methods& m, store::Store& store, std::int64_t id,
                                   Reference reference) {
  MDOF_TRY(const std::int64_t points, store.count_points(id));
  if (points > kMaxRunPoints)
    return bad_input("run " + std::to_string(id) + " has " + std::to_string(points) +
                         " points (limit of one call: " + std::to_string(kMaxRunPoints) + ")",
                     Remedy::show_run, std::to_string(id));
  MDOF_TRY(auto run, restated_run(store, id, reference));
  explain(m, run.header);
  MDOF_TRY(const std::string sha256, store.result_sha256(id));
  MDOF_TRY(const auto actions, store.run_actions(id));
  if (is_imported(run.header)) {
    run = with_positioning_notices(std::move(run));
    const StatedFigures figures = positioning_figures(run);
    std::string whole = imported_document(run, run.header, figures, sha256, actions, false);
    if (whole.size() <= kPageBytes) return whole;
    return imported_document(run, shortened(run.header), figures, sha256, actions, false);
  }
  const StatedRun stated = limited_stated_run(run);
  const auto document = [&](const RunHeader& header, std::size_t visit_limit) {
    return run_document({run, header, stated.points, stated.figures, false, visit_limit}, sha256,
                        actions);
  };
  std::string whole = document(run.header, kMaxVisits);
  return whole.size() <= kPageBytes ? whole : document(shortened(run.header), 0);
}

Result<QueryThread::Work> get_run(Methods& m, const Params& params) {
  MDOF_TRY(const Reference reference, reference_param(params));
  return [&m, id = params.integer("run"), reference](store::Store& store) {
    return whole_run_json(m, store, id, reference);
  };
}

Result<QueryThread::Work> run_points(const std::shared_ptr<RunPages>& pages, const Params& params) {
  MDOF_TRY(const Reference reference, reference_param(params));
  return [pages, id = params.integer("run"), page = read_list_page(params, kMaxPointsPage),
          reference](store::Store& store) { return pages->points(store, id, page, reference); };
}

}  // namespace

void add_run_methods(rpc::MethodTable& table, Methods& m) {
  const rpc::Param axis{"axis", ParamType::string, "X, Y or Z", true};
  const rpc::Param run{"run", ParamType::integer, "id of the run", true};
  const rpc::Param offset = offset_param();
  const rpc::Param reference{"reference", ParamType::string,
                             "reference point of the errors: fixture, carriage or tool", false,
                             "\"fixture\""};
  table.add(
      {.name = "run.start",
       .summary = "Starts a run of an axis: mdofd records the samples and calculates a point from "
                  "each stop of the axis.",
       .params =
           {axis,
            {"targets_mm",
             ParamType::array,
             "nominal positions in ascending order [none: mdofd finds the targets from the stops]",
             false,
             "[]",
             {.items = kMaxTargets}},
            {"from_mm", ParamType::number,
             "first target; give from_mm, to_mm and interval_mm instead of targets_mm", false},
            {"to_mm", ParamType::number,
             "end of the range of targets; the last target is at or before this position", false},
            {"interval_mm", ParamType::number, "distance between targets", false},
            {"jitter_mm", ParamType::number, "largest random shift of a target", false, "0"},
            {"seed", ParamType::integer, "seed of the random shifts", false, "1", {.least = 0}},
            {"scale_period_um",
             ParamType::number,
             "signal period of the encoder's scale; mdofd warns if the distances between targets "
             "hide the periodic error of the scale",
             false,
             "0",
             {.least = 0}},
            {"repeats",
             ParamType::integer,
             "the run ends after this number of passes over the targets in each direction; the "
             "axis must move beyond the first and the last target. 0: the run ends at run.stop",
             false,
             "0",
             {.least = 0, .most = 10'000}},
            {"note", ParamType::string, "free text, stored with the run", false, "\"\""}},
       .result =
           "mdofd replies after it has stored the run on the disk and the measurement has begun",
       .members = "started_run",
       .example = R"({"axis": "X", "note": "after scraping"})",
       .writes = true,
       .handler = [&m](const Params& p, Reply r) { start_run(m, p, std::move(r)); }});
  table.add({.name = "run.resume",
             .summary = "Continues a run that ended early. The new run begins with the recorded "
                        "samples of the old run and replaces the old run.",
             .params = {run},
             .members = "started_run",
             .example = R"({"run": 1})",
             .writes = true,
             .handler = [&m](const Params& p, Reply r) { resume_run(m, p, std::move(r)); }});
  table.add(
      {.name = "run.stop",
       .summary = "Ends a run that is under way, and evaluates the run.",
       .params = {run, {"abort", ParamType::boolean, "mark the run as aborted", false, "false"}},
       .result = "if mdofd renumbered the targets at the end of the run, it stored a new run that "
                 "supersedes the stopped run; \"run\" is then the new run",
       .members = "{run, axis, state: string|null, supersedes, notices: [notice]|null}",
       .example = R"({"run": 1})",
       .writes = true,
       .handler = [&m](const Params& p, Reply r) { stop_run(m, p, std::move(r)); }});
  table.add(
      {.name = "run.list",
       .summary = "Lists runs, newest first, in pages.",
       .params = {offset,
                  count_param(kMaxRunsPage),
                  {"axis", ParamType::string, "list only runs of this axis", false},
                  {"all", ParamType::boolean,
                   "also list runs whose targets were renumbered in a new run", false, "false"}},
       .members = "{total: integer, offset, runs: [{...run_header, superseded_by, shortened?}]}",
       .example = R"({"offset": 0, "count": 10})",
       .handler = on_query(m, list_runs)});
  table.add({.name = "run.get",
             .summary = "Returns a run without its points: header, provenance, straightness, "
                        "angles, plausibility, and the users who started and stopped the run.",
             .params = {run, reference},
             .result = "an imported run of positioning errors has the figures E and B of ISO "
                       "230-2, or the range of its values",
             .members = "measured_run|imported_run",
             .example = R"({"run": 1})",
             .handler = on_query(m, get_run)});
  table.add({.name = "run.points",
             .summary = "Returns the points of a run in the order of measurement, in pages.",
             .params = {run, offset, count_param(kMaxPointsPage), reference},
             .members = "{run, axis, total: integer, offset, ...reference, ...covers, points: "
                        "[point]}|{run, axis, total: integer, offset, ...covers, points: "
                        "[imported_point]}",
             .example = R"({"run": 1, "offset": 0, "count": 20})",
             .handler = on_query(
                 m, [pages = std::make_shared<RunPages>()](Methods&, const Params& params) {
                   return run_points(pages, params);
                 })});
}

}  // namespace mdof::daemon
