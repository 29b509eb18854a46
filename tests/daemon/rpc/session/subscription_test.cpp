#include <atomic>

#include "daemon/rpc/line/client.h"
#include "daemon/rpc/session/subscription.h"
#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {
namespace {

const Topic kValue{"live.frame", false, 20ms};
const Topic kEvent{"run.event", true};

Subscription::Value value(int i) {
  return std::make_shared<const std::string>(std::to_string(i));
}

std::string message(const std::string& topic, int missed, const std::string& text) {
  return R"({"jsonrpc":"2.0","method":")" + topic + R"(","params":{"missed":)" +
         std::to_string(missed) + R"(,"value":)" + text + "}}";
}

TEST(Subscription, TheNewestValueReplacesOlderOnes) {
  Subscription subscription(kValue, 100ms, 64);
  EXPECT_FALSE(subscription.due());
  const Subscription::Time now(10s);
  for (int i = 1; i <= 5; ++i) subscription.offer(value(i), now);
  std::string out;
  EXPECT_LE(*subscription.due(), now);
  subscription.take(now, out);
  EXPECT_EQ(out, message("live.frame", 4, "5"));
  EXPECT_FALSE(subscription.due());
  subscription.offer(value(6), now + 90ms);
  EXPECT_EQ(*subscription.due(), now + 100ms);
}

TEST(Subscription, AnOldValueWaitsALimitedTimeForANewerOne) {
  Subscription subscription(kValue, 100ms, 64);
  const Subscription::Time now(10s);
  std::string out;
  subscription.offer(value(1), now);
  subscription.take(now, out);
  subscription.offer(value(2), now + 30ms);
  EXPECT_EQ(*subscription.due(), now + 200ms);
  subscription.offer(value(3), now + 130ms);
  EXPECT_LE(*subscription.due(), now + 130ms);  // the value is sent immediately
}

// Both axes of a device publish their values at the same time.
TEST(Subscription, TheNewestValueOfEachSourceIsSent) {
  Subscription subscription(kValue, 100ms, 64);
  std::string x, y;
  for (int turn = 0; turn < 10; ++turn) {
    const Subscription::Time now = Subscription::Time(10s) + turn * 100ms;
    subscription.offer(value(2 * turn), now, "X");
    subscription.offer(value(2 * turn + 1), now + 1ms, "Y");
    ASSERT_LE(*subscription.due(), now + 1ms) << turn;
    subscription.take(now + 1ms, x);
    ASSERT_LE(*subscription.due(), now + 1ms) << turn;
    subscription.take(now + 1ms, y);
    EXPECT_FALSE(subscription.due());
  }
  EXPECT_NE(x.find(message("live.frame", 0, "18")), std::string::npos) << x;
  EXPECT_NE(y.find(message("live.frame", 0, "19")), std::string::npos) << y;
}

TEST(Subscription, AFullQueueDropsAndCountsTheOldestEvents) {
  Subscription subscription(kEvent, 0ms, 3);
  for (int i = 1; i <= 5; ++i) subscription.offer(value(i), Subscription::Time(10s));
  std::string out;
  while (subscription.due()) subscription.take(Subscription::Time(10s), out);
  EXPECT_EQ(out, message("run.event", 2, "3") + message("run.event", 0, "4") +
                     message("run.event", 0, "5"));
}

class Subscriptions : public ::testing::Test {
 protected:
  static ServerOptions options() {
    ServerOptions o;
    o.stall_timeout = 500ms;
    o.max_subscriptions = 3;
    return o;
  }
  Subscriptions() : server_(options()) {
    const std::vector<Param> params = {{"topic", ParamType::string, "its name", true},
                                       {"interval_ms", ParamType::integer, "ms", false, "100"}};
    server_.table.add(
        {.name = "live.subscribe",
         .summary = "Subscribes.",
         .params = params,
         .result = "true",
         .handler = [](const Params& p) -> Result<std::string> {
           MDOF_CHECK(p.caller().subscribe(
               p.string("topic"), std::chrono::milliseconds(p.integer("interval_ms", 100))));
           return "true";
         }});
    server_.table.add({.name = "live.unsubscribe",
                       .summary = "Ends a subscription.",
                       .params = {params[0]},
                       .result = "true",
                       .handler = [](const Params& p) -> Result<std::string> {
                         MDOF_CHECK(p.caller().unsubscribe(p.string("topic")));
                         return "true";
                       }});
    for (const Topic& topic : {kValue, kEvent, Topic{"a"}, Topic{"b"}})
      server_.service->add_topic(topic);
    server_.start();
  }
  static std::string subscribe(const std::string& topic, int interval_ms) {
    return R"({"jsonrpc":"2.0","method":"live.subscribe","params":[")" + topic + "\"," +
           std::to_string(interval_ms) + R"(],"id":1})";
  }
  void publish(const std::string& topic, const std::string& json) {
    server_.on_loop([&] {
      EXPECT_TRUE(server_.service->publish(topic, json).has_value());
      return 0;
    });
  }
  bool wanted(const std::string& topic) {
    return server_.on_loop([&] { return server_.service->wanted_interval(topic).has_value(); });
  }
  bool loses_last_subscriber(const std::string& topic) {
    for (int i = 0; i < 2000 && wanted(topic); ++i) std::this_thread::sleep_for(5ms);
    return !wanted(topic);
  }
  TestServer server_;
};

