// For the tests of the store: a separate folder for each test, example runs, and changes to a file
// system.
#pragma once

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include "daemon/store/store.h"
#include "schema/sample.h"

namespace mdof::store {

namespace fs = std::filesystem;

class StoreTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "mdof-store-XXXXXX").string();
    ASSERT_TRUE(mkdtemp(name.data()));
    folder_ = name;
    file_ = folder_ / "mdof.db";
  }
  void TearDown() override { fs::remove_all(folder_); }
  Result<Store> writer() { return Store::open(file_, Access::read_write, {Durability::full, 50}); }
  Result<Store> reader() { return Store::open(file_, Access::read_only, {Durability::full, 50}); }
  // Executes SQL that does not use the store. It simulates an accidental change or a disk fault.
  void tamper(const std::string& sql) {
    auto connection = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
    ASSERT_TRUE(connection);
    const Status done = connection->execute(sql);
    ASSERT_TRUE(done) << done.error().message;
  }
  fs::path folder_, file_;
};

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

template <class Values>
std::vector<std::uint64_t> bits(const Values& values) {
  std::vector<std::uint64_t> all;
  for (const double x : values) all.push_back(std::bit_cast<std::uint64_t>(x));
  return all;
}

inline MeasuredPoint make_point(int target, int repetition) {
  std::mt19937_64 random(static_cast<std::uint64_t>(1000 * repetition + target));
  const auto any = [&] { return static_cast<double>(random()) * 1e-25 - 1e-6; };
  MeasuredPoint point;
  point.target = target;
  point.target_m = 0.01 * target;
  point.run = repetition;
  point.point.begin_ns = 1'000'000'000LL * target;
  point.point.end_ns = point.point.begin_ns + 500'000'000;
  point.point.position_m = 0.01 * target + any();
  point.point.direction = repetition % 2 ? 1 : -1;
  point.point.samples = 2000;
  for (int k = 0; k < 5; ++k) {
    point.point.probe_m.push_back(any());
    point.point.probe_u_m.push_back(1e-9);
  }
  if (target % 7 == 0) point.point.flags = {{Flag::spike, "A"}, {Flag::saturated, "\"B\""}};
  point.errors.valid = true;
  point.errors.reason.clear();
  for (double& x : point.errors.local) x = any();
  for (double& x : point.errors.covariance) x = any() * 1e-6;
  return point;
}

inline Run make_run(int points = 22, Axis axis = Axis::x) {
  Run run;
  run.header.axis = axis;
  run.header.state = RunState::complete;
  run.header.simulated = true;
  run.header.started_utc = "2026-11-21T04:00:00Z";
  run.header.note = "after shimming";
  run.header.scans = 123456;
  run.header.scans_lost = 7;
  run.header.notices = {notice(NoticeCode::probe_saturated, "B", {{"range_um", 200}}),
                        notice(NoticeCode::cycle_unknown)};
  run.header.provenance = {"csv",   "/data/log.csv", std::string(64, 'a'),  "name = \"rig\"\n",
                           "exact", "0.1.0",         R"({"settle_s":0.2})", ""};
  for (int i = 0; i < points; ++i) run.points.push_back(make_point(1 + i / 2, 1 + i % 2));
  run.straightness = {{"EYX_um", "forward", 1e-6, 2e-6, 3e-9, 4e-7, 5e-7, 0.01, -0.0}};
  run.angles = {{"EAX_urad", "mean", 1e-5, -2e-6, 3e-6}};
  return run;
}

inline CompensationTable make_table(std::vector<std::int64_t> runs, Axis axis = Axis::x) {
  CompensationTable table;
  table.axis = axis;
  table.runs = std::move(runs);
  table.position_m = {0.0, 0.01, 0.02};
  double x = 1e-7;
  for (auto* group : {&table.forward, &table.reverse, &table.u_forward, &table.u_reverse})
    for (auto& series : *group) series = {x += 1e-7, -0.0, x += 1e-7};
  table.created_utc = "2026-11-21T05:00:00Z";
  table.sha256 = std::string(64, 'b');
  return table;
}

// Exit code of a child process if the machine does not permit the test.
inline constexpr int kCannot = 77;

// Runs `body` in a child process after `prepare` has made the mounts of that process. Skips the
// test if the machine does not permit mounts.
template <class Prepare, class Body>
void with_private_mounts(Prepare prepare, Body body) {
  const pid_t child = fork();
  if (child == 0) {
    if (unshare(CLONE_NEWNS) != 0 ||
        mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 || !prepare())
      _exit(kCannot);
    _exit(body() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kCannot)
    GTEST_SKIP() << "mounting needs root; not tested here";
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "see the messages above";
}

inline bool mount_read_only(const fs::path& folder) {
  return mount(folder.c_str(), folder.c_str(), nullptr, MS_BIND, nullptr) == 0 &&
         mount("none", folder.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) == 0;
}

inline bool mount_small_disk(const fs::path& folder, const char* size) {
  return mount("tmpfs", folder.c_str(), "tmpfs", 0, size) == 0;
}

inline VolumetricTable make_volume(const std::vector<std::int64_t>& runs = {}) {
  VolumetricTable t;
  t.name = "mill";
  t.machine = chain_from("w-X-b-Y-C-t", "X- Y+ C+").value();
  t.description = "name = \"mill\"\n";
  t.runs = runs;
  t.simulated = true;
  t.approach = "reverse";
  t.tool_m = {1e-3, -0.0, 0.1};
  t.rotary_rad = {0, 0, 0.5};
  t.command_m = {{{0, 0.01}, {-0.02, 0.05, 0.06}, {0.03}}};
  for (int i = 0; i < 6; ++i) {
    t.correction_m.push_back({1e-6 / 3 * i, -0.0, 7e-7});
    t.u_m.push_back({1e-8, kNaN, 3e-8 * i});
    t.u_independent_m.push_back({5e-9, 0, 1e-8 * i});
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (t.command_m[k].size() > 1) t.noise[k].resize(t.command_m[k].size());
  for (auto& axis : t.noise)
    for (auto& node : axis) node.covariance_with_next[2] = {1e-18 / 3, 0, -2e-18, 0, 0, 3e-18};
  t.interpolation_m = {1e-9, 2e-9, 3e-9};
  t.u_between_m = {{{{1e-9, 2e-9, 7e-9}}, {{3e-9, 0, 4e-9}, {5e-9, 6e-9, 1e-9 / 3}}, {}}};
  t.reversal_m = {5e-9, 0, 6e-9};
  t.place_left_m = 4e-9;
  t.turn_left_rad = 5e-6;
  t.not_measured = {"EZZ", "EA0Z"};
  t.beyond_tables = {"EXX"};
  t.doubtful = {notice(NoticeCode::run_partial)};
  t.created_utc = "utc";
  t.sha256 = volumetric_sha256(t);
  return t;
}

}  // namespace mdof::store
