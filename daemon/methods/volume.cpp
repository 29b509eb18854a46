// The method compensation.build_volume, and the methods compensation.* for volumetric tables.
#include "daemon/methods/volume.h"

#include <algorithm>
#include <cmath>

#include "daemon/measure/gate/table_documents.h"
#include "daemon/measure/machine/machine_files.h"
#include "daemon/measure/machine/volumetric.h"
#include "daemon/methods/files/client_file.h"
#include "daemon/rpc/params/list_page.h"
#include "daemon/words/words.h"
#include "schema/base/json_page.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "schema/volumetric/volumetric_json.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;
using rpc::Reply;

constexpr std::string_view kAxes = "XYZ";
Result<const store::ActiveVolumetric*> active_volume(const Methods& m) {
  if (m.active.volume) return m.active.volume.get();
  return fail(ErrorCode::not_found,
              "no volumetric table is active; build a table with compensation.build_volume and "
              "activate it with compensation.activate");
}

Result<algo::VolumetricRequest> read_grid(const Params& params, const Machine& machine) {
  algo::VolumetricRequest grid;
  const std::string axes(params.string("axes"));
  grid.along = {};
  for (const char axis : axes) {
    const std::size_t k = kAxes.find(axis);
    if (k == std::string_view::npos || grid.along[k])
      return fail(ErrorCode::usage, "axes \"" + axes + "\" must be XYZ, XY, XZ or YZ");
    grid.along[k] = true;
  }
  if (axes.size() < 2) return fail(ErrorCode::usage, "axes must be two or three of X, Y, Z");
  grid.step_m = from_mm(params.number("step_mm"));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string key = std::string(1, kAxes[k]) + "_mm";
    if (grid.along[k] && params.has(key))
      return fail(ErrorCode::usage, key + ": " + kAxes[k] + " is an axis of the grid (axes " +
                                        axes + "), so it has no fixed position; leave " + key +
                                        " out");
  }
  MDOF_TRY(grid.others, command_of(params, machine));
  const std::string approach(params.string("approach", "mean"));
  if (approach != "mean" && approach != "forward" && approach != "reverse")
    return fail(ErrorCode::usage,
                "approach \"" + approach + "\" must be \"mean\", \"forward\" or \"reverse\"");
  grid.approach = approach == "forward"   ? algo::MachineApproach::forward
                  : approach == "reverse" ? algo::MachineApproach::reverse
                                          : algo::MachineApproach::mean;
  grid.incomplete = params.boolean("incomplete", false);
  MDOF_TRY(grid.limits, limits_param(params));
  return grid;
}

Result<VolumetricTableRequest> read_request(const Params& params) {
  VolumetricTableRequest request;
  request.description = params.string("machine");
  MDOF_TRY(request.machine, machine_param(params));
  MDOF_TRY(request.grid, read_grid(params, request.machine));
  return request;
}

std::string built_json(const BuiltVolumetric& built) {
  const std::string document = volumetric_document(built.table, 0, !built.doubtful.empty(),
                                                   page_with_notices(built.notices, kMaxNodesPage));
  return with_notices(document, built.notices, words::text);
}

// Opens files in the folder of MACHINE.toml with the permissions of the client.
struct ClientFiles {
  std::string source;
  std::optional<FileUser> user;  // nullopt: the client is not connected through the Unix socket

  Status read(VolumetricTableRequest& request) const {
    if (!has_table_files(request.machine)) return {};
    if (!user || !source.starts_with('/'))
      return fail(ErrorCode::usage, source +
                                        ": the machine file refers to other files; connect to the "
                                        "Unix socket and set machine_source to the absolute path "
                                        "of the machine file, or write the tables into the "
                                        "machine file");
    std::vector<ClientFile> open;
    const FindFile beside = files_in_same_folder(source);
    MDOF_TRY(
        const std::string hashes,
        read_machine_files(request.machine, [&](const std::string& name) -> Result<std::string> {
          MDOF_TRY(const std::string path, beside(name));
          MDOF_TRY(ClientFile file, open_for(*user, path));
          open.push_back(std::move(file));
          return "/proc/self/fd/" + std::to_string(open.back().file.get());
        }));
    request.description += hashes;
    return {};
  }
};

ClientFiles client_files(const Params& params) {
  ClientFiles files{machine_source(params), std::nullopt};
  if (const auto who = params.caller().credentials())
    files.user = FileUser{who->uid, who->gid, params.caller().further_groups()};
  return files;
}

void build_volume(Methods& m, const Params& params, Reply reply) {
  auto request = read_request(params);
  if (!request) return reply(tl::unexpected(request.error()));
  answer_with_change(m, std::move(reply),
                     [request = std::move(*request), files = client_files(params),
                      action = caller_action(params, "compensation.build_volume")](
                         store::Store& reader) mutable -> Result<Change> {
                       MDOF_CHECK(files.read(request));
                       MDOF_TRY(auto calculated, calculate_volumetric(reader, request));
                       return [built = std::move(calculated),
                               action](store::Store& store) mutable -> Result<std::string> {
                         MDOF_CHECK(store_volumetric(store, built.table, action));
                         return built_json(built);
                       };
                     });
}

void write_active_volume(JsonWriter& json, const store::ActiveVolumetric& active) {
  write_volumetric_members(json, active.table);
  json.field("doubtful", active.doubtful).field("generation", active.generation);
}

}  // namespace

std::optional<std::int64_t> expected_generation_param(const Params& params) {
  if (!params.has("expected_generation")) return std::nullopt;
  return params.integer("expected_generation");
}

bool is_volume(const Params& params) {
  return params.string("axis") == "volume";
}

