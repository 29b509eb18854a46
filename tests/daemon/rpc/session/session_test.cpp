// Sessions without a socket. A list collects the messages that the sessions send.
#include "daemon/rpc/session/session.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/rpc/session/service.h"

namespace mdof::rpc::test {
namespace {

using namespace std::chrono_literals;
using Time = Session::Clock::time_point;

struct MemoryTransport final : Transport {
  void send(std::string_view message) override { sent.emplace_back(message); }
  std::size_t unsent() const override { return unsent_bytes; }
  void wake() override { ++wakes; }

  std::vector<std::string> sent;
  std::size_t unsent_bytes = 0;
  int wakes = 0;
};

// An executor that runs a task only when the test calls take().
struct Turns final : Executor {
  void dispatch(std::function<void()> work) override { waiting.push_back(std::move(work)); }
  void take() {
    for (const auto& work : std::exchange(waiting, {})) work();
  }
  std::vector<std::function<void()>> waiting;
};

const Peer kUser{Credentials{1000, 100, 42}, {200}};
const Peer kTcp{};

std::string call(const std::string& method, int id, const std::string& params = "[]") {
  return R"({"jsonrpc":"2.0","method":")" + method + R"(","params":)" + params + R"(,"id":)" +
         std::to_string(id) + "}";
}
std::string result(const std::string& json, int id) {
  return R"({"jsonrpc":"2.0","result":)" + json + R"(,"id":)" + std::to_string(id) + "}";
}
std::string notification(const std::string& topic, int missed, const std::string& value) {
  return R"({"jsonrpc":"2.0","method":")" + topic + R"(","params":{"missed":)" +
         std::to_string(missed) + R"(,"value":)" + value + "}}";
}
std::string code_in(const std::string& reply) {
  const auto at = reply.find(R"("code":)");
  return at == std::string::npos ? "none" : reply.substr(at + 7, 6);
}

class Sessions : public ::testing::Test {
 protected:
  explicit Sessions(ServerOptions limits = {}) : options(std::move(limits)) {
    using Text = Result<std::string>;
    table.add(
        {.name = "one", .summary = "One.", .result = "1", .handler = [](const Params&) -> Text {
           return "1";
         }});
    table.add({.name = "later",
               .summary = "Answers when the test says so.",
               .result = "a number",
               .handler = [this](const Params&, Reply r) { replies.push_back(std::move(r)); }});
    table.add({.name = "write",
               .summary = "Changes something.",
               .result = "true",
               .writes = true,
               .handler = [](const Params&) -> Text { return "true"; }});
    table.add({.name = "approve",
               .summary = "Approves.",
               .result = "true",
               .writes = true,
               .approves = true,
               .handler = [](const Params&) -> Text { return "true"; }});
  }

  Service& service() {
    if (!made_) made_.emplace(std::shared_ptr<Executor>(&turns, [](auto*) {}), table, options);
    return *made_;
  }
  std::shared_ptr<Session> admit(const Peer& peer = kUser) {
    auto session = service().admit(peer, transport);
    EXPECT_TRUE(session.has_value());
    return session ? *session : nullptr;
  }
  static std::string ask(Session& session, std::string message) {
    const std::size_t bytes = message.size();
    message.append(Dispatcher::kPadding, '}');
    std::string out;
    session.handle(std::string_view(message).substr(0, bytes), out);
    return out;
  }
  void answer(std::size_t i, const std::string& json) {
    replies.at(i)(Result<std::string>(json));
    turns.take();
  }

  ServerOptions options;
  MethodTable table{"test", "1"};
  Turns turns;
  MemoryTransport transport;
  std::vector<Reply> replies;

