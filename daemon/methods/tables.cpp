// compensation.list, compensation.table: tables that are stored, whether active or not.
#include <algorithm>
#include <numeric>

#include "daemon/measure/gate/active_json.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/methods/methods.h"
#include "daemon/rpc/params/list_page.h"
#include "schema/base/json_page.h"
#include "schema/run_json.h"
#include "schema/volumetric/volumetric_json.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;

constexpr std::int64_t kMaxTablesPage = 20;
constexpr std::int64_t kMaxRowsPage = 100;

// The generation of an active table, else 0.
std::int64_t generation_of(const ActiveTables& active, const CompensationTable& table) {
  const auto& of_axis = active.axes[static_cast<std::size_t>(table.axis)];
  return of_axis && of_axis->table.id == table.id ? of_axis->generation : 0;
}

std::string table_item(const CompensationTable& table, std::int64_t generation) {
  JsonWriter json;
  json.begin_object();
  write_table_members(json, table);
  write_active(json, generation);
  json.end_object();
  return json.take();
}

std::string volume_item(const VolumetricTable& table, const ActiveTables& active) {
  const bool is_active = active.volume && active.volume->table.id == table.id;
  JsonWriter json;
  json.begin_object();
  write_volumetric_members(json, table);
  write_active(json, is_active ? active.volume->generation : 0);
  json.end_object();
  return json.take();
}

struct TablesRequest {
  rpc::ListPage page;
  std::optional<Axis> axis;
  bool volume = false;
  std::int64_t generation = 0;  // of all active tables
};

Result<std::string> tables_json(store::Store& store, const TablesRequest& request,
                                const ActiveTables& active) {
  std::vector<std::string> items;
  if (request.volume) {
    MDOF_TRY(const auto tables, store.list_volumetric(request.page.offset, request.page.count));
    for (const auto& table : tables) items.push_back(volume_item(table, active));
  } else {
    MDOF_TRY(const auto tables,
             store.list_tables(request.page.offset, request.page.count, request.axis));
    for (const auto& table : tables)
      items.push_back(table_item(table, generation_of(active, table)));
  }
  JsonWriter json;
  json.begin_object().field("generation", request.generation);
  json.field("offset", request.page.offset).key("tables").begin_array();
  append_page(json, items, [](const std::string& item) { return item; });
  json.end_array().end_object();
  return json.take();
}

Result<QueryThread::Work> list_tables(Methods& m, const Params& params) {
  TablesRequest request{rpc::list_page_of(params, kMaxTablesPage), {}, false, m.generation};
  request.volume = params.string("axis") == "volume";
  if (params.has("axis") && !request.volume) {
    MDOF_TRY(request.axis, axis_param(params));
  }
  return [request, active = m.active](store::Store& store) {
    return tables_json(store, request, active);
  };
}

Result<std::string> rows_json(store::Store& store, std::int64_t id, rpc::ListPage page,
                              const ActiveTables& active) {
  MDOF_TRY(const CompensationTable table, store.table(id));
  MDOF_TRY(const Notices doubtful, doubtful_notices(store, table));
  const std::int64_t generation = generation_of(active, table);
  JsonWriter json;
  json.begin_object();
  write_table_members(json, table);
  json.field("doubtful", !doubtful.empty());
  write_active(json, generation);
  json.field("offset", page.offset).key("points").begin_array();
  const auto total = static_cast<std::int64_t>(table.position_m.size());
  std::vector<std::int64_t> rows(
      static_cast<std::size_t>(std::clamp<std::int64_t>(total - page.offset, 0, page.count)));
  std::iota(rows.begin(), rows.end(), page.offset);
  append_page(json, rows, [&](std::int64_t i) {
    JsonWriter row;
    write_table_row(row, table, static_cast<std::size_t>(i));
    return row.take();
  });
  json.end_array().end_object();
  return json.take();
}

Result<QueryThread::Work> get_table(Methods& m, const Params& params) {
  return [id = params.integer("table"), page = rpc::list_page_of(params, kMaxRowsPage),
          active = m.active](store::Store& store) { return rows_json(store, id, page, active); };
}

}  // namespace

void add_tables_methods(rpc::MethodTable& table, Methods& m) {
  table.add(
      {.name = "compensation.list",
       .summary = "Lists the stored tables, newest first, in pages.",
       .params = {rpc::offset_param(),
                  rpc::count_param(kMaxTablesPage),
                  {"axis", ParamType::string,
                   "X, Y or Z: list only tables of this axis; volume: list only volumetric tables",
                   false}},
       .result = "tables without their points",
       .members =
           "{offset, generation, tables: [{...table, active, generation}|{...volume_table, active, "
           "generation}]}",
       .example = R"({"axis": "X", "count": 10})",
       .handler = on_query(m, list_tables)});
  table.add(
      {.name = "compensation.table",
       .summary = "Returns a stored table of one axis, active or not, with its points in pages.",
       .params = {{"table", ParamType::integer, "id of the table", true},
                  rpc::offset_param(),
                  rpc::count_param(kMaxRowsPage)},
       .members = "{...active_table, active, ...table_points}",
       .example = R"({"table": 1, "offset": 0, "count": 20})",
       .handler = on_query(m, get_table)});
}

}  // namespace mdof::daemon
