// Handlers of methods that answer later, from any thread.
#include <condition_variable>
#include <deque>

#include "daemon/rpc/line/client.h"
#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {
namespace {

// A thread that answers calls in the order that a test requests. It stands for the storage thread.
class Worker {
 public:
  void take(Reply reply, std::string result) {
    const std::scoped_lock lock(mutex_);
    jobs_.emplace_back(std::move(reply), std::move(result));
    changed_.notify_all();
  }
  std::pair<Reply, std::string> get(bool newest = false) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !jobs_.empty(); });
    auto job = std::move(newest ? jobs_.back() : jobs_.front());
    newest ? jobs_.pop_back() : jobs_.pop_front();
    return job;
  }
  void wait_for(std::size_t n) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return jobs_.size() >= n; });
  }
  std::size_t size() {
    const std::scoped_lock lock(mutex_);
    return jobs_.size();
  }
  void drop_all() {
    const std::scoped_lock lock(mutex_);
    jobs_.clear();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<Reply, std::string>> jobs_;
};

class Replies : public ::testing::Test {
 protected:
  Replies() {
    server_.table.add({.name = "later",
                       .summary = "Answers later.",
                       .params = {{"value", ParamType::integer, "what", true}},
                       .result = "the value",
                       .example = R"({"value":1})",
                       .handler = [this](const Params& p, Reply reply) {
                         worker_.take(std::move(reply), p.json("value"));
                       }});
    server_.table.add(
        {.name = "at_once",
         .summary = "Answers in its handler.",
         .result = "1",
         .handler = [](const Params&, Reply reply) { reply(Result<std::string>("1")); }});
    server_.table.add({.name = "never",
                       .summary = "Forgets its reply.",
                       .result = "none",
                       .handler = [](const Params&, const Reply&) {}});
    server_.table.add({.name = "fail",
                       .summary = "Fails.",
                       .params = {{"code", ParamType::integer, "an ErrorCode", true}},
                       .result = "none",
                       .handler = [](const Params& p) -> Result<std::string> {
                         return fail(static_cast<ErrorCode>(p.integer("code")), "why");
                       }});
    for (const bool sync : {true, false}) server_.table.add(fail_with_remedy(sync));
    server_.start();
  }
  static Method fail_with_remedy(bool sync) {
    const auto why = [] { return bad_input("run 7 is too long", Remedy::show_run, "7"); };
    Method method;
    method.name = sync ? "fail_at_once" : "fail_later";
    method.summary = "Fails with a remedy.";
    method.result = "none";
    if (sync)
      method.handler = [why](const Params&) -> Result<std::string> { return why(); };
    else
      method.handler = [why](const Params&, Reply reply) { reply(Result<std::string>(why())); };
    return method;
  }
  static std::string later(int id) {
    const std::string n = std::to_string(id);
    return R"({"jsonrpc":"2.0","method":"later","params":[)" + n + R"(],"id":)" + n + "}";
  }
  static std::string result(int id) {
    const std::string n = std::to_string(id);
    return R"({"jsonrpc":"2.0","result":)" + n + R"(,"id":)" + n + "}";
  }
  void answer(bool newest = false) {
    auto [reply, text] = worker_.get(newest);
    reply(Result<std::string>(text));
  }

  Worker worker_;
  TestServer server_;
};

TEST_F(Replies, MayBeSentInAnotherOrderThanTheCalls) {
  RawClient client(server_.path);
  client.send(later(1) + "\n" + later(2) + "\n");
  worker_.wait_for(2);
  answer(true);
  EXPECT_EQ(client.line(), result(2));
  EXPECT_EQ(client.ask(R"({"jsonrpc":"2.0","method":"at_once","id":3})"),
            R"({"jsonrpc":"2.0","result":1,"id":3})");
  answer();
  EXPECT_EQ(client.line(), result(1));
}

TEST_F(Replies, ABatchWaitsForAllItsMembers) {
  RawClient client(server_.path);
  client.send("[" + later(1) + R"(,{"jsonrpc":"2.0","method":"at_once","id":2},)" + later(3) +
              "]\n");
  worker_.wait_for(2);
  answer(true);
  EXPECT_EQ(client.line(50ms), "<time out>");
  answer();
  EXPECT_EQ(client.line(), "[" + std::string(R"({"jsonrpc":"2.0","result":1,"id":2},)") +
                               result(3) + "," + result(1) + "]");
}

