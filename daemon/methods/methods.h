// The RPC methods of mdof, grouped by noun: one file and one row of methods.inc for each noun.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algo/compensation/table_limits.h"
#include "algo/machine/frames.h"
#include "daemon/history.h"
#include "daemon/measure/evaluation.h"
#include "daemon/methods/files/replayer.h"
#include "daemon/methods/query_thread.h"
#include "daemon/rpc/method_table.h"
#include "daemon/rpc/net/event_loop.h"
#include "daemon/station/station.h"
#include "daemon/store/store.h"
#include "daemon/storekeeper/storekeeper.h"
#include "schema/machine/machine.h"

namespace mdof::daemon {

inline constexpr const char* kLiveTopic = "live.update";  // newest value wins
inline constexpr const char* kRunTopic = "run.event";     // no message replaces another one

// The active tables, on the main thread. Each activation replaces the whole struct.
struct ActiveTables {
  std::array<std::shared_ptr<const store::ActiveTable>, 3> axes;
  std::shared_ptr<const store::ActiveVolumetric> volume;
};

// Addresses of the web page.
struct Page {
  std::string url, token_file;
};

// The objects that the methods use. Lives as long as the server, on the main thread.
struct Methods {
  rpc::EventLoop& loop;
  Storekeeper& keeper;   // for all writing
  store::Store& reader;  // read-only, for short work on the main thread
  QueryThread& query;    // for all other reading and calculation
  std::vector<std::unique_ptr<Station>>& stations;
  ActiveTables& active;
  std::string database;
  std::string started_utc;
  std::chrono::steady_clock::time_point started;
  std::int64_t generation = 0;    // generation of the active tables; rises with each change
  Replayer* replayer = nullptr;   // nullptr: run.replay is rejected
  std::optional<Page> page = {};  // nullopt: the page is not served
  std::function<void(std::int64_t generation)> announce = {};  // announces a change of the active
                                                               // tables
  std::function<std::vector<std::string>()> clients = {};      // connected clients
};

#define METHODS(noun) void add_##noun##_methods(rpc::MethodTable& table, Methods& m);
#include "daemon/methods/methods.inc"
#undef METHODS

inline void add_all_methods(rpc::MethodTable& table, Methods& m) {
#define METHODS(noun) add_##noun##_methods(table, m);
#include "daemon/methods/methods.inc"
#undef METHODS
}

// Shared by all nouns.
HistoryEntry caller_action(const rpc::Params& params, std::string name);  // by the caller, at the
                                                                          // present time
// As caller_action(), with the parameter "reason".
HistoryEntry action_with_reason(const rpc::Params& params, std::string name);
Result<Axis> axis_param(const rpc::Params& params);
// Parameters for the limits of a deviation or correction.
std::vector<rpc::Param> limit_params();
Result<algo::TableLimits> limits_param(const rpc::Params& params);
Result<Reference> reference_param(const rpc::Params& params);  // default: the fixture
// MACHINE.toml as text, and the commands of its axes, for machine.at and everything that is
// calculated from a machine. The files that it names are not yet read.
std::vector<rpc::Param> machine_params();
Result<Machine> machine_param(const rpc::Params& params);
std::string machine_source(const rpc::Params& params);
std::vector<rpc::Param> command_params(const char* what);
Result<algo::Command> command_of(const rpc::Params& params, const Machine& machine);
// The runs along two axes: two of run_x, run_y and run_z.
std::vector<rpc::Param> squareness_params(std::vector<rpc::Param> more = {});
Result<SquarenessRequest> squareness_param(const rpc::Params& params);
Result<Station*> find_station(Methods& m, Axis axis);
// A handler in two steps: `read`(m, params) takes the parameters on the event loop and returns the
// work, which makes the answer on the thread "query".
template <class Read>
rpc::AsyncHandler on_query(Methods& m, Read read) {
  return [&m, read](const rpc::Params& params, rpc::Reply reply) {
    Result<QueryThread::Work> work = read(m, params);
    if (!work) return reply(tl::unexpected(work.error()));
    m.query.answer(std::move(reply), std::move(*work));
  };
}
// A change that is calculated on the thread "query" and then written with the writable store on the
// storekeeper's thread. The query thread waits for the writing, so that the storekeeper's queue,
// which the measurement needs, contains one such change at most.
using Change = std::function<Result<std::string>(store::Store&)>;
void answer_with_change(Methods& m, rpc::Reply reply,
                        std::function<Result<Change>(store::Store& reader)> calculate);
Result<ActiveTables> load_active(store::Store& store);
// Stores a change of the active tables, then replaces m.active on the main thread. The answer
// (`reply_members` with the generation) is sent after that.
Change change_active(Methods& m, std::string reply_members,
                     std::function<Result<store::Activation>(store::Store&)> change);

}  // namespace mdof::daemon