void deactivate_volume(Methods& m, const Params& params, Reply reply) {
  const HistoryEntry action = action_with_reason(params, "compensation.deactivate");
  const auto expected = expected_generation_param(params);
  answer_with_change(m, std::move(reply), [&m, action, expected](store::Store&) -> Result<Change> {
    return change_active(m, R"("axis":"volume")", [action, expected](store::Store& store) {
      return store.change_volumetric(std::nullopt, actor_text(action.by), action.utc, action,
                                     expected);
    });
  });
}

void write_volume_status(JsonWriter& json, const Methods& m) {
  const auto& active = m.active.volume;
  if (!active) return static_cast<void>(json.null());
  json.begin_object();
  write_active_volume(json, *active);
  json.field("activated_utc", active->activated_utc)
      .field("activated_by", active->actor)
      .end_object();
}

Result<std::string> volume_grid(const Methods& m, const Params& params) {
  MDOF_TRY(const auto* active, active_volume(m));
  const auto [offset, count] = read_list_page(params, kMaxNodesPage);
  if (params.has("generation") && params.integer("generation") != active->generation)
    return fail(ErrorCode::changed, "the active table changed (generation is now " +
                                        std::to_string(active->generation) +
                                        "); read the grid again from offset 0");
  const VolumetricTable& table = active->table;
  const bool with_parts = params.boolean("u_parts", false);
  JsonWriter json(48 * 1024);
  json.begin_object();
  write_active_volume(json, *active);
  json.field("offset", offset).key("points").begin_array();
  const auto total = static_cast<std::int64_t>(table.nodes());
  const std::int64_t end = std::min(total, offset + count);
  append_page_by_index(json, static_cast<std::size_t>(std::min(offset, total)),
                       static_cast<std::size_t>(std::max<std::int64_t>(end, 0)),
                       [&](std::size_t node) {
                         JsonWriter row;
                         write_volumetric_node(row, table, node, with_parts);
                         return row.take();
                       });
  json.end_array().end_object();
  return json.take();
}

Result<std::string> volume_at(const Methods& m, const Params& params) {
  MDOF_TRY(const auto* active, active_volume(m));
  const VolumetricTable& table = active->table;
  Vec3 command_m{};
  JsonWriter json(1280);
  json.begin_object().field("axis", "volume");
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string key = std::string(1, kAxes[k]) + "_mm";
    // The grid has only one position of this axis: the default.
    const bool stands = table.command_m[k].size() == 1;
    if (!params.has(key) && !stands)
      return fail(ErrorCode::usage, key + " is missing; give the commanded position of " +
                                        kAxes[k] + ", which is an axis of the grid");
    command_m[k] = params.has(key) ? from_mm(params.number(key)) : table.command_m[k].front();
    json.field(key, to_mm(command_m[k]));
  }
  write_rotary(json, table);
  algo::VolumetricValue value = algo::volumetric_at(table, command_m);
  if (!value.inside)  // outside, the value is from another position, so its u is not valid
    for (Vec3* u : {&value.u_m, &value.u_common_m, &value.u_independent_m}) u->fill(std::nan(""));
  write_um(json, "correction", value.correction_m);
  write_um(json, "u", value.u_m);
  write_um(json, "u_common", value.u_common_m);
  write_um(json, "u_independent", value.u_independent_m);
  write_um(json, "reversal_left", table.reversal_m);
  json.field("u_covers", covers_text(table) + (table.reversal_m != Vec3{} ? kReversalLeft : "") +
                             (value.inside ? "" : "; outside the grid, u is unknown"));
  write_strings(json, "not_declared", table.u_not_declared);
  write_strings(json, "not_measured", table.not_measured);
  json.field("inside", value.inside)
      .field("approach", table.approach)
      .field("simulated", table.simulated)
      .field("doubtful", active->doubtful)
      .field("table", table.id)
      .field("generation", active->generation)
      .end_object();
  return json.take();
}

void add_volume_methods(rpc::MethodTable& table, Methods& m) {
  std::vector<rpc::Param> params = machine_params();
  params.push_back({"axes", ParamType::string, "axes of the grid: XYZ, XY, XZ or YZ", true});
  params.push_back({"step_mm",
                    ParamType::number,
                    "approximate distance between nodes of the grid",
                    true,
                    {},
                    {.least = 1e-3, .most = 1e6}});
  for (rpc::Param& each :
       command_params("commanded position of this axis if the axis is not in the grid"))
    params.push_back(std::move(each));
  params.push_back({"approach", ParamType::string, "approach direction: mean, forward or reverse",
                    false, "\"mean\""});
  params.push_back({"incomplete", ParamType::boolean,
                    "also build the table if an error that affects the position of the tool was "
                    "not measured",
                    false, "false"});
  for (rpc::Param& limit : limit_params()) params.push_back(std::move(limit));
  table.add({.name = "compensation.build_volume",
             .summary = "Builds a table of corrections over a plane or a volume from the measured "
                        "errors of a machine, and stores the table without activating it.",
             .params = std::move(params),
             .result = "the result contains only the first nodes; compensation.table returns all "
                       "nodes, in pages",
             .members = "{...active_volume, active, offset, points: [[number|null]], ...notices}",
             .example = R"({"machine": "name = \"m\"\nmachine = {chain = \"w-b-X-Y-t\"}\n)"
                        R"([[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n)"
                        R"(range_mm = [0, 10]\nEXX_um = 2\n[[axis]]\nid = \"Y\"\n)"
                        R"(holds_at_mm = [0, 0, 0]\npoint = \"moving\"\nrange_mm = [0, 10]\n",)"
                        R"( "axes": "XY", "step_mm": 5, "incomplete": true})",
             .writes = true,
             .handler = [&m](const Params& p, Reply r) { build_volume(m, p, std::move(r)); }});
}

}  // namespace mdof::daemon
