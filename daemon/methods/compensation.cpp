// The methods compensation.build, .activate, .deactivate, .status, .grid and .at.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>

#include "algo/compensation/compensation.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/table_documents.h"
#include "daemon/methods/methods.h"
#include "daemon/methods/volume.h"
#include "daemon/paths.h"
#include "daemon/rpc/params/list_page.h"
#include "daemon/words/words.h"
#include "schema/base/json_page.h"
#include "schema/rig/correction.h"
#include "schema/run_json.h"
#include "schema/uncertainty/run_uncertainty.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::count_param;
using rpc::offset_param;
using rpc::Params;
using rpc::ParamType;
using rpc::Reply;

constexpr const char* kSense =
    "error = actual - nominal position of the moving body; the correction is added to the command "
    "of the axis that is the second letter in the name of the error (EYX: Y)";
constexpr std::int64_t kMaxGridPage = 100;

Result<const store::ActiveTable*> active_table(const Methods& m, const Params& params) {
  MDOF_TRY(const Axis axis, axis_param(params));
  const auto& table = m.active.axes[static_cast<std::size_t>(axis)];
  if (table) return table.get();
  return fail(
      ErrorCode::not_found,
      std::string("no compensation table is active for axis ") + letter(axis) +
          "; build a table with compensation.build and activate it with compensation.activate");
}

Result<TableRequest> read_table_request(const Params& params) {
  TableRequest request;
  MDOF_TRY(request.runs, params.integers("runs"));
  request.keep_slope = params.boolean("keep_slope", false);
  request.partial = params.boolean("partial", false);
  if (params.has("add_to")) request.add_to = params.integer("add_to");
  if (params.has("reference")) {
    MDOF_TRY(request.reference, reference_param(params));
  }
  MDOF_TRY(request.limits, limits_param(params));
  return request;
}

void build(Methods& m, const Params& params, Reply reply) {
  auto request = read_table_request(params);
  if (!request) return reply(tl::unexpected(request.error()));
  request->action = caller_action(params, "compensation.build");
  answer_with_change(
      m, std::move(reply), [request = *request](store::Store& reader) -> Result<Change> {
        MDOF_TRY(auto calculated, calculate_table(reader, request));
        return [built = std::move(calculated),
                action = request.action](store::Store& store) mutable -> Result<std::string> {
          MDOF_CHECK(store_table(store, built.table, action));
          const std::string document =
              table_document(built.table, 0, !built.doubtful.empty(),
                             page_with_notices(built.notices, kMaxGridPage));
          return with_notices(document, built.notices, words::text);
        };
      });
}

void activate(Methods& m, const Params& params, Reply reply) {
  const ActivationRequest request{
      params.integer("table"),
      {params.boolean("simulated", false), params.boolean("despite_warnings", false)},
      action_with_reason(params, "compensation.activate"),
      expected_generation_param(params)};
  answer_with_change(m, std::move(reply), [&m, request](store::Store& reader) -> Result<Change> {
    MDOF_TRY(const store::Marks marks, check_activation(reader, request));
    return change_active(
        m, "\"table\":" + std::to_string(request.table),
        [request, marks](store::Store& store) { return activate_checked(store, request, marks); });
  });
}

void deactivate(Methods& m, const Params& params, Reply reply) {
  if (is_volume(params)) return deactivate_volume(m, params, std::move(reply));
  const auto axis = axis_param(params);
  if (!axis) return reply(tl::unexpected(axis.error()));
  answer_with_change(
      m, std::move(reply),
      [&m, axis = *axis, action = action_with_reason(params, "compensation.deactivate"),
       expected = expected_generation_param(params)](store::Store&) -> Result<Change> {
        return change_active(m, std::string("\"axis\":\"") + letter(axis) + "\"",
                             [axis, action, expected](store::Store& store) {
                               return store.deactivate(axis, actor_text(action.by), action.utc,
                                                       action, expected);
                             });
      });
}

