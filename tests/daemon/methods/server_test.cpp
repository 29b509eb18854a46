// The methods server.info, device.list, live.subscribe, live.unsubscribe, encoder.set and
// run.replay.
#include <fstream>

#include "drivers/clock/monotonic.h"
#include "schema/units.h"
#include "tests/daemon/methods/methods_fixture.h"

namespace mdof::daemon {
namespace {

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

class ServerMethods : public MethodsTest {
 protected:
  // Writes the CSV log of an axis with known errors, in the format that a user exports. Returns
  // its path.
  std::string write_log() {
    TestAxis axis;
    axis.pass_both_ways({0, 5, 10});
    const SampleBlock block = axis.whole();
    const auto file = folder_ / "log.csv";
    std::ofstream out(file);
    out.precision(12);
    out << "time_s,encoder_mm,A_um,B_um,C_um,D_um,E_um\n";
    for (std::size_t i = 0; i < block.scans(); ++i) {
      out << 1e-9 * static_cast<double>(block.time_ns[i]);
      for (std::size_t c = 0; c < 6; ++c) out << "," << block.value[c][i];
      out << "\n";
    }
    return file.string();
  }
  std::string replay_of(const std::string& path, const std::string& more = "") {
    JsonWriter json;
    json.begin_object().field("path", path).field("rig", five_probe_rig().text).end_object();
    std::string params = json.take();
    params.insert(params.size() - 1, more);
    return params;
  }
};

TEST_F(ServerMethods, ReportsItsState) {
  add_axis();
  const Answer info = call("server.info");
  EXPECT_EQ(info.at("/result/server"), "\"mdofd\"");
  EXPECT_EQ(info.at("/result/storage"), "\"ok\"");
  EXPECT_EQ(info.at("/result/storage_reason"), "null");
  EXPECT_EQ(info.at("/result/database"), "\"" + (folder_ / "mdof.db").string() + "\"");
  EXPECT_EQ(info.at("/result/axes/0/axis"), "\"X\"");
  EXPECT_EQ(info.at("/result/axes/0/rig"), "\"five-probe fixture, X axis\"");
  EXPECT_EQ(info.at("/result/axes/0/devices"), "[\"daq\"]");
  EXPECT_EQ(info.at("/result/axes/0/run"), "null");
  EXPECT_EQ(info.at("/result/axes/0/simulated"), "false");
  EXPECT_GE(info.number("/result/uptime_s"), 0);
}

TEST_F(ServerMethods, ListsDevicesWithTheirAxisAndState) {
  EXPECT_EQ(call("device.list").at("/result/devices"), "[]");
  add_axis();
  TestAxis axis(3);
  axis.stand(0.5);
  feed_->give(axis.whole());
  feed_->wait_until_read();
  for (int i = 0; i < 200 && call("device.list").number("/result/devices/0/scans") < 500; ++i)
    ::usleep(10'000);
  const Answer list = call("device.list");
  EXPECT_EQ(list.at("/result/devices/0/axis"), "\"X\"");
  EXPECT_EQ(list.at("/result/devices/0/device"), "\"daq\"") << list.text();
  EXPECT_EQ(list.at("/result/devices/0/state"), "\"open\"");
  EXPECT_EQ(list.number("/result/devices/0/scans"), 500);
}

TEST_F(ServerMethods, ReportsTheFixtureWithTheEndsOfItsRanges) {
  EXPECT_EQ(call("rig.get", R"({"axis":"X"})").code(), rpc::kNotFound);
  add_axis();
  const Answer rig = call("rig.get", R"({"axis":"X"})");
  ASSERT_EQ(rig.size("/result/probes"), 5u) << rig.text();
  EXPECT_EQ(rig.at("/result/probes/0/id"), "\"A\"");
  EXPECT_EQ(rig.at("/result/probes/0/due"), "null");
  EXPECT_EQ(rig.at("/result/notices"), "[]");
  const Rig configured = five_probe_rig();
  for (std::size_t k = 0; k < 5; ++k) {
    const std::string at = "/result/probes/" + std::to_string(k);
    EXPECT_EQ(rig.number(at + "/range_um"), to_um(configured.probes[k].range_m));
    EXPECT_NEAR(rig.number(at + "/low_um"), -to_um(configured.probes[k].range_m) / 2, 0.1);
    EXPECT_NEAR(rig.number(at + "/high_um"), to_um(configured.probes[k].range_m) / 2, 0.1);
    for (int d = 0; d < 3; ++d)
      EXPECT_EQ(rig.number(at + "/direction/" + std::to_string(d)),
                configured.probes[k].direction[static_cast<std::size_t>(d)]);
  }
}

TEST_F(ServerMethods, ReportsTheFreeDiskSpace) {
  const Answer health = call("server.health");
  EXPECT_GT(health.number("/result/free_bytes"), 0) << health.text();
  EXPECT_GE(health.number("/result/database_bytes"), 4096);  // the size of one SQLite page
  EXPECT_EQ(health.at("/result/newest_recording"), "null");
  add_run();  // this run is from a CSV log, so there is still no recording
  EXPECT_EQ(call("server.health").at("/result/newest_recording"), "null");
}

TEST_F(ServerMethods, ReportsALostDatabaseAndStoresNothing) {
  add_axis();
  std::filesystem::rename(folder_ / "mdof.db", folder_ / "aside.db");
  Answer info = call("server.info");
  for (int i = 0; i < 200 && info.at("/result/storage") == "\"ok\""; ++i) {
    ::usleep(10'000);
    info = call("server.info");
  }
  EXPECT_EQ(info.at("/result/storage"), "\"lost\"");
  EXPECT_HAS(info.at("/result/storage_reason"), "was deleted");
  for (const auto& [name, params] :
       std::map<std::string, std::string>{{"run.start", R"({"axis":"X"})"},
                                          {"squareness.fit", R"({"run_x":1,"run_y":2})"},
                                          {"compensation.build", R"({"runs":[1]})"},
                                          {"compensation.activate", R"({"table":1})"},
                                          {"compensation.deactivate", R"({"axis":"X"})"}}) {
    const Answer refused = call(name, params);
    EXPECT_EQ(refused.code(), rpc::kIo) << refused.text();
    EXPECT_HAS(refused.message(), "was deleted");
  }
}

TEST_F(ServerMethods, SubscribesToLiveViewAndEventsAndUnsubscribes) {
  const Answer both = call("live.subscribe", R"({"interval_ms":200})");
  EXPECT_EQ(both.at("/result/interval_ms"), "200");
  using Subscribed = std::vector<std::pair<std::string, std::chrono::milliseconds>>;
  EXPECT_EQ(bench_->caller.subscribed, (Subscribed{{kLiveTopic, std::chrono::milliseconds(200)},
                                                   {kRunTopic, std::chrono::milliseconds(0)}}));
  EXPECT_EQ(call("live.unsubscribe").at("/result"), "{}");
  EXPECT_TRUE(bench_->caller.subscribed.empty());
  EXPECT_EQ(call("live.subscribe", R"({"events":false})").at("/result/interval_ms"), "100");
  EXPECT_EQ(bench_->caller.subscribed, (Subscribed{{kLiveTopic, std::chrono::milliseconds(100)}}));
  EXPECT_EQ(call("live.subscribe", R"({"interval_ms":19})").code(), rpc::kInvalidParams);
  EXPECT_EQ(call("live.subscribe", R"({"interval_ms":20})").code(), 0);
}

TEST_F(ServerMethods, SetsTheEncoderOnlyIfItHasSentSamples) {
  EXPECT_EQ(call("encoder.set", R"({"axis":"X","position_mm":1})").code(), rpc::kNotFound);
  add_axis();
  const Answer nothing = call("encoder.set", R"({"axis":"X","position_mm":1})");
  EXPECT_EQ(nothing.code(), rpc::kConflict);
  EXPECT_HAS(nothing.message(), "the encoder has sent no sample");
  TestAxis axis(3);
  axis.stand(2);
  Answer set = nothing;
  // Repeated, because a busy machine may be too slow.
  for (int i = 0; i < 20 && set.code() != 0; ++i) {
    SampleBlock block = axis.whole();
    const std::int64_t shift_ns = drivers::monotonic_ns() - block.time_ns.back();
    for (auto& time_ns : block.time_ns) time_ns += shift_ns;
    feed_->give(block);
    feed_->wait_until_read();
    ::usleep(20'000);
    set = call("encoder.set", R"({"axis":"X","position_mm":12.5})");
  }
  EXPECT_NEAR(set.number("/result/offset_mm"), 9.5, 1e-9) << set.text();
  EXPECT_EQ(set.number("/result/position_mm"), 12.5);
  EXPECT_EQ(set.at("/result/axis"), "\"X\"");
  EXPECT_EQ(set.at("/result/device"), "\"daq\"");
}

TEST_F(ServerMethods, ReplaysALogThatTheCallerMayRead) {
  bench_->replayer = std::make_unique<Replayer>(*bench_->keeper);
  bench_->methods.replayer = bench_->replayer.get();
  bench_->caller.who = rpc::Credentials{0, 0, 1};
  const std::string log = write_log();
  const Answer done = call("run.replay", replay_of(log, R"(,"note":"again")"));
  ASSERT_EQ(done.at("/result/run"), "1") << done.text();
  const Answer run = call("run.get", R"({"run":1})");
  EXPECT_EQ(run.number("/result/points_total"), 6);
  EXPECT_EQ(run.at("/result/note"), "\"again\"");
  EXPECT_EQ(call("history.list").at("/result/history/0/deed"), "\"run.replay\"");
  const auto by_target = call("run.replay", replay_of(log, R"(,"targets_mm":[5])"));
  EXPECT_EQ(call("run.get", R"({"run":2})").number("/result/points_total"), 2) << by_target.text();
  EXPECT_HAS(call("run.replay", replay_of(log, R"(,"model":"elastic")")).message(), "model");
  EXPECT_HAS(call("run.replay", replay_of(log, R"(,"min_length_s":0)")).message(), "min_length_s");
  EXPECT_HAS(call("run.replay", R"({"path":")" + log + "\"}").message(), "contains no rig");
  const Answer no_rig = call("run.replay", R"({"path":")" + log + R"(","rig":"name = 1"})");
  EXPECT_EQ(no_rig.code(), rpc::kBadInput) << no_rig.text();
}

TEST_F(ServerMethods, RejectsALogThatTheCallerMayNotRead) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root gives a file to others";
  bench_->replayer = std::make_unique<Replayer>(*bench_->keeper);
  bench_->methods.replayer = bench_->replayer.get();
  const std::string log = write_log();
  constexpr uid_t kOwner = 2001, kOther = 2002;
  constexpr gid_t kGroup = 3001, kAnother = 3002;
  ASSERT_EQ(::chown(log.c_str(), kOwner, kGroup), 0);
  const auto may_read = [&](uid_t uid, gid_t gid, mode_t mode) {
    EXPECT_EQ(::chmod(log.c_str(), mode), 0);
    bench_->caller.who = rpc::Credentials{uid, gid, 42};
    const Answer answer = call("run.replay", replay_of(log));
    if (answer.code() != 0) {
      EXPECT_HAS(answer.message(), "you have no permission to read");
    }
    return answer.code() == 0;
  };
  EXPECT_TRUE(may_read(kOwner, kAnother, 0400));
  EXPECT_FALSE(may_read(kOwner, kGroup, 0044)) << "an owner without the right";
  EXPECT_TRUE(may_read(kOther, kGroup, 0040));
  EXPECT_FALSE(may_read(kOther, kGroup, 0404)) << "a member of the group without the right";
  EXPECT_TRUE(may_read(kOther, kAnother, 0004));
  EXPECT_FALSE(may_read(kOther, kAnother, 0440)) << "anybody else";
  EXPECT_TRUE(may_read(0, 0, 0));
  // A file whose group is the group of mdofd, for example a recording, may be read by all users of
  // the socket.
  ASSERT_EQ(::chown(log.c_str(), kOwner, ::getegid()), 0);
  EXPECT_TRUE(may_read(kOther, kAnother, 0440));
  bench_->caller.who.reset();
  EXPECT_HAS(call("run.replay", replay_of(log)).message(), "only over the Unix socket");
}

TEST_F(ServerMethods, RejectsAPathThatIsNotALog) {
  EXPECT_HAS(call("run.replay", replay_of(write_log())).message(), "cannot replay or import files");
  bench_->replayer = std::make_unique<Replayer>(*bench_->keeper);
  bench_->methods.replayer = bench_->replayer.get();
  EXPECT_HAS(call("run.replay", replay_of("log.csv")).message(), "must be absolute");
  EXPECT_HAS(call("run.replay", replay_of("/nowhere/log.csv")).message(), "No such file");
  EXPECT_HAS(call("run.replay", replay_of(folder_.string())).message(), "is not a regular file");
}

}  // namespace
}  // namespace mdof::daemon
