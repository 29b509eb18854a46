#include "daemon/methods/query_thread.h"

#include <condition_variable>

#include "tests/daemon/methods/methods_fixture.h"

namespace mdof::daemon {
namespace {

// Clients whose calls are answered on the thread "query". A test first sends a call that blocks
// this thread, and later releases the thread.
class Queries : public MethodsTest {
 protected:
  struct Client : rpc::ReplySink {
    void finish(std::string_view text) override { replies.emplace_back(text); }
    std::vector<std::string> replies;
    rpc::BegunBatch batch;
  };

  void SetUp() override {
    MethodsTest::SetUp();
    add("slow", [this] {
      std::unique_lock lock(mutex_);
      in_slow_ = true;
      changed_.notify_all();
      changed_.wait(lock, [this] { return go_on_; });
      return std::string("\"slow\"");
    });
    add("note", [this] {
      const std::lock_guard lock(mutex_);
      return std::to_string(++noted_);
    });
  }
  void TearDown() override {
    go_on();
    MethodsTest::TearDown();
  }
  void add(const std::string& name, std::function<std::string()> work) {
    bench_->table.add({.name = name,
                       .summary = "Is of the test.",
                       .result = "any",
                       .handler = [this, work](const rpc::Params&, rpc::Reply reply) {
                         bench_->query->answer(
                             std::move(reply),
                             [work](store::Store&) -> Result<std::string> { return work(); });
                       }});
  }
  void send(const std::shared_ptr<Client>& client, const std::string& method) {
    std::string text = R"({"jsonrpc":"2.0","id":1,"method":")" + method + "\"}", out;
    const std::size_t bytes = text.size();
    text.append(rpc::Dispatcher::kPadding, '}');
    bench_->dispatcher->handle(std::string_view(text).substr(0, bytes), bench_->caller, client, out,
                               client->batch, rpc::Dispatcher::Clock::time_point::max());
  }
  // Blocks the query thread: it processes no message until go_on().
  void hold() {
    holder_ = std::make_shared<Client>();
    send(holder_, "slow");
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return in_slow_; });
  }
  void go_on() {
    const std::lock_guard lock(mutex_);
    go_on_ = true;
    changed_.notify_all();
  }
  void await(const std::shared_ptr<Client>& client, std::size_t replies) {
    auto& context = *bench_->loop.core()->context;
    while (client->replies.size() < replies) {
      if (context.stopped()) context.restart();
      context.run_one_for(std::chrono::milliseconds(20));
    }
  }
  int noted() {
    const std::lock_guard lock(mutex_);
    return noted_;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool in_slow_ = false, go_on_ = false;
  int noted_ = 0;
  std::shared_ptr<Client> holder_;
};

TEST_F(Queries, TheLoopAnswersWhileAQueryRuns) {
  hold();
  EXPECT_EQ(call("server.info").at("/result/server"), "\"mdofd\"");
  EXPECT_EQ(call("compensation.at", R"({"axis":"X","position_mm":1})").code(), rpc::kNotFound);
  go_on();
  await(holder_, 1);
}

TEST_F(Queries, OneClientDoesNotDelayTheOthers) {
  hold();
  const auto greedy = std::make_shared<Client>(), other = std::make_shared<Client>();
  for (int i = 0; i < 100; ++i) send(greedy, "note");
  send(other, "note");
  go_on();
  await(other, 1);
  EXPECT_LE(Answer(other->replies[0]).number("/result"), 2);
  await(greedy, 100);
}

TEST_F(Queries, CallsOfADisconnectedClientAreDropped) {
  hold();
  auto gone = std::make_shared<Client>(), stays = std::make_shared<Client>();
  for (int i = 0; i < 50; ++i) send(gone, "note");
  gone.reset();
  send(stays, "note");
  send(stays, "note");
  go_on();
  await(stays, 2);
  EXPECT_EQ(noted(), 2);
}

TEST_F(Queries, TooManyCallsOfOneClientAreRejectedAndCounted) {
  hold();
  const auto client = std::make_shared<Client>(), other = std::make_shared<Client>();
  for (int i = 0; i < 258; ++i) send(client, "note");
  await(client, 2);
  for (const std::string& reply : client->replies) {
    EXPECT_EQ(Answer(reply).code(), rpc::kConflict) << reply;
    EXPECT_NE(reply.find("256 calls of this connection are already"), std::string::npos) << reply;
  }
  send(other, "note");
  EXPECT_EQ(call("server.info").number("/result/calls_refused"), 2);
  go_on();
  await(client, 258);
  await(other, 1);
  EXPECT_EQ(noted(), 257);
}

// While the query thread is blocked, no method that reads the database or calculates may answer.
TEST_F(Queries, NoMethodThatReadsTheDatabaseRunsOnTheLoop) {
  add_run('X');
  add_run('Y');
  hold();
  const auto client = std::make_shared<Client>();
  std::size_t count = 0;
  for (const auto& [name, method] : bench_->table.methods()) {
    const bool small = name == "server.info" || name == "rig.get" || name.starts_with("rpc.") ||
                       name.starts_with("live.") || name.starts_with("device.") ||
                       name.starts_with("run.s") || name.starts_with("run.re") ||
                       name.starts_with("encoder.") || name == "compensation.at" ||
                       name == "compensation.grid" || name == "compensation.status" ||
                       name == "slow" || name == "note";
    if (small) continue;
    ++count;
    std::string text = R"({"jsonrpc":"2.0","id":1,"method":")" + name + R"(","params":)" +
                       method.example + "}",
                out;
    const std::size_t bytes = text.size();
    text.append(rpc::Dispatcher::kPadding, '}');
    bench_->dispatcher->handle(std::string_view(text).substr(0, bytes), bench_->caller, client, out,
                               client->batch, rpc::Dispatcher::Clock::time_point::max());
    EXPECT_EQ(out, "") << name << " was answered by the loop";
  }
  EXPECT_GE(count, 10u);
  go_on();
  await(client, count);
}

}  // namespace
}  // namespace mdof::daemon