TEST_F(Subscriptions, AnEventTooLargeForALineIsCounted) {
  RawClient client(server_.path);
  ASSERT_EQ(at(client.ask(subscribe("run.event", 0)), "/result"), "true");
  const auto refused = server_.on_loop(
      [&] { return server_.service->publish("run.event", std::string(60'000, '1')); });
  EXPECT_FALSE(refused);
  publish("run.event", "2");
  EXPECT_EQ(client.line(), message("run.event", 1, "2"));
}

TEST_F(Subscriptions, ValuesAreNotSentFasterThanRequested) {
  RawClient client(server_.path);
  ASSERT_EQ(at(client.ask(subscribe("live.frame", 100)), "/result"), "true");
  std::atomic<bool> stop = false;
  std::thread publisher([&] {
    for (int i = 0; !stop; ++i, std::this_thread::sleep_for(1ms))
      publish("live.frame", std::to_string(i));
  });
  client.line();
  const auto begin = Clock::now();
  for (int i = 0; i < 5; ++i) EXPECT_NE(at(client.line(), "/params/missed"), "0");
  EXPECT_GE(Clock::now() - begin, 450ms);
  stop = true;
  publisher.join();
}

// If there is one subscriber, a value is made when the next value of this subscriber is due. If
// several subscribers have different intervals, values are made at the minimum interval of the
// topic, so that each subscriber gets a recent value.
TEST_F(Subscriptions, RequestIntervalSuitsAllSubscribers) {
  const auto every = [&] {
    return server_.on_loop([&] { return server_.service->wanted_interval("live.frame"); });
  };
  const auto becomes = [&](std::chrono::milliseconds wanted) {
    for (int i = 0; i < 2000 && every() != wanted; ++i) std::this_thread::sleep_for(5ms);
    return every() == wanted;
  };
  EXPECT_EQ(every(), std::nullopt);
  RawClient patient(server_.path);
  patient.ask(subscribe("live.frame", 500));
  EXPECT_EQ(every(), kValue.min_interval);  // the first value is requested immediately
  publish("live.frame", "1");
  patient.line();
  EXPECT_TRUE(becomes(500ms));
  {
    RawClient keen(server_.path);
    keen.ask(subscribe("live.frame", 50));
    publish("live.frame", "2");
    keen.line();
    EXPECT_TRUE(becomes(kValue.min_interval));
  }
  EXPECT_TRUE(becomes(500ms));
}

TEST_F(Subscriptions, TheLastValueIsSentIfNoneFollows) {
  RawClient client(server_.path);
  client.ask(subscribe("live.frame", 50));
  for (int i = 1; i <= 3; ++i) publish("live.frame", std::to_string(i));
  std::string last;
  while (at(last, "/params/value") != "3") {
    last = client.line();
    ASSERT_NE(last[0], '<') << last;
  }
}

TEST_F(Subscriptions, EventsAreSentInOrderAndAtOnce) {
  RawClient client(server_.path);
  client.ask(subscribe("run.event", 0));
  for (int i = 0; i < 30; ++i) publish("run.event", std::to_string(i));
  for (int i = 0; i < 30; ++i) EXPECT_EQ(client.line(), message("run.event", 0, std::to_string(i)));
}

TEST_F(Subscriptions, AreRejectedWithAReason) {
  RawClient client(server_.path);
  auto reply = client.ask(subscribe("live.fram", 100));
  EXPECT_EQ(at(reply, "/error/code"), "-32004");
  EXPECT_NE(reply.find("did you mean"), std::string::npos) << reply;
  reply = client.ask(subscribe("live.frame", 5));
  EXPECT_EQ(at(reply, "/error/code"), "-32602");
  EXPECT_EQ(at(reply, "/error/message"),
            R"("interval_ms: 5 is less than the minimum interval of the topic, 20")");
  for (const char* topic : {"live.frame", "live.frame", "a", "b"})
    EXPECT_EQ(at(client.ask(subscribe(topic, 100)), "/result"), "true");
  EXPECT_EQ(at(client.ask(subscribe("run.event", 100)), "/error/code"), "-32602");
}

TEST_F(Subscriptions, EndWithUnsubscribeOrTheConnection) {
  {
    RawClient client(server_.path);
    client.ask(subscribe("live.frame", 100));
    EXPECT_TRUE(wanted("live.frame"));
    client.ask(R"({"jsonrpc":"2.0","method":"live.unsubscribe","params":["live.frame"],"id":1})");
    EXPECT_FALSE(wanted("live.frame"));
    client.ask(subscribe("live.frame", 100));
    EXPECT_TRUE(wanted("live.frame"));
  }
  EXPECT_TRUE(loses_last_subscriber("live.frame"));
  publish("live.frame", "1");
}

// A shell that pipes text into a socket tool stops sending in this way.
TEST_F(Subscriptions, RemainIfTheClientOnlyStopsSending) {
  auto client = std::make_unique<RawClient>(server_.path);
  client->send(subscribe("live.frame", 20) + "\n");
  ::shutdown(client->fd(), SHUT_WR);
  EXPECT_EQ(at(client->line(), "/result"), "true");
  publish("live.frame", "7");
  EXPECT_EQ(client->line(), message("live.frame", 0, "7"));
  client.reset();
  EXPECT_TRUE(loses_last_subscriber("live.frame"));
}

TEST_F(Subscriptions, ASubscriberThatNeverReadsIsDropped) {
  RawClient slow(server_.path), other(server_.path);
  slow.ask(subscribe("live.frame", 20));
  slow.ask(subscribe("run.event", 0));
  other.ask(subscribe("run.event", 0));
  const std::string big = '"' + std::string(40000, 'x') + '"';
  for (int i = 0; i < 200; ++i) {
    publish("live.frame", big);
    publish("run.event", big);
    ASSERT_EQ(other.line().size(), message("run.event", 0, big).size());
  }
  EXPECT_TRUE(server_.connections_become(1)) << server_.log();
  EXPECT_NE(server_.log().find("dropped: the client has accepted no data for"), std::string::npos);
}

TEST_F(Subscriptions, ReportsMissedEventsToASlowSubscriber) {
  RawClient slow(server_.path);
  slow.ask(subscribe("run.event", 0));
  const std::string big = '"' + std::string(40000, 'x') + '"';
  for (int i = 0; i < 200; ++i) publish("run.event", big);
  int got = 0, missed = 0;
  for (; got + missed < 200; ++got) {
    const auto n = at(slow.line(), "/params/missed");
    ASSERT_NE(n, "");
    missed += std::stoi(n);
  }
  EXPECT_GT(missed, 0);
  EXPECT_EQ(got + missed, 200);
}

TEST_F(Subscriptions, AValueTooLargeForALineIsTheCallersError) {
  server_.on_loop([&] {
    EXPECT_FALSE(server_.service->publish("a", std::string(49152, '1')).has_value());
    EXPECT_FALSE(server_.service->publish("nothing", "1").has_value());
    return 0;
  });
}

TEST_F(Subscriptions, TheClientKeepsNotificationsBetweenReplies) {
  auto client = Client::connect(server_.path);
  ASSERT_TRUE(client.has_value());
  ASSERT_TRUE(client->call("live.subscribe", R"({"topic":"run.event"})").has_value());
  for (int i = 0; i < 3; ++i) publish("run.event", std::to_string(i));
  EXPECT_EQ(*client->call("get_data"), R"(["hello",5])");
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(client->next_notification(20s).value_or("none"),
              message("run.event", 0, std::to_string(i)));
  EXPECT_FALSE(client->next_notification(20ms).has_value());
}

}  // namespace
}  // namespace mdof::rpc::test