std::string status(const Methods& m) {
  JsonWriter json;
  json.begin_object().field("generation", m.generation).key("axes").begin_object();
  for (const auto& active : m.active.axes) {
    if (!active) continue;
    json.key(std::string(1, letter(active->table.axis))).begin_object();
    write_table_members(json, active->table);
    json.field("doubtful", active->doubtful)
        .field("generation", active->generation)
        .field("activated_utc", active->activated_utc)
        .field("activated_by", active->actor)
        .end_object();
  }
  json.end_object().key("volume");
  write_volume_status(json, m);
  json.end_object();
  return json.take();
}

// Rejects parameters that apply only to the other kind of table. If these parameters were ignored,
// the client would believe that they have an effect.
Status refuse(const Params& params, std::initializer_list<const char*> keys, const char* why) {
  for (const char* key : keys)
    if (params.has(key)) return fail(ErrorCode::usage, std::string(key) + why);
  return {};
}

Result<std::string> grid(const Methods& m, const Params& params) {
  if (is_volume(params)) return volume_grid(m, params);
  MDOF_CHECK(
      refuse(params, {"u_parts"}, " applies only to a volumetric table; leave this parameter out"));
  MDOF_TRY(const auto* active, active_table(m, params));
  const auto [offset, count] = read_list_page(params, kMaxGridPage);
  if (params.has("generation") && params.integer("generation") != active->generation) {
    return fail(ErrorCode::changed, "the active table changed (generation is now " +
                                        std::to_string(active->generation) +
                                        "); read the grid again from offset 0");
  }
  JsonWriter json;
  json.begin_object();
  write_table_members(json, active->table);
  json.field("doubtful", active->doubtful)
      .field("generation", active->generation)
      .field("offset", offset)
      .key("points")
      .begin_array();
  const auto total = static_cast<std::int64_t>(active->table.position_m.size());
  std::vector<std::int64_t> rows(
      static_cast<std::size_t>(std::clamp<std::int64_t>(total - offset, 0, count)));
  std::iota(rows.begin(), rows.end(), offset);
  append_page(json, rows, [&](std::int64_t i) {
    JsonWriter row;
    write_table_row(row, active->table, static_cast<std::size_t>(i));
    return row.take();
  });
  json.end_array().end_object();
  return json.take();
}

void write_values(JsonWriter& json, const char* key, Axis axis, const Errors5& values) {
  json.key(key).begin_object();
  for (std::size_t k = 0; k < 5; ++k)
    json.field(error_names(axis)[k].key, to_key_unit(values[k]) + 0.0);  // + 0.0 converts -0 to 0
  json.end_object();
}

// Writes the correction; null if the chain is unknown. A component is null if no axis of the chain
// can correct it. Each reason is written only once.
void write_correction(JsonWriter& json, const CompensationTable& table, const Errors5& error) {
  const CorrectionSigns signs =
      correction_signs(table.machine, table.axis, table.sides, table.stated.reference);
  Errors5 correction{};
  std::string why;
  if (std::any_of(error.begin(), error.end(), [](double x) { return std::isnan(x); }))
    why = "the table has no error values for this approach";
  for (std::size_t k = 0; k < 5; ++k) {
    correction[k] = signs.factor[k] == 0 ? kNaN : signs.factor[k] * error[k];
    if (!signs.gap[k].empty() && why.find(signs.gap[k]) == std::string::npos)
      why += (why.empty() ? "" : "; ") + signs.gap[k];
  }
  if (table.machine.known()) {
    write_values(json, "correction", table.axis, correction);
  } else {
    json.key("correction").null();
  }
  json.key("correction_reason");
  why.empty() ? json.null() : json.value(why);
}

// What a table for the mean of both approaches leaves in each approach: half of the reversal value.
// 0 if the correction is for one approach; NaN if an approach was not measured here.
Errors5 reversal_left(const CompensationTable& table, double position_m, algo::TableSide side) {
  Errors5 left{};
  if (side != algo::TableSide::mean) return left;
  const auto forward = algo::table_at(table, position_m, algo::TableSide::forward);
  const auto reverse = algo::table_at(table, position_m, algo::TableSide::reverse);
  const bool known = forward.inside && reverse.inside;
  for (std::size_t k = 0; k < left.size(); ++k)
    left[k] = known ? std::abs(forward.error[k] - reverse.error[k]) / 2 : kNaN;
  return left;
}