 private:
  std::optional<Service> made_;
};

TEST_F(Sessions, ABatchHasOneReplyAtOnce) {
  const auto session = admit();
  EXPECT_EQ(ask(*session, "[" + call("one", 1) + R"(,{"jsonrpc":"2.0","method":"one"},)" +
                              call("one", 2) + "]"),
            "[" + result("1", 1) + "," + result("1", 2) + "]");
  EXPECT_TRUE(transport.sent.empty());
  EXPECT_TRUE(session->has_nothing_pending());
}

TEST_F(Sessions, ALongBatchIsProcessedInParts) {
  const auto session = admit();
  std::string message = "[" + call("one", 1) + "," + call("later", 2) + "," + call("one", 3) + "]";
  const std::size_t bytes = message.size();
  message.append(Dispatcher::kPadding, '}');
  const std::string_view batch = std::string_view(message).substr(0, bytes);
  const Time over = Session::Clock::now() - 1s;
  std::string out;
  EXPECT_FALSE(session->handle(batch, out, over));
  EXPECT_FALSE(session->has_nothing_pending());
  EXPECT_TRUE(replies.empty());
  EXPECT_FALSE(session->handle(batch, out, over));
  ASSERT_EQ(replies.size(), 1u);
  answer(0, "22");  // the last member of the batch is not called yet
  EXPECT_TRUE(session->handle(batch, out, over));
  EXPECT_EQ(out, "[" + result("1", 1) + "," + result("22", 2) + "," + result("1", 3) + "]");
  EXPECT_TRUE(transport.sent.empty());
  EXPECT_TRUE(session->has_nothing_pending());
}

TEST_F(Sessions, ALateReplyIsSentInALaterTurn) {
  const auto session = admit();
  EXPECT_EQ(ask(*session, call("later", 7)), "");
  EXPECT_FALSE(session->has_nothing_pending());
  replies.at(0)(Result<std::string>("5"));
  EXPECT_TRUE(transport.sent.empty());
  turns.take();
  EXPECT_EQ(transport.sent, std::vector{result("5", 7)});
  EXPECT_EQ(transport.wakes, 1);
  EXPECT_TRUE(session->has_nothing_pending());
}

TEST_F(Sessions, ABatchWaitsForItsLateMembers) {
  const auto session = admit();
  EXPECT_EQ(
      ask(*session, "[" + call("later", 1) + "," + call("one", 2) + "," + call("later", 3) + "]"),
      "");
  answer(1, "33");
  EXPECT_TRUE(transport.sent.empty());
  answer(0, "11");
  EXPECT_EQ(transport.sent, std::vector{"[" + result("1", 2) + "," + result("33", 3) + "," +
                                        result("11", 1) + "]"});
}

TEST_F(Sessions, ALateNotificationSendsNothingAndFreesItsRoom) {
  const auto session = admit();
  EXPECT_EQ(ask(*session, R"({"jsonrpc":"2.0","method":"later"})"), "");
  answer(0, "1");
  EXPECT_TRUE(transport.sent.empty());
  EXPECT_EQ(transport.wakes, 1);
  EXPECT_TRUE(session->has_nothing_pending());
}

TEST_F(Sessions, EachOpenCallReservesTheLargestReply) {
  options.max_reply_bytes = 20'000;
  options.max_unsent_bytes = 60'000;
  const auto session = admit();
  for (int id = 1; id <= 3; ++id) {
    EXPECT_TRUE(session->has_room());
    ask(*session, call("later", id));
  }
  EXPECT_FALSE(session->has_room());
  answer(1, "2");
  EXPECT_TRUE(session->has_room());
  transport.unsent_bytes = 1;  // the reply is not sent yet
  EXPECT_FALSE(session->has_room());
}

TEST_F(Sessions, OnlyTheNewestValueIsSentAndOthersAreCounted) {
  service().add_topic({"live", false, 20ms});
  const auto session = admit();
  ASSERT_TRUE(session->subscribe("live", 100ms));
  for (const char* value : {"1", "2", "3"}) ASSERT_TRUE(service().publish("live", value));
  EXPECT_EQ(transport.wakes, 3);
  const Time now = Session::Clock::now();
  EXPECT_FALSE(session->send_due(now));
  EXPECT_EQ(transport.sent, std::vector{notification("live", 2, "3")});
  ASSERT_TRUE(service().publish("live", "4"));
  const auto next = session->send_due(now + 50ms);
  ASSERT_TRUE(next.has_value());
  EXPECT_GE(*next, now + 100ms);
  EXPECT_EQ(transport.sent.size(), 1u);
  session->send_due(*next);
  EXPECT_EQ(transport.sent.back(), notification("live", 0, "4"));
}

TEST_F(Sessions, EventsAreSentInOrderAndTheOldestMayBeLost) {
  options.max_queued_events = 3;
  service().add_topic({"event", true, 0ms});
  const auto session = admit();
  ASSERT_TRUE(session->subscribe("event", 0ms));
  for (int i = 1; i <= 5; ++i) ASSERT_TRUE(service().publish("event", std::to_string(i)));
  session->send_due(Session::Clock::now());
  EXPECT_EQ(transport.sent,
            (std::vector{notification("event", 2, "3"), notification("event", 0, "4"),
                         notification("event", 0, "5")}));
}

TEST_F(Sessions, OneTurnSendsAboutOneReply) {
  options.max_reply_bytes = 20'000;
  service().add_topic({"event", true, 0ms});
  const auto session = admit();
  ASSERT_TRUE(session->subscribe("event", 0ms));
  const std::string big = '"' + std::string(15'000, 'x') + '"';
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(service().publish("event", big));
  session->send_due(Session::Clock::now());
  EXPECT_EQ(transport.sent.size(), 2u);
  session->send_due(Session::Clock::now());
  EXPECT_EQ(transport.sent.size(), 4u);
}

TEST_F(Sessions, AnUnknownCallerMayOnlyRead) {
  const auto unknown = admit(kTcp);
  EXPECT_EQ(ask(*unknown, call("one", 1)), result("1", 1));
  EXPECT_EQ(code_in(ask(*unknown, call("write", 2))), "-32003");
  EXPECT_FALSE(unknown->credentials());
  EXPECT_EQ(ask(*admit(kUser), call("write", 3)), result("true", 3));
}

TEST_F(Sessions, AnUnknownCallerMayWriteIfConfigured) {
  options.tcp_may_write = true;
  EXPECT_EQ(ask(*admit(kTcp), call("write", 1)), result("true", 1));
}

TEST_F(Sessions, PrimaryOrFurtherGroupPermitsApproval) {
  options.approvers = ServerOptions::Group{200, "metrology"};
  EXPECT_EQ(ask(*admit({Credentials{1000, 200, 42}}), call("approve", 1)), result("true", 1));
  EXPECT_EQ(ask(*admit({Credentials{1000, 100, 42}, {5, 200}}), call("approve", 1)),
            result("true", 1));
  const std::string refused = ask(*admit({Credentials{1000, 100, 42}, {5}}), call("approve", 1));
  EXPECT_EQ(code_in(refused), "-32003");
  EXPECT_NE(refused.find("uid 1000 is not a member"), std::string::npos) << refused;
}

TEST_F(Sessions, ALateReplyToADisconnectedClientIsDropped) {
  auto session = admit();
  ask(*session, call("later", 1));
  session.reset();
  EXPECT_EQ(service().session_count(), 0u);
  answer(0, "1");
  EXPECT_TRUE(transport.sent.empty());
  EXPECT_EQ(transport.wakes, 0);
}

TEST_F(Sessions, AnEndedSessionSendsNothingMore) {
  service().add_topic({"live", false, 20ms});
  const auto session = admit();
  ASSERT_TRUE(session->subscribe("live", 100ms));
  ask(*session, call("later", 1));
  session->refuse("too long");
  ASSERT_EQ(transport.sent.size(), 1u);
  EXPECT_EQ(
      transport.sent[0],
      R"({"jsonrpc":"2.0","error":{"code":-32600,"message":"Invalid Request","data":"too long"},"id":null})");
  EXPECT_FALSE(service().wanted_interval("live"));
  answer(0, "1");
  EXPECT_EQ(transport.sent.size(), 1u);
  // The session exists until its client has read the reply.
  EXPECT_EQ(service().session_count(), 1u);
}

TEST_F(Sessions, IsIdleAfterTheLimitIfNothingIsPending) {
  options.idle_timeout = 1s;
  service().add_topic({"live", false, 20ms});
  const auto session = admit();
  const Time soon = Session::Clock::now() + 500ms, late = Session::Clock::now() + 1h;
  EXPECT_FALSE(session->is_idle(soon));
  EXPECT_TRUE(session->is_idle(late));
  transport.unsent_bytes = 1;
  EXPECT_FALSE(session->is_idle(late));
  transport.unsent_bytes = 0;
  ask(*session, call("later", 1));
  EXPECT_FALSE(session->is_idle(late));
  answer(0, "1");
  ASSERT_TRUE(session->subscribe("live", 100ms));
  EXPECT_FALSE(session->is_idle(late));
  ASSERT_TRUE(session->unsubscribe("live"));
  EXPECT_TRUE(session->is_idle(late));
  session->end_idle();
  EXPECT_EQ(code_in(transport.sent.back()), "-32000");
}

TEST_F(Sessions, SessionsOfAllTransportsShareTopicsAndLimits) {
  options.max_connections = 2;
  options.log = [](const std::string&) {};
  service().add_topic({"event", true, 0ms});
  MemoryTransport other;
  auto first = service().admit(kUser, transport), second = service().admit(kTcp, other);
  ASSERT_TRUE(first && second);
  ASSERT_TRUE((*first)->subscribe("event", 0ms));
  ASSERT_TRUE((*second)->subscribe("event", 0ms));
  ASSERT_TRUE(service().publish("event", "1"));
  EXPECT_EQ(transport.wakes, 1);
  EXPECT_EQ(other.wakes, 1);
  const auto third = service().admit(kUser, transport);
  ASSERT_FALSE(third);
  EXPECT_NE(third.error().message.find("all 2 connections are in use"), std::string::npos);
  second->reset();
  EXPECT_TRUE(service().admit(kUser, transport));
}

TEST_F(Sessions, TheReservedConnectionIsForItsGroupOnly) {
  options.max_connections = 2;
  options.kept_for_group = 200;
  options.log = [](const std::string&) {};
  const auto first = admit(kTcp);
  EXPECT_FALSE(service().admit(kTcp, transport));
  const auto of_group = admit(kUser);
  EXPECT_FALSE(service().admit(kUser, transport));
}

}  // namespace
}  // namespace mdof::rpc::test
