// All methods of mdofd with a store and an axis of their own, called by lines of JSON-RPC as from
// the socket, without one. No test framework, so that the fuzzers have it too.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/methods/methods.h"
#include "daemon/rpc/net/event_loop_core.h"
#include "daemon/rpc/session/dispatcher.h"

namespace mdof::daemon {

// Who calls, and what they may. Subscribes to what the daemon has.
class BenchCaller final : public rpc::Caller {
 public:
  std::optional<rpc::Credentials> who = rpc::Credentials{1234, 5678, 42};
  bool writes = true;
  std::optional<gid_t> group;
  std::vector<std::pair<std::string, std::chrono::milliseconds>> subscribed;

  std::optional<rpc::Credentials> credentials() const override { return who; }
  bool over_http() const override { return false; }
  bool may_write() const override { return writes; }
  bool in_group(gid_t wanted) const override { return group == wanted; }
  std::vector<gid_t> further_groups() const override {
    return group ? std::vector{*group} : std::vector<gid_t>();
  }
  Status subscribe(std::string_view topic, std::chrono::milliseconds interval) override {
    subscribed.emplace_back(topic, interval);
    return {};
  }
  Status unsubscribe(std::string_view topic) override {
    std::erase_if(subscribed, [&](const auto& s) { return s.first == topic; });
    return {};
  }
};

// Thread-bound. `folder` has to be there; its database is made.
class MethodsBench {
 public:
  MethodsBench(const std::filesystem::path& folder, store::Durability durability)
      : keeper(Storekeeper::start(
                   {folder / "mdof.db", durability, std::chrono::milliseconds(5)},
                   {[](std::int64_t, std::int64_t) {}, [](std::int64_t, const Error&) {}})
                   .value()),
        reader(store::Store::open(folder / "mdof.db", store::Access::read_only).value()),
        query(std::make_unique<QueryThread>(
            loop.executor(), folder / "mdof.db",
            store::Store::open(folder / "mdof.db", store::Access::read_only).value())),
        methods{loop,
                *keeper,
                reader,
                *query,
                stations,
                active,
                (folder / "mdof.db").string(),
                "now",
                std::chrono::steady_clock::now()},
        table("mdofd", "1") {
    add_all_methods(table, methods);
    dispatcher = std::make_unique<rpc::Dispatcher>(loop.executor(), table, options);
  }
  ~MethodsBench() {
    replayer.reset();
    query.reset();
    stations.clear();
    keeper.reset();
  }

  // The reply to one message; empty: there is none to give.
  std::string call(std::string_view message) {
    std::string padded(message), out;
    padded.append(rpc::Dispatcher::kPadding, '}');
    const auto sink = std::make_shared<Sink>();
    rpc::BegunBatch batch;
    const bool open = dispatcher
                          ->handle(std::string_view(padded).substr(0, message.size()), caller, sink,
                                   out, batch, rpc::Dispatcher::Clock::time_point::max())
                          .open;
    while (open && !sink->reply) turn();
    if (open) out = *sink->reply;
    return out;
  }
  // By name, with its parameters as JSON.
  std::string call(const std::string& method, const std::string& params) {
    return call(R"({"jsonrpc":"2.0","id":1,"method":")" + method + R"(","params":)" + params + "}");
  }

  rpc::EventLoop loop;
  std::unique_ptr<Storekeeper> keeper;
  store::Store reader;
  std::vector<std::unique_ptr<Station>> stations;
  ActiveTables active;
  std::unique_ptr<Replayer> replayer;
  std::unique_ptr<QueryThread> query;
  Methods methods;
  rpc::MethodTable table;
  rpc::ServerOptions options;
  BenchCaller caller;
  std::unique_ptr<rpc::Dispatcher> dispatcher;

 private:
  struct Sink final : rpc::ReplySink {
    void finish(std::string_view text) override { reply = text; }
    std::optional<std::string> reply;
  };
  // What other threads have posted, or a while of waiting for it.
  void turn() {
    auto& context = *loop.core()->context;
    if (context.stopped()) context.restart();
    if (context.run_one_for(std::chrono::milliseconds(20)) == 0) ::usleep(50);
  }
};

}  // namespace mdof::daemon
