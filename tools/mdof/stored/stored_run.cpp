#include "tools/mdof/stored/stored_run.h"

#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/store/store.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/run_text.h"
#include "tools/mdof/text/history_text.h"

namespace mdof::tools {
namespace {

Result<std::string> read_text(rpc::Client& daemon, std::int64_t id) {
  MDOF_TRY(const std::string info, daemon.call("server.info"));
  simdjson::dom::parser parser;
  const std::string database = text(parser.parse(simdjson::padded_string(info)), "database");
  MDOF_TRY(store::Store store, store::Store::open(database, store::Access::read_only));
  MDOF_TRY(const Run run, daemon::restated_run(store, id, Reference::fixture));
  MDOF_TRY(const std::string sha256, store.result_sha256(id));
  MDOF_TRY(const auto actions, store.run_actions(id));
  const std::size_t width = terminal_columns();
  return run_text(run, daemon::stated_run(run), sha256, width, Extent::brief, true) +
         history_text(actions, width);
}

}  // namespace

std::optional<std::string> stored_run_text(rpc::Client& daemon, std::int64_t run) {
  auto text = read_text(daemon, run);
  return text ? std::optional(std::move(*text)) : std::nullopt;
}

}  // namespace mdof::tools
