// The methods server.info, device.list, live.subscribe and live.unsubscribe, and functions that
// several groups use.
#include <cstdio>
#include <filesystem>

#include "algo/compensation/between_targets.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/measure/machine/volumetric.h"
#include "daemon/methods/methods.h"
#include "daemon/station/live_json.h"
#include "daemon/version.h"
#include "daemon/words/error_text.h"
#include "schema/base/json_writer.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;

void write_encoder(JsonWriter& json, const EncoderState& encoder) {
  json.begin_object()
      .field("datum", to_string(encoder.datum.kind))
      .field("offset_mm", to_mm(encoder.datum.offset_m))
      .key("note");
  encoder.note.empty() ? json.null() : json.value(encoder.note);
  json.end_object();
}

std::string server_info(const Methods& m) {
  const auto up = std::chrono::steady_clock::now() - m.started;
  std::error_code ec;  // the path is absolute, because the client has another working folder
  const auto database = std::filesystem::absolute(m.database, ec);
  JsonWriter json;
  json.begin_object()
      .field("server", "mdofd")
      .field("version", kVersion)
      .field("protocol", "1.0")
      .field("started_utc", m.started_utc)
      .field("uptime_s", std::chrono::duration<double>(up).count())
      .field("database", ec ? m.database : database.string())
      .field("generation", m.generation)
      .field("store_jobs_dropped", m.keeper.dropped_blocks())
      .field("store_points_dropped", m.keeper.dropped_points())
      .field("calls_refused", m.query.refused());
  const StorageState storage = m.keeper.storage();
  json.field("storage", storage.state).key("storage_reason");
  storage.reason.empty() ? json.null() : json.value(storage.reason);
  const store::ChainHead head = m.keeper.chain_head();
  json.key("chain").begin_object().field("link", head.link).field("sha256", head.sha256);
  json.end_object();
  json.key("http");
  if (m.page)
    json.begin_object()
        .field("url", m.page->url)
        .field("token_file", m.page->token_file)
        .end_object();
  else
    json.null();
  json.key("axes").begin_array();
  for (const auto& station : m.stations) {
    json.begin_object()
        .field("axis", std::string(1, letter(station->config().rig.axis)))
        .field("rig", station->config().rig.name)
        .field("simulated", station->config().simulated());
    json.key("devices").begin_array();
    for (const auto& device : station->config().devices) json.value(device.name);
    json.end_array();
    const std::int64_t run = station->run();
    const bool ended = run > 0 && !m.keeper.still_open_reason(run).empty();
    json.key("run");
    run > 0 && !ended ? json.value(run) : json.null();
    json.key("unstored_run");
    ended ? json.value(run) : json.null();
    json.key("encoder");
    write_encoder(json, station->encoder());
    json.end_object();
  }
  json.end_array().end_object();
  return json.take();
}

std::string device_list(const Methods& m) {
  JsonWriter json;
  json.begin_object().key("devices").begin_array();
  for (const auto& station : m.stations) {
    for (const auto& status : station->devices()) {
      // The JSON object of the device. The axis is its first member.
      json.raw(std::string("{\"axis\":\"") + letter(station->config().rig.axis) + "\"," +
               device_json(status).substr(1));
    }
  }
  json.end_array().end_object();
  return json.take();
}

Result<std::string> subscribe(const Params& params) {
  const std::chrono::milliseconds interval(params.integer("interval_ms", 100));
  MDOF_CHECK(params.caller().subscribe(kLiveTopic, interval));
  if (params.boolean("events", true)) {
    MDOF_CHECK(params.caller().subscribe(kRunTopic, std::chrono::milliseconds(0)));
  }
  JsonWriter json;
  json.begin_object()
      .field("subscribed", true)
      .field("interval_ms", static_cast<std::int64_t>(interval.count()))
      .end_object();
  return json.take();
}

}  // namespace

