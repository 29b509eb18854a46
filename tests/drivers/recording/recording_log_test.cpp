#include "drivers/recording/recording_log.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>

#include "tests/drivers/recording/recording_fixture.h"
#include "tests/shown.h"

namespace mdof::drivers {
namespace {

// Runs `body` in a child process in which `folder` is mounted read-only. Skips the test if this
// machine does not permit it.
template <class Body>
void in_read_only_folder(const fs::path& folder, Body body) {
  constexpr int kCannot = 77;
  const pid_t child = fork();
  if (child == 0) {
    if (unshare(CLONE_NEWNS) != 0 ||
        mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount(folder.c_str(), folder.c_str(), nullptr, MS_BIND, nullptr) != 0 ||
        mount("none", folder.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) != 0)
      _exit(kCannot);
    _exit(body() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kCannot)
    GTEST_SKIP() << "a read-only mount needs root; not tested here";
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST_F(RecordingTest, ReturnsTheWrittenSamplesBitForBit) {
  SampleBlock first = block(0, 3000), second = block(3000, 500);
  first.value[0][17] = std::bit_cast<double>(0x7ff8dead'beef0001);
  first.quality = {std::vector<Quality>(3000, Quality::simulated), {}};
  {
    auto writer = RecordingWriter::create(file_, header());
    ASSERT_TRUE(writer->append(first));
    ASSERT_TRUE(writer->append(second));
    ASSERT_TRUE(writer->finish("later"));
  }
  RecordingLog log("replay", file_);
  ASSERT_TRUE(log.open());
  SampleBlock b;
  ASSERT_EQ(log.read(b, milliseconds(0)).value(), ReadState::more);
  ASSERT_EQ(b.scans(), 3500u);
  for (std::size_t i = 0; i < b.scans(); ++i) {
    const SampleBlock& from = i < 3000 ? first : second;
    const std::size_t at = i < 3000 ? i : i - 3000;
    EXPECT_EQ(b.time_ns[i], from.time_ns[at]);
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(b.value[c][i]),
                std::bit_cast<std::uint64_t>(from.value[c][at]));
      EXPECT_EQ(b.quality_at(c, i), from.quality_at(c, at));
    }
  }
  EXPECT_EQ(log.read(b, milliseconds(0)).value(), ReadState::end);
  EXPECT_GT(log.progress().total, 0);
  EXPECT_EQ(log.progress().done, log.progress().total);
}

TEST_F(RecordingTest, ReturnsItsHeaderChannelsAndRate) {
  write(file_, 2, true);
  RecordingLog log("replay", file_);
  ASSERT_TRUE(log.open());
  EXPECT_EQ(log.rig_text(), header().rig_text);
  EXPECT_EQ(log.header().started_utc, header().started_utc);
  EXPECT_TRUE(log.simulated());
  EXPECT_TRUE(log.info().simulated);
  EXPECT_EQ(log.info().channels, block(0, 1).channels);
  EXPECT_NEAR(log.info().rate_hz, 4000, 1e-6);
  EXPECT_TRUE(log.notices().empty());
}

TEST_F(RecordingTest, FinishAndReaderGiveTheSameHash) {
  auto writer = RecordingWriter::create(file_, header());
  ASSERT_TRUE(writer->append(block(0, 10)));
  const std::string sha256 = writer->finish("later").value();
  EXPECT_EQ(sha256.size(), 64u);
  EXPECT_EQ(read_all(file_).sha256, sha256);
}

TEST_F(RecordingTest, HashDependsOnTheSamples) {
  write(file_, 3, true);
  write(folder_ / "again.mdofrec", 3, true);
  write(folder_ / "longer.mdofrec", 4, true);
  EXPECT_EQ(read_all(file_).sha256, read_all(folder_ / "again.mdofrec").sha256);
  EXPECT_NE(read_all(file_).sha256, read_all(folder_ / "longer.mdofrec").sha256);
}

TEST_F(RecordingTest, OpensAgainFromTheBeginning) {
  write(file_, 2, true);
  RecordingLog log("replay", file_);
  SampleBlock b;
  for (int turn = 0; turn < 2; ++turn) {
    ASSERT_TRUE(log.open());
    ASSERT_TRUE(log.read(b, milliseconds(0)));
    EXPECT_EQ(b.time_ns.front(), 7 * kNsPerS);
    EXPECT_EQ(log.info().channels.size(), 2u);
  }
}

TEST_F(RecordingTest, KeepsDevicesAndLostScansSeparate) {
  {
    auto writer = RecordingWriter::create(file_, header());
    ASSERT_TRUE(writer->append(block(0, 10, "b")));
    ASSERT_TRUE(writer->append(block(0, 5, "a")));
    SampleBlock late = block(20, 10, "b");
    late.lost = 10;
    ASSERT_TRUE(writer->append(late));
    EXPECT_EQ(writer->lost(), 10u);
    ASSERT_TRUE(writer->finish("later"));
  }
  RecordingLog log("replay", file_);
  ASSERT_TRUE(log.open());
  EXPECT_EQ(log.info().channels.size(), 4u);
  std::vector<std::pair<std::string, std::uint64_t>> seen;
  SampleBlock b;
  while (log.read(b, milliseconds(0)).value() == ReadState::more)
    seen.push_back({b.device, b.lost});
  EXPECT_EQ(seen, (decltype(seen){{"b", 0}, {"a", 0}, {"b", 10}}));
}

// The writer was interrupted. Its last chunks are only in the -wal file.
TEST_F(RecordingTest, ReadsThroughOpenDescriptors) {
  const fs::path copy = folder_ / "copy.mdofrec", wal = copy.string() + "-wal";
  {
    auto writer = RecordingWriter::create(file_, header());
    ASSERT_TRUE(writer->append(block(0, 1000)));
    ASSERT_EQ(writer->commit().value(), 1);
    fs::copy_file(file_, copy);
    fs::copy_file(file_.string() + "-wal", wal);
  }
  const int file_fd = ::open(copy.c_str(), O_RDONLY), wal_fd = ::open(wal.c_str(), O_RDONLY);
  for (const fs::path& name : {copy, wal}) {
    fs::remove(name);
    std::ofstream(name) << "something else";
  }
  EXPECT_TRUE(is_recording(file_fd));
  RecordingLog log("replay", copy, {file_fd, wal_fd});
  const Status opened = log.open();
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(log.info().channels.size(), 2u);
  SampleBlock b;
  ASSERT_EQ(log.read(b, milliseconds(0)).value(), ReadState::more);
  EXPECT_EQ(b.time_ns, block(0, 1000).time_ns);
  EXPECT_EQ(b.value, block(0, 1000).value);
  EXPECT_EQ(log.read(b, milliseconds(0)).value(), ReadState::end);
  ASSERT_EQ(log.notices().size(), 1u);  // the recording is not sealed
  EXPECT_FALSE(RecordingLog("replay", copy, {file_fd, -1}).open()) << "all of it is in the -wal";
  ::close(file_fd);
  ::close(wal_fd);
  for (const fs::path& name : {copy, wal}) EXPECT_EQ(fs::file_size(name), 14u);
  EXPECT_FALSE(fs::exists(copy.string() + "-shm"));
}

TEST_F(RecordingTest, UnsealedFileIsReadToTheLastCommit) {
  {
    auto writer = RecordingWriter::create(file_, header());
    ASSERT_TRUE(writer->append(block(0, 1000)));
    ASSERT_EQ(writer->commit().value(), 1);
    ASSERT_TRUE(writer->append(block(1000, 1000)));  // these scans are never committed
    const Outcome live = read_all(file_);            // reads while the writer is open
    EXPECT_TRUE(live.status);
    EXPECT_EQ(live.time_ns.size(), 1000u);
  }
  const Outcome after = read_all(file_);
  EXPECT_TRUE(after.status);
  EXPECT_EQ(after.time_ns.size(), 1000u);
  ASSERT_EQ(after.notices.size(), 1u);
  EXPECT_EQ(after.notices[0].code, NoticeCode::recording_not_sealed);
  EXPECT_EQ(test::number(after.notices[0], "chunk"), 1);
}

// An mdof version before format 2 wrote this file.
TEST_F(RecordingTest, ReadsAndChecksAFileOfFormatOne) {
  const fs::path kept = MDOF_TEST_DATA "/devices/recordings/format-1/mcc_usb1608fs_plus.mdofrec";
  RecordingLog log("replay", kept);
  ASSERT_TRUE(log.open());
  EXPECT_EQ(log.header().format, 1);
  EXPECT_EQ(log.header().request, "");
  const Outcome outcome = read_all(kept);
  ASSERT_TRUE(outcome.status) << outcome.status.error().message;
  EXPECT_GT(outcome.time_ns.size(), 1000u);
}

TEST_F(RecordingTest, ReadingASealedFileLeavesNoFiles) {
  write(file_, 2, true);
  const std::string before = contents(file_);
  ASSERT_TRUE(read_all(file_).status);
  EXPECT_EQ(contents(file_), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(RecordingTest, ReadsFilesInAReadOnlyFolder) {
  write(file_, 2, true);
  write(folder_ / "unsealed.mdofrec", 2, false);
  in_read_only_folder(folder_, [&] {
    return read_all(file_).time_ns.size() == 2000 &&
           read_all(folder_ / "unsealed.mdofrec").time_ns.size() == 2000;
  });
}

}  // namespace
}  // namespace mdof::drivers
