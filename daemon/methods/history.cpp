// The method history.list.
#include "daemon/methods/methods.h"
#include "daemon/rpc/params/list_page.h"
#include "schema/base/json_page.h"

namespace mdof::daemon {
namespace {

using rpc::count_param;
using rpc::offset_param;
using rpc::Params;

constexpr std::int64_t kMaxActionsPage = 200;

Result<QueryThread::Work> list_history(Methods&, const Params& params) {
  const rpc::ListPage page = read_list_page(params, kMaxActionsPage);
  return [page](store::Store& store) -> Result<std::string> {
    MDOF_TRY(const auto actions, store.list_actions(page.offset, page.count));
    MDOF_TRY(const auto total, store.count_actions());
    JsonWriter json;
    json.begin_object().field("total", total).field("offset", page.offset).key("history");
    json.begin_array();
    append_page(json, actions, action_json);
    json.end_array().end_object();
    return json.take();
  };
}

}  // namespace

void add_history_methods(rpc::MethodTable& table, Methods& m) {
  table.add({.name = "history.list",
             .summary =
                 "Lists recorded actions on runs, squareness, tables and encoders (who, what, "
                 "when), newest first, in pages.",
             .params = {offset_param(), count_param(kMaxActionsPage)},
             .members = "{total: integer, offset, history: [action]}",
             .example = R"({"offset": 0, "count": 20})",
             .handler = on_query(m, list_history)});
}

}  // namespace mdof::daemon
