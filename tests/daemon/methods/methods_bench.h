// All methods of mdofd, with their own store and axis. A caller passes lines of JSON-RPC directly,
// without a socket. No test framework is used here, because fuzzers use this class too.
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

// The caller of the methods, with its credentials and rights. Records the topics to which it
// subscribes.
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

// Thread-bound. `folder` must exist; the constructor creates the database in it.
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

  // Processes one message. Returns the reply, or an empty text if there is no reply.
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
  // Calls a method by name. `params`: its parameters as JSON.
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
  // Runs one posted task, or waits a short time for a task.
  void turn() {
    auto& context = *loop.core()->context;
    if (context.stopped()) context.restart();
    if (context.run_one_for(std::chrono::milliseconds(20)) == 0) ::usleep(50);
  }
};

}  // namespace mdof::daemon