HistoryEntry caller_action(const Params& params, std::string name) {
  const auto who = params.caller().credentials();
  if (!who)
    return action_now(std::move(name), {-1, -1, -1, params.caller().over_http() ? "web" : "tcp"});
  return action_now(std::move(name), actor_from_ids(who->uid, who->gid, who->pid));
}

HistoryEntry action_with_reason(const Params& params, std::string name) {
  HistoryEntry action = caller_action(params, std::move(name));
  action.detail = params.string("reason");
  return action;
}

std::vector<rpc::Param> limit_params() {
  return {{"limit_um", ParamType::number,
           "largest error allowed in the table, in um (angles: in urad); default 1000 um (angles: "
           "10000 urad)",
           false},
          {"limit_um_per_mm", ParamType::number,
           "largest slope allowed in the table, in um/mm (angles: in urad/mm); default 50 um/mm "
           "(angles: 500 urad/mm)",
           false}};
}

Result<algo::TableLimits> limits_param(const Params& params) {
  const double um = params.number("limit_um", 0), slope = params.number("limit_um_per_mm", 0);
  return algo::TableLimits::asked(params.has("limit_um") ? &um : nullptr,
                                  params.has("limit_um_per_mm") ? &slope : nullptr);
}

Result<Axis> axis_param(const Params& params) {
  if (const auto axis = axis_from(params.string("axis"))) return *axis;
  return fail(ErrorCode::usage,
              "axis \"" + std::string(params.string("axis")) + "\" must be X, Y or Z");
}

Result<Reference> reference_param(const Params& params) {
  Reference reference = Reference::fixture;
  if (!params.has("reference")) return reference;
  const std::string name(params.string("reference"));
  if (reference_from(name, reference)) return reference;
  return fail(ErrorCode::usage,
              "reference \"" + name + "\" must be \"fixture\", \"carriage\" or \"tool\"");
}

Result<Station*> find_station(Methods& m, Axis axis) {
  for (auto& station : m.stations) {
    if (station->config().rig.axis == axis) return station.get();
  }
  return fail(ErrorCode::not_found, std::string("no rig is configured for axis ") + letter(axis) +
                                        "; add an [[axis]] to mdofd.toml");
}

void answer_with_change(Methods& m, rpc::Reply reply,
                        std::function<Result<Change>(store::Store& reader)> calculate) {
  if (const std::string lost = m.keeper.fault(); !lost.empty()) return reply(io_error(lost));
  m.query.answer(
      std::move(reply),
      [&m, calculate = std::move(calculate)](store::Store& reader) -> Result<std::string> {
        MDOF_TRY(Change change, calculate(reader));
        return m.keeper.run(std::move(change));
      });
}

Result<ActiveTables> load_active(store::Store& store) {
  ActiveTables tables;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    auto active = store.active(axis);
    if (!active && active.error().code == ErrorCode::bad_input) {
      std::fprintf(stderr, "axis %c has no active table: %s\n", letter(axis),
                   words::text(active.error()).c_str());
      continue;
    }
    if (active && active->table.lacks_reference_point) {
      std::fprintf(stderr,
                   "mdofd does not serve compensation table %lld of axis %c: an older version "
                   "stored this table without the reference point and without the sign of the "
                   "corrections. Build a new table from the runs of this table, and activate the "
                   "new table\n",
                   static_cast<long long>(active->table.id), letter(axis));
      continue;
    }
    if (active) {
      // If runs of the table cannot be read, the table is doubtful, too.
      const auto doubtful = doubtful_notices(store, active->table);
      active->doubtful = !doubtful || !doubtful->empty();
      // Calculated once, because compensation.at is called often.
      algo::add_curvatures(active->table);
      tables.axes[static_cast<std::size_t>(axis)] =
          std::make_shared<const store::ActiveTable>(std::move(*active));
    } else if (active.error().code != ErrorCode::not_found) {
      return tl::unexpected(active.error());
    }
  }
  auto volume = store.active_volumetric();
  if (volume) {
    const auto doubtful = doubtful_notices(store, volume->table);
    volume->doubtful = !doubtful || !doubtful->empty();
    tables.volume = std::make_shared<const store::ActiveVolumetric>(std::move(*volume));
  } else if (volume.error().code == ErrorCode::bad_input) {
    std::fprintf(stderr, "the volume has no active table: %s\n",
                 words::text(volume.error()).c_str());
  } else if (volume.error().code != ErrorCode::not_found) {
    return tl::unexpected(volume.error());
  }
  return tables;
}