Result<std::string> at(const Methods& m, const Params& params) {
  if (is_volume(params)) {
    MDOF_CHECK(refuse(params, {"direction", "position_mm"},
                      " does not apply to a volumetric table; leave this parameter out, and give "
                      "X_mm, Y_mm and Z_mm"));
    return volume_at(m, params);
  }
  MDOF_CHECK(refuse(params, {"X_mm", "Y_mm", "Z_mm"},
                    " applies only to a volumetric table; give position_mm"));
  if (!params.has("position_mm"))
    return fail(ErrorCode::usage, "position_mm is missing; give the position on the axis");
  MDOF_TRY(const auto* active, active_table(m, params));
  const std::int64_t direction = params.integer("direction", 0);
  if (direction < -1 || direction > 1) {
    return fail(ErrorCode::usage,
                "direction must be 1 (forward), -1 (reverse) or 0 (mean of both)");
  }
  const auto side = direction > 0   ? algo::TableSide::forward
                    : direction < 0 ? algo::TableSide::reverse
                                    : algo::TableSide::mean;
  const double position_mm = params.number("position_mm");
  const CompensationTable& table = active->table;
  algo::TableValue value = algo::table_at(table, from_mm(position_mm), side);
  if (!value.inside) {  // outside, the value is from another position or approach, so its u is not
                        // valid
    value.u.fill(std::nan(""));
    value.u_interpolation.fill(std::nan(""));
  }
  JsonWriter json(1280);
  json.begin_object()
      .field("axis", std::string_view(&"XYZ"[static_cast<std::size_t>(table.axis)], 1))
      .field("position_mm", position_mm)
      .field("direction", direction);
  write_reference(json, table);
  json.field("sense", kSense);
  write_values(json, "error", table.axis, value.error);
  write_correction(json, table, value.error);
  write_values(json, "u", table.axis, value.u);
  write_values(json, "u_interpolation", table.axis, value.u_interpolation);
  write_values(json, "reversal_left", table.axis, reversal_left(table, from_mm(position_mm), side));
  write_covers(
      json,
      covers_text(table) +
          "; between targets, u also includes the uncertainty of the interpolation" +
          (side == algo::TableSide::mean ? kReversalLeft : "") +
          (value.inside ? ""
                        : "; this approach was not measured at this position, so u is unknown"),
      table.not_declared);
  json.field("inside", value.inside)
      .field("simulated", table.simulated)
      .field("doubtful", active->doubtful)
      .field("table", table.id)
      .field("generation", active->generation)
      .end_object();
  return json.take();
}

}  // namespace

