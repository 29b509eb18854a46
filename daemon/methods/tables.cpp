// The methods compensation.list and compensation.table. They read stored tables, active or not.
#include "daemon/measure/gate/gate.h"
#include "daemon/measure/gate/table_documents.h"
#include "daemon/measure/machine/volumetric.h"
#include "daemon/methods/methods.h"
#include "daemon/rpc/params/list_page.h"
#include "schema/base/json_page.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;

constexpr std::int64_t kMaxTablesPage = 20;
constexpr std::int64_t kMaxRowsPage = 1000;

// The generation of the table if it is active; otherwise 0.
std::int64_t generation_of(const ActiveTables& active, const CompensationTable& table) {
  const auto& of_axis = active.axes[static_cast<std::size_t>(table.axis)];
  return of_axis && of_axis->table.id == table.id ? of_axis->generation : 0;
}

std::int64_t generation_of(const ActiveTables& active, const VolumetricTable& table) {
  return active.volume && active.volume->table.id == table.id ? active.volume->generation : 0;
}

// The kinds of tables in the document. `both`: two lists, axis tables and volumetric tables. `axis`
// and `volumes`: only the list "tables", with the requested kind.
enum class Listed { both, axis, volumes };

struct TablesRequest {
  rpc::ListPage page;
  Listed listed = Listed::both;
  std::optional<Axis> axis;
  std::int64_t generation = 0;  // generation of all active tables
};

Result<std::string> tables_json(store::Store& store, const TablesRequest& request,
                                const ActiveTables& active) {
  ListedTables found;
  found.generation = request.generation;
  found.offset = request.page.offset;
  if (request.listed != Listed::volumes) {
    MDOF_TRY(found.tables,
             store.list_tables(request.page.offset, request.page.count, request.axis));
  }
  if (request.listed != Listed::axis) {
    MDOF_TRY(found.volumes, store.list_volumetric(request.page.offset, request.page.count));
  }
  for (const auto& table : found.tables) found.generations.push_back(generation_of(active, table));
  for (const auto& table : found.volumes)
    found.volume_generations.push_back(generation_of(active, table));
  found.only_volumes = request.listed == Listed::volumes;
  return list_document(found, kPageBytes);
}

Result<QueryThread::Work> list_tables(Methods& m, const Params& params) {
  TablesRequest request{
      rpc::read_list_page(params, kMaxTablesPage), Listed::both, {}, m.generation};
  if (params.string("axis") == "volume") {
    request.listed = Listed::volumes;
  } else if (params.has("axis")) {
    request.listed = Listed::axis;
    MDOF_TRY(request.axis, axis_param(params));
  }
  return [request, active = m.active](store::Store& store) {
    return tables_json(store, request, active);
  };
}

Result<std::string> table_json(store::Store& store, std::int64_t id, rpc::ListPage asked,
                               const ActiveTables& active) {
  const DocumentPage page{asked.offset, asked.count, kPageBytes};
  MDOF_TRY(const bool is_volume, store.is_volumetric(id));
  if (is_volume) {
    MDOF_TRY(const VolumetricTable table, store.volumetric(id));
    MDOF_TRY(const Judged judged, judged_table(store, table));
    return volumetric_document(table, generation_of(active, table), !judged.doubtful.empty(), page);
  }
  MDOF_TRY(const CompensationTable table, store.table(id));
  MDOF_TRY(const Notices doubtful, doubtful_notices(store, table));
  return table_document(table, generation_of(active, table), !doubtful.empty(), page);
}

Result<QueryThread::Work> get_table(Methods& m, const Params& params) {
  return [id = params.integer("table"), page = rpc::read_list_page(params, kMaxRowsPage),
          active = m.active](store::Store& store) { return table_json(store, id, page, active); };
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
       .result = "the tables are returned without their points. \"tables\" contains the tables of "
                 "the axes, and \"volumes\" the tables of planes and volumes. If the parameter "
                 "axis is \"volume\", \"tables\" contains the volumetric tables",
       .members =
           "{offset, generation, tables: [{...table, active, generation}|{...volume_table, active, "
           "generation}], volumes: [{...volume_table, active, generation}]}",
       .example = R"({"axis": "X", "count": 10})",
       .handler = on_query(m, list_tables)});
  table.add(
      {.name = "compensation.table",
       .summary = "Returns a stored table, active or not, with its points in pages. The table "
                  "corrects an axis, a plane or a volume.",
       .params = {{"table", ParamType::integer, "id of the table", true},
                  rpc::offset_param(),
                  rpc::count_param(kMaxRowsPage)},
       .members = "{...active_table, active, ...table_points}|{...active_volume, active, offset, "
                  "points: [[number|null]]}",
       .example = R"({"table": 1, "offset": 0, "count": 20})",
       .handler = on_query(m, get_table)});
}

}  // namespace mdof::daemon