Change change_active(Methods& m, std::string reply_members,
                     std::function<Result<store::Activation>(store::Store&)> change) {
  return [&m, members = std::move(reply_members),
          change = std::move(change)](store::Store& store) -> Result<std::string> {
    MDOF_TRY(const auto done, change(store));
    MDOF_TRY(auto tables, load_active(store));
    m.loop.post([&m, done, tables = std::move(tables)] {
      m.active = tables;
      if (!done.changed) return;
      m.generation = done.generation;
      if (m.announce) m.announce(done.generation);
    });
    return store::activation_json(members, done);
  };
}

void add_server_methods(rpc::MethodTable& table, Methods& m) {
  table.add({.name = "server.info",
             .summary = "Returns the version, the uptime, the axes and the generation (a number "
                        "that increases with each change of an active table).",
             .result = "\"chain\" is the last link of the chain of hashes of the database. Keep "
                       "its sha256. A later verification of the database with this sha256 detects "
                       "whether data that were stored before this reply were removed or changed",
             .members =
                 "{server, version: string, protocol, started_utc, uptime_s, database, generation, "
                 "store_jobs_dropped, store_points_dropped, calls_refused, storage, "
                 "storage_reason, chain: {link, sha256}, http: {url, token_file}, axes: [{axis, "
                 "rig, simulated, devices: [string], run, unstored_run, encoder: {datum, "
                 "offset_mm, note}}]}",
             .handler = [&m](const Params&) -> Result<std::string> { return server_info(m); }});
  table.add(
      {.name = "device.list",
       .summary = "Lists the devices, each with its axis, state, last error, channels and number "
                  "of scans.",
       .members =
           "{devices: [{axis, device, driver, description, state, simulated, rate_hz, scans, "
           "scans_lost, blocks_dropped, reopened, error: string, last_error, mended_utc, trouble, "
           "clock: {drift_ppm, jitter_ms, settled, steps: integer}, channels: [{id: string, "
           "unit}]}]}",
       .handler = [&m](const Params&) -> Result<std::string> { return device_list(m); }});
  table.add(
      {.name = "live.subscribe",
       .summary =
           "Subscribes to two notifications. live.update: the newest values, and for each probe "
           "the lowest and the highest reading of the last second (low_um, high_um). run.event: "
           "each step of a run, after the step is stored on the disk, and each change of an active "
           "compensation table (type \"compensation\", with the generation).",
       .params = {{"interval_ms",
                   ParamType::integer,
                   "shortest time between two updates",
                   false,
                   "100",
                   {.least = 20, .most = 3'600'000}},
                  {"events", ParamType::boolean, "also send run.event", false, "true"}},
       .members = "{subscribed, interval_ms}",
       .example = R"({"interval_ms": 200})",
       .subscribes = true,
       .handler = [](const Params& params) { return subscribe(params); }});
  table.add({.name = "live.unsubscribe",
             .summary = "Ends both subscriptions of this connection.",
             .members = "{}",
             .subscribes = true,
             .handler = [](const Params& params) -> Result<std::string> {
               MDOF_CHECK(params.caller().unsubscribe(kLiveTopic));
               MDOF_CHECK(params.caller().unsubscribe(kRunTopic));
               return std::string("{}");
             }});
}

}  // namespace mdof::daemon