void add_compensation_methods(rpc::MethodTable& table, Methods& m) {
  const rpc::Param axis{"axis", ParamType::string, "X, Y, Z or volume", true};
  const rpc::Param reason{"reason", ParamType::string,
                          "free text that explains the change; stored in the history", false,
                          "\"\""};
  const rpc::Param expected{"expected_generation", ParamType::integer,
                            "generation that compensation.status returned before you decided. If "
                            "an active table has changed since then, the call changes nothing and "
                            "fails with error -32001; the message names the active tables",
                            false};
  std::vector<rpc::Param> build_params{
      {"runs", ParamType::array, "ids of runs of one axis with the same targets", true},
      {"keep_slope", ParamType::boolean,
       "keep the slope in the straightness errors (by default the slope is removed, because it is "
       "part of the squareness)",
       false, "false"},
      {"partial", ParamType::boolean, "also accept partial runs", false, "false"},
      {"add_to", ParamType::integer,
       "id of the table that the controller applied during the runs; the new table is the sum of "
       "this table and the residual errors of the runs",
       false},
      {"reference", ParamType::string,
       "reference point of the straightness: fixture, carriage or tool [tool if the rig has a tool "
       "point, otherwise fixture]",
       false}};
  for (rpc::Param& limit : limit_params()) build_params.push_back(std::move(limit));
  table.add({.name = "compensation.build",
             .summary =
                 "Builds a table of one axis from runs and stores the table without activating it.",
             .params = std::move(build_params),
             .result = "the result contains only the first points; compensation.table returns all "
                       "points, in pages",
             .members = "{...active_table, active, ...table_points, ...notices}",
             .example = R"({"runs": [1]})",
             .writes = true,
             .handler = [&m](const Params& p, Reply r) { build(m, p, std::move(r)); }});
  table.add(
      {.name = "compensation.activate",
       .summary = "Activates a stored table (of an axis or of the volume) at once for all clients.",
       .params = {{"table", ParamType::integer, "id of the table", true},
                  {"simulated", ParamType::boolean, "also accept a table with simulated data",
                   false, "false"},
                  {"despite_warnings", ParamType::boolean,
                   "also accept a table that is doubtful because of notices of its runs", false,
                   "false"},
                  expected,
                  reason},
       .members = "{table, generation, changed, simulated, doubtful}",
       .example = R"({"table": 1})",
       .writes = true,
       .approves = true,
       .handler = [&m](const Params& p, Reply r) { activate(m, p, std::move(r)); }});
  table.add(
      {.name = "compensation.deactivate",
       .summary =
           "Deactivates the active table of one axis, or of the volume. Other tables stay active.",
       .params = {axis, expected, reason},
       .members = "{axis, generation, changed}",
       .example = R"({"axis": "X"})",
       .writes = true,
       .approves = true,
       .handler = [&m](const Params& p, Reply r) { deactivate(m, p, std::move(r)); }});
  table.add({.name = "compensation.status",
             .summary = "Lists the active tables by axis, with the generation (a number that "
                        "increases with each change of an active table).",
             .members = "{generation, axes: {{axis}?: {...active_table, ...activated}}, volume: "
                        "{...active_volume, ...activated}}",
             .handler = [&m](const Params&) -> Result<std::string> { return status(m); }});
  table.add(
      {.name = "compensation.grid",
       .summary = "Returns the grid of the active table, in pages. For an axis: errors, forward "
                  "and reverse separately. For the volume: corrections.",
       .params = {axis,
                  offset_param(),
                  count_param(kMaxNodesPage),
                  {"generation", ParamType::integer,
                   "generation of the pages already read; if the generation has changed, the call "
                   "fails with error -32001",
                   false},
                  {"u_parts", ParamType::boolean,
                   "for the volume: also return two parts of u for each node: u_common (from "
                   "causes that all nodes have in common) and u_independent (from noise)",
                   false, "false"}},
       .result = "points of the volume: X, Y, Z in mm, three corrections and three u in um; with "
                 "u_parts also three u_common and three u_independent",
       .members =
           "{...active_table, ...table_points}|{...active_volume, offset, points: [[number|null]]}",
       .example = R"({"axis": "X", "offset": 0, "count": 20})",
       .handler = [&m](const Params& p) { return grid(m, p); }});
  table.add(
      {.name = "compensation.at",
       .summary = "Returns the correction at a position. Between grid points, the correction is "
                  "interpolated linearly. Outside the grid, the correction is the value at the end "
                  "of the grid, \"inside\" is false, and u is null.",
       .params =
           {axis,
            {"position_mm", ParamType::number, "position on the axis; required for an axis", false},
            {"X_mm", ParamType::number,
             "for the volume: commanded position of X; required if X is an axis of the "
             "grid; otherwise the default is the fixed position of X in the table",
             false},
            {"Y_mm", ParamType::number, "for the volume: commanded position of Y; see X_mm", false},
            {"Z_mm", ParamType::number, "for the volume: commanded position of Z; see X_mm", false},
            {"direction", ParamType::integer, "1: forward, -1: reverse, 0: mean of both", false,
             "0"}},
       .result = "the first form of the result is for an axis, the second for the volume",
       .members =
           "{axis, position_mm: number, direction: integer, ...reference, sense, error: errors, "
           "correction: errors, correction_reason, u: errors, u_interpolation: errors, "
           "reversal_left: errors, ...covers, "
           "inside, simulated, doubtful, table, generation}|{axis, {linear}_mm, rotary: rotary, "
           "correction: by_axis, u: by_axis, u_common: by_axis, u_independent: by_axis, "
           "reversal_left: by_axis, "
           "u_covers, not_declared, not_measured, inside, approach, simulated, doubtful, table, "
           "generation}",
       .example = R"({"axis": "X", "position_mm": 12.5, "direction": 1})",
       .handler = [&m](const Params& p) { return at(m, p); }});
}

}  // namespace mdof::daemon
