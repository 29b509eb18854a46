// The methods of mdof on the RPC: one row each, grouped by what they are about.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/doer.h"
#include "daemon/methods/replayer.h"
#include "daemon/rpc/line/event_loop.h"
#include "daemon/rpc/method_table.h"
#include "daemon/station/station.h"
#include "daemon/store/store.h"
#include "daemon/storekeeper/storekeeper.h"

namespace mdof::daemon {

inline constexpr const char* kLiveTopic = "live.update";  // newest value wins
inline constexpr const char* kRunTopic = "run.event";     // each worth sending

// The tables in force, by axis; on the main thread. Replaced whole when one is activated.
using ActiveTables = std::array<std::shared_ptr<const store::ActiveTable>, 3>;

// What the methods work on. Lives as long as the server, on the main thread.
struct Methods {
  rpc::EventLoop& loop;
  Storekeeper& keeper;   // all writing
  store::Store& reader;  // read-only, of the main thread
  std::vector<std::unique_ptr<Station>>& stations;
  ActiveTables& active;
  std::string database;
  std::string started_utc;
  std::chrono::steady_clock::time_point started;
  std::int64_t generation = 0;   // of what is in force: rises with each change of it
  Replayer* replayer = nullptr;  // none: run.replay is refused
};

void add_server_methods(rpc::MethodTable& table, Methods& m);   // server.info device.list live.*
void add_run_methods(rpc::MethodTable& table, Methods& m);      // run.* squareness.fit
void add_encoder_methods(rpc::MethodTable& table, Methods& m);  // encoder.set
void add_replay_methods(rpc::MethodTable& table, Methods& m);   // run.replay
void add_compensation_methods(rpc::MethodTable& table, Methods& m);  // compensation.*
void add_history_methods(rpc::MethodTable& table, Methods& m);       // history.list

// Shared by the groups.
Deed deed_of(const rpc::Params& params, std::string name);  // by the caller, now
Result<Axis> axis_param(const rpc::Params& params);
Result<Reference> reference_param(const rpc::Params& params);  // not given: the fixture
Result<Station*> station_of(Methods& m, Axis axis);
// Runs `work` with the writable store on its thread; answers with its JSON.
void answer_from_store(Methods& m, rpc::Reply reply,
                       std::function<Result<std::string>(store::Store&)> work);
Result<ActiveTables> load_active(store::Store& store);

}  // namespace mdof::daemon
