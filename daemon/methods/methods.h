// The methods of mdof on the RPC: one row each, in a file a noun; methods.inc lists the nouns.
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
inline constexpr const char* kRunTopic = "run.event";     // each worth sending

// The active tables; on the main thread. Replaced whole when one is activated.
struct ActiveTables {
  std::array<std::shared_ptr<const store::ActiveTable>, 3> axes;
  std::shared_ptr<const store::ActiveVolumetric> volume;
};

// Of the web page.
struct Page {
  std::string url, token_file;
};

// What the methods work on. Lives as long as the server, on the main thread.
struct Methods {
  rpc::EventLoop& loop;
  Storekeeper& keeper;   // all writing
  store::Store& reader;  // read-only, of the main thread: for little and short work
  QueryThread& query;    // all other reading, and calculating
  std::vector<std::unique_ptr<Station>>& stations;
  ActiveTables& active;
  std::string database;
  std::string started_utc;
  std::chrono::steady_clock::time_point started;
  std::int64_t generation = 0;    // of the active tables: rises with each change of it
  Replayer* replayer = nullptr;   // none: run.replay is refused
  std::optional<Page> page = {};  // none: not served
  std::function<void(std::int64_t generation)> announce = {};  // of a change of what is active
  std::function<std::vector<std::string>()> clients = {};      // who is connected
};

#define METHODS(noun) void add_##noun##_methods(rpc::MethodTable& table, Methods& m);
#include "daemon/methods/methods.inc"
#undef METHODS

inline void add_all_methods(rpc::MethodTable& table, Methods& m) {
#define METHODS(noun) add_##noun##_methods(table, m);
#include "daemon/methods/methods.inc"
#undef METHODS
}

// Shared by the nouns.
HistoryEntry action_of(const rpc::Params& params, std::string name);           // by the caller, now
HistoryEntry action_with_reason(const rpc::Params& params, std::string name);  // with its "reason"
Result<Axis> axis_param(const rpc::Params& params);
// What a deviation or a correction may be at the most.
std::vector<rpc::Param> limit_params();
Result<algo::TableLimits> limits_param(const rpc::Params& params);
Result<Reference> reference_param(const rpc::Params& params);  // not given: the fixture
// MACHINE.toml as text, and the commands of its axes: machine.at and what is built of a machine.
// Its files are not read yet.
std::vector<rpc::Param> machine_params();
Result<Machine> machine_param(const rpc::Params& params);
std::string machine_source(const rpc::Params& params);
std::vector<rpc::Param> command_params(const char* what);
Result<algo::Command> command_of(const rpc::Params& params, const Machine& machine);
// The runs along two axes: run_x, run_y, run_z, two of them.
std::vector<rpc::Param> squareness_params(std::vector<rpc::Param> more = {});
Result<SquarenessRequest> squareness_param(const rpc::Params& params);
Result<Station*> station_of(Methods& m, Axis axis);
// A handler of two parts: `read`(m, params) takes the parameters on the loop and gives the work
// that makes the answer on the thread "query".
template <class Read>
rpc::AsyncHandler on_query(Methods& m, Read read) {
  return [&m, read](const rpc::Params& params, rpc::Reply reply) {
    Result<QueryThread::Work> work = read(m, params);
    if (!work) return reply(tl::unexpected(work.error()));
    m.query.answer(std::move(reply), std::move(*work));
  };
}
// What somebody calculates on the thread "query" and then writes with the writable store, on its
// thread. One such change at a time is in the queue of the store, which measuring needs as well.
using Change = std::function<Result<std::string>(store::Store&)>;
void answer_with_change(Methods& m, rpc::Reply reply,
                        std::function<Result<Change>(store::Store& reader)> calculate);
Result<ActiveTables> load_active(store::Store& store);
// Stores a change of what is active, then puts it in place for everybody at once on the main
// thread; the answer, `reply_members` with the generation, comes there after it.
Change change_active(Methods& m, std::string reply_members,
                     std::function<Result<store::Activation>(store::Store&)> change);

}  // namespace mdof::daemon
