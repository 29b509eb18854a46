// The RPC methods of mdofd. Each group of methods has one file, and one line in methods.inc.
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

// A new message replaces an older message that is still pending.
inline constexpr const char* kLiveTopic = "live.update";
inline constexpr const char* kRunTopic = "run.event";  // each message is sent

// The active tables. Used on the main thread only. Each activation replaces the whole struct.
struct ActiveTables {
  std::array<std::shared_ptr<const store::ActiveTable>, 3> axes;
  std::shared_ptr<const store::ActiveVolumetric> volume;
};

// Address of the web page, and path of the token file.
struct Page {
  std::string url, token_file;
};

// The objects that the methods use. Exists as long as the server. Used on the main thread only.
struct Methods {
  rpc::EventLoop& loop;
  Storekeeper& keeper;   // writes the database
  store::Store& reader;  // read-only; for short reading on the main thread
  QueryThread& query;    // for all longer reading and calculation
  std::vector<std::unique_ptr<Station>>& stations;
  ActiveTables& active;
  std::string database;
  std::string started_utc;
  std::chrono::steady_clock::time_point started;
  // Generation of the active tables; each activation and deactivation increases it.
  std::int64_t generation = 0;
  Replayer* replayer = nullptr;   // nullptr: run.replay is rejected
  std::optional<Page> page = {};  // nullopt: the page is not served
  // Sends the message that the active tables have changed.
  std::function<void(std::int64_t generation)> announce = {};
  std::function<std::vector<std::string>()> clients = {};  // lists the connected clients
};

#define METHODS(noun) void add_##noun##_methods(rpc::MethodTable& table, Methods& m);
#include "daemon/methods/methods.inc"
#undef METHODS

inline void add_all_methods(rpc::MethodTable& table, Methods& m) {
#define METHODS(noun) add_##noun##_methods(table, m);
#include "daemon/methods/methods.inc"
#undef METHODS
}

// ---- functions that several groups use ----

// An action of the caller at the present time.
HistoryEntry caller_action(const rpc::Params& params, std::string name);
// As caller_action(). The parameter "reason" becomes the detail of the action.
HistoryEntry action_with_reason(const rpc::Params& params, std::string name);
Result<Axis> axis_param(const rpc::Params& params);
// Parameters for the largest allowed deviation or correction.
std::vector<rpc::Param> limit_params();
Result<algo::TableLimits> limits_param(const rpc::Params& params);
// Parameter "reference"; default: the fixture.
Result<Reference> reference_param(const rpc::Params& params);
// Parameters for methods that calculate from a machine: the text of MACHINE.toml, and the commanded
// positions of the axes. machine_param() does not read the files that MACHINE.toml names.
std::vector<rpc::Param> machine_params();
Result<Machine> machine_param(const rpc::Params& params);
std::string machine_source(const rpc::Params& params);
std::vector<rpc::Param> command_params(const char* what);
Result<algo::Command> command_of(const rpc::Params& params, const Machine& machine);
// Parameters for two runs along different axes: two of run_x, run_y and run_z.
std::vector<rpc::Param> squareness_params(std::vector<rpc::Param> more = {});
Result<SquarenessRequest> squareness_param(const rpc::Params& params);
Result<Station*> find_station(Methods& m, Axis axis);
// A handler in two steps. First, read(m, params) reads the parameters on the event loop and returns
// a function. Then this function calculates the answer on the thread "query".
template <class Read>
rpc::AsyncHandler on_query(Methods& m, Read read) {
  return [&m, read](const rpc::Params& params, rpc::Reply reply) {
    Result<QueryThread::Work> work = read(m, params);
    if (!work) return reply(tl::unexpected(work.error()));
    m.query.answer(std::move(reply), std::move(*work));
  };
}
// A change of the database. The thread "query" calculates the change. The thread of the storekeeper
// writes it. The thread "query" waits until the change is written. The queue of the storekeeper
// therefore contains at most one such change and has space for the data of the measurement.
using Change = std::function<Result<std::string>(store::Store&)>;
void answer_with_change(Methods& m, rpc::Reply reply,
                        std::function<Result<Change>(store::Store& reader)> calculate);
Result<ActiveTables> load_active(store::Store& store);
// Stores a change of the active tables, then replaces m.active on the main thread, then sends the
// answer. The answer contains `reply_members` and the new generation.
Change change_active(Methods& m, std::string reply_members,
                     std::function<Result<store::Activation>(store::Store&)> change);

}  // namespace mdof::daemon