TEST_F(Replies, NotificationsGetNoReplyEvenLater) {
  RawClient client(server_.path);
  client.send(R"([{"jsonrpc":"2.0","method":"later","params":[1]}])"
              "\n"
              R"({"jsonrpc":"2.0","method":"later","params":[2]})"
              "\n" +
              later(3) + "\n");
  for (int i = 0; i < 3; ++i) answer();
  EXPECT_EQ(client.line(), result(3));
}

TEST_F(Replies, ADestroyedReplyIsAnInternalError) {
  RawClient client(server_.path);
  EXPECT_EQ(at(client.ask(R"({"jsonrpc":"2.0","method":"never","id":1})"), "/error/code"),
            "-32603");
  client.send(later(2) + "\n");
  worker_.wait_for(1);
  worker_.drop_all();  // called on this thread, not on the thread of the loop
  const auto reply = client.line();
  EXPECT_EQ(at(reply, "/error/code"), "-32603");
  EXPECT_EQ(at(reply, "/id"), "2");
}

TEST_F(Replies, OutliveTheirClientAndTheServer) {
  {
    RawClient client(server_.path);
    client.send(later(1) + "\n" + later(2) + "\n");
    worker_.wait_for(2);
  }
  answer();
  EXPECT_TRUE(server_.connections_become(1) || server_.connections_become(0));
  server_.stop();
  answer();
}

TEST_F(Replies, WaitingCallsAreBoundedPerClient) {
  RawClient client(server_.path);
  std::string all;
  for (int i = 1; i <= 200; ++i) all += later(i) + "\n";
  client.send(all);
  worker_.wait_for(21);  // 1 MiB is sufficient for 21 replies of 48 KiB
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(worker_.size(), 21u);
  EXPECT_EQ(RawClient(server_.path).ask(R"({"jsonrpc":"2.0","method":"at_once","id":3})"),
            R"({"jsonrpc":"2.0","result":1,"id":3})");
  for (int i = 1; i <= 200; ++i) {
    answer();
    ASSERT_EQ(client.line(), result(i));
  }
}

TEST_F(Replies, ManyThreadsMayAnswer) {
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([this] {
      for (int i = 0; i < 500; ++i) answer();
    });
  std::vector<std::thread> clients;
  for (int c = 0; c < 3; ++c)
    clients.emplace_back([this] {
      RawClient client(server_.path);
      for (int i = 0; i < 500; ++i) EXPECT_EQ(client.ask(later(i + 1)), result(i + 1));
    });
  for (auto& thread : clients) thread.join();
  for (auto& thread : threads) thread.join();
}

TEST_F(Replies, EveryErrorCodeIsConvertedBothWays) {
  auto client = Client::connect(server_.path);
  ASSERT_TRUE(client.has_value());
  RawClient raw(server_.path);
  const std::pair<ErrorCode, const char*> codes[] = {
      {ErrorCode::usage, "-32602"},     {ErrorCode::bad_input, "-32010"},
      {ErrorCode::not_found, "-32004"}, {ErrorCode::check, "-32012"},
      {ErrorCode::io, "-32011"},        {ErrorCode::conflict, "-32002"},
      {ErrorCode::changed, "-32001"}};
  for (const auto& [code, number] : codes) {
    const std::string params = "[" + std::to_string(static_cast<int>(code)) + "]";
    EXPECT_EQ(at(raw.ask(R"({"jsonrpc":"2.0","method":"fail","params":)" + params + R"(,"id":1})"),
                 "/error/code"),
              number);
    const auto result = client->call("fail", params);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, code);
    EXPECT_EQ(result.error().message, "why");
  }
}

// A program uses the code of an error; its text is for people.
TEST_F(Replies, AnErrorHasItsRemedyAsTextAndAsCode) {
  RawClient client(server_.path);
  for (const std::string method : {"fail_at_once", "fail_later"})
    EXPECT_EQ(
        client.ask(R"({"jsonrpc":"2.0","method":")" + method + R"(","id":1})"),
        R"({"jsonrpc":"2.0","error":{"code":-32010,"message":"run 7 is too long; to read the run, )"
        R"(use: mdof show 7","data":{"remedy":"show_run"}},"id":1})");
  EXPECT_EQ(
      at(client.ask(R"({"jsonrpc":"2.0","method":"fail","params":[1],"id":2})"), "/error/data"),
      "");
  auto mdof = Client::connect(server_.path);
  ASSERT_TRUE(mdof);
  const auto result = mdof->call("fail_later");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "run 7 is too long; to read the run, use: mdof show 7");
}

}  // namespace
}  // namespace mdof::rpc::test
