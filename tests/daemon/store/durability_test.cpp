// The store with a full disk, with a killed writer and with concurrent readers.
#include <fcntl.h>
#include <sys/resource.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "daemon/store/recording_writer.h"
#include "daemon/store/store.h"
#include "tests/daemon/store/fixtures.h"
#include "tests/shown.h"

namespace mdof::store {
namespace {

// Adds runs until the disk is full. Then frees space and adds a run again. Returns true if all
// stored runs are valid and the store works again.
bool survives_full_disk(const fs::path& folder) {
  const fs::path ballast = folder / "ballast", file = folder / "mdof.db";
  {
    const int fd = ::open(ballast.c_str(), O_CREAT | O_WRONLY, 0600);
    if (fd < 0 || posix_fallocate(fd, 0, 1 << 20) != 0) return false;
    ::close(fd);
  }
  auto store = Store::open(file, Access::read_write);
  if (!store) return false;
  std::int64_t stored = 0;
  Result<std::int64_t> last = 0;
  while ((last = store->add_run(make_run(200)))) stored = *last;
  std::fprintf(stderr, "%s\n", last.error().message.c_str());
  if (last.error().code != ErrorCode::io || !contains(last.error().message, "free some space"))
    return false;
  if (store->count_runs().value() != stored || !store->verify()->empty()) return false;
  fs::remove(ballast);
  const auto again = store->add_run(make_run(200));  // the same store object must work again
  return again && *again == stored + 1 && store->verify()->empty();
}

bool recording_survives_full_disk(const fs::path& folder) {
  const fs::path ballast = folder / "ballast";
  {
    const int fd = ::open(ballast.c_str(), O_CREAT | O_WRONLY, 0600);
    if (fd < 0 || posix_fallocate(fd, 0, 1 << 20) != 0) return false;
    ::close(fd);
  }
  auto writer = RecordingWriter::create(folder / "log.mdofrec", {});
  std::mt19937_64 random(1);
  SampleBlock block{"d", {{"A", Unit::um}}, {}, {{}}, {}, 0};
  Result<std::int64_t> acknowledged = 0;
  std::int64_t appended = 0, t_ns = 0, last = 0;
  while (acknowledged) {
    block.time_ns.clear();
    block.value[0].clear();
    for (int i = 0; i < 1000; ++i) {
      block.time_ns.push_back(t_ns += 250'000);
      block.value[0].push_back(static_cast<double>(random()));
    }
    if (!writer->append(block)) return false;
    ++appended;
    acknowledged = writer->commit();
    if (acknowledged) last = *acknowledged;
  }
  std::fprintf(stderr, "%s\n", acknowledged.error().message.c_str());
  if (last != appended - 1) return false;
  fs::remove(ballast);
  // If the store accepted data before the disk was full, it must still have them.
  return writer->commit().value_or(0) == appended && writer->finish("later");
}

TEST_F(StoreTest, AFullDiskIsReportedAndRecoveredFrom) {
  with_private_mounts([&] { return mount_small_disk(folder_, "size=3M"); },
                      [&] { return survives_full_disk(folder_); });
}

TEST_F(StoreTest, ARecordingSurvivesAFullDisk) {
  with_private_mounts([&] { return mount_small_disk(folder_, "size=3M"); },
                      [&] { return recording_survives_full_disk(folder_); });
}

// A limit of the file size has the same effect as a full disk, and needs no root.
TEST_F(StoreTest, AFileThatCannotGrowStoresNothingPartly) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{600'000, 600'000};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(1);
    auto store = writer();
    std::int64_t stored = 0;
    Result<std::int64_t> last = 0;
    while ((last = store->add_run(make_run(100)))) stored = *last;
    std::fprintf(stderr, "%s\n", last.error().message.c_str());
    _exit(stored > 0 && last.error().code == ErrorCode::io &&
                  store->count_runs().value() == stored && store->verify()->empty()
              ? 0
              : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(writer()->add_run(make_run(100)));  // the limit no longer applies
  EXPECT_TRUE(reader()->verify()->empty());
}

// Appends points to a run until the process is killed. Reports each stored row through the pipe.
[[noreturn]] void append_until_killed(const fs::path& file, int pipe_fd) {
  auto store = Store::open(file, Access::read_write);
  if (!store) _exit(1);
  const auto run = store->begin_run(make_run().header);
  for (std::int64_t rows = 1;; ++rows) {
    if (!run || !store->append_points(*run, {make_point(1, 1)})) _exit(1);
    if (::write(pipe_fd, &rows, sizeof rows) != sizeof rows) _exit(1);
  }
}

TEST_F(StoreTest, NothingAcknowledgedIsLostBySigkill) {
  for (int turn = 1; turn <= 30; ++turn) {
    int fds[2];
    ASSERT_EQ(pipe(fds), 0);
    const pid_t child = fork();
    if (child == 0) append_until_killed(file_, fds[1]);
    close(fds[1]);
    std::int64_t acknowledged = 0;
    while (acknowledged < turn && ::read(fds[0], &acknowledged, 8) == 8) continue;
    std::this_thread::sleep_for(std::chrono::microseconds(317 * turn));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    for (std::int64_t more = 0; ::read(fds[0], &more, 8) == 8;) acknowledged = more;
    close(fds[0]);
    ASSERT_GE(acknowledged, turn);
    EXPECT_EQ(reader()->run_header(turn)->state, RunState::aborted);
    auto store = writer();
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_GE(store->count_points(turn).value(), acknowledged);
    EXPECT_EQ(test::shown(store->run_header(turn)->notices), "interrupted\n");
    const auto findings = store->verify();
    ASSERT_TRUE(findings && findings->empty());
  }
}

// Each reader gets only complete runs. It gets at least the runs that existed when it began to
// read.
TEST_F(StoreTest, TwoReadersSeeWholeRunsWhileOneWrites) {
  auto store = writer();
  ASSERT_TRUE(store->add_run(make_run(40)));
  std::atomic<bool> done = false;
  std::atomic<int> looks = 0, wrong = 0;
  const auto look = [&] {
    auto own = reader();
    std::int64_t before = 0;
    while (!done) {
      const auto count = own->count_runs();
      const auto newest = own->list_runs(0, 1);
      if (!count || !newest || *count < before) {
        ++wrong;
        continue;
      }
      before = *count;
      const auto run = own->run(newest->front().id);
      if (!run || run->points.size() != 40 || run->header.state != RunState::complete) ++wrong;
      ++looks;
    }
  };
  std::thread one(look), two(look);
  for (int i = 0; i < 100 || looks < 50; ++i) EXPECT_TRUE(store->add_run(make_run(40)));
  done = true;
  one.join();
  two.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace mdof::store
