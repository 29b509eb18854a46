#include "drivers/recording/recording_log.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "daemon/store/recording_writer.h"
#include "schema/units.h"

namespace mdof::drivers {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using store::RecordingWriter;

class RecordingTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "mdof-recording-XXXXXX").string();
    ASSERT_TRUE(mkdtemp(name.data()));
    folder_ = name;
    file_ = folder_ / "log.mdofrec";
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_, file_;
};

RecordingHeader header() {
  return {"0.1.0", "name = \"rig\"\n",  "[]", "", "2026-11-21T04:00:00Z",
          true,    R"({"note":"warm"})"};
}

constexpr std::int64_t kPeriodNs = 250'000;  // 4 kHz

// Scans first ... first + n - 1 of a made-up device.
SampleBlock block(std::int64_t first, std::int64_t n, const std::string& device = "probes") {
  SampleBlock b;
  b.device = device;
  b.channels = {{"A", Unit::um}, {"encoder", Unit::mm}};
  b.value.resize(2);
  for (std::int64_t i = first; i < first + n; ++i) {
    b.time_ns.push_back(7 * kNsPerS + i * kPeriodNs);
    b.value[0].push_back(std::sin(static_cast<double>(i)));
    b.value[1].push_back(1e-3 * static_cast<double>(i));
  }
  return b;
}

// `commits` commits of 1000 scans each; one chunk a commit.
void write(const fs::path& file, int commits, bool seal) {
  auto writer = RecordingWriter::create(file, header());
  ASSERT_TRUE(writer) << writer.error().message;
  for (int c = 0; c < commits; ++c) {
    ASSERT_TRUE(writer->append(block(1000 * c, 1000)));
    ASSERT_EQ(writer->commit().value(), c + 1);
  }
  if (seal) {
    ASSERT_TRUE(writer->finish("2026-11-21T04:01:00Z"));
  }
}

struct Outcome {
  Status status;
  std::vector<std::int64_t> time_ns;
  std::string sha256;
  std::vector<std::string> warnings;
};

Outcome read_all(const fs::path& file) {
  RecordingLog log("replay", file);
  Outcome outcome;
  outcome.status = log.open();
  SampleBlock b;
  while (outcome.status) {
    const auto state = log.read(b, milliseconds(0));
    if (!state) outcome.status = tl::unexpected(state.error());
    if (!state || *state == ReadState::end) break;
    outcome.time_ns.insert(outcome.time_ns.end(), b.time_ns.begin(), b.time_ns.end());
  }
  outcome.sha256 = log.sha256();
  outcome.warnings = log.warnings();
  return outcome;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put_contents(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Runs `body` in a child that sees `folder` read-only; skips where this machine does not let us.
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

TEST_F(RecordingTest, GivesBackWhatWasWrittenToTheSameBits) {
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
  EXPECT_EQ(log.progress(), 1.0);
}

TEST_F(RecordingTest, TellsItsHeaderChannelsAndRate) {
  write(file_, 2, true);
  RecordingLog log("replay", file_);
  ASSERT_TRUE(log.open());
  EXPECT_EQ(log.rig_text(), header().rig_text);
  EXPECT_EQ(log.header().started_utc, header().started_utc);
  EXPECT_TRUE(log.simulated());
  EXPECT_TRUE(log.info().simulated);
  EXPECT_EQ(log.info().channels, block(0, 1).channels);
  EXPECT_NEAR(log.info().rate_hz, 4000, 1e-6);
  EXPECT_TRUE(log.warnings().empty());
}

TEST_F(RecordingTest, FinishAndReaderAgreeOnTheHash) {
  auto writer = RecordingWriter::create(file_, header());
  ASSERT_TRUE(writer->append(block(0, 10)));
  const std::string sha256 = writer->finish("later").value();
  EXPECT_EQ(sha256.size(), 64u);
  EXPECT_EQ(read_all(file_).sha256, sha256);
}

TEST_F(RecordingTest, TheSameSamplesGiveTheSameHashAndOthersDoNot) {
  write(file_, 3, true);
  write(folder_ / "again.mdofrec", 3, true);
  write(folder_ / "longer.mdofrec", 4, true);
  EXPECT_EQ(read_all(file_).sha256, read_all(folder_ / "again.mdofrec").sha256);
  EXPECT_NE(read_all(file_).sha256, read_all(folder_ / "longer.mdofrec").sha256);
}

TEST_F(RecordingTest, OpensAgainFromTheStart) {
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

TEST_F(RecordingTest, KeepsDevicesAndLostScansApart) {
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

TEST_F(RecordingTest, AnUnsealedFileReadsUpToTheLastCommitWithAWarning) {
  {
    auto writer = RecordingWriter::create(file_, header());
    ASSERT_TRUE(writer->append(block(0, 1000)));
    ASSERT_EQ(writer->commit().value(), 1);
    ASSERT_TRUE(writer->append(block(1000, 1000)));  // never committed
    const Outcome live = read_all(file_);            // also while it is being written
    EXPECT_TRUE(live.status);
    EXPECT_EQ(live.time_ns.size(), 1000u);
  }
  const Outcome after = read_all(file_);
  EXPECT_TRUE(after.status);
  EXPECT_EQ(after.time_ns.size(), 1000u);
  ASSERT_EQ(after.warnings.size(), 1u);
  EXPECT_TRUE(contains(after.warnings[0], "chunk 1")) << after.warnings[0];
}

// 20 times: a child appends as fast as it can, is killed, and what it acknowledged is there.
TEST_F(RecordingTest, NothingAcknowledgedIsLostBySigkill) {
  for (int turn = 0; turn < 20; ++turn) {
    const fs::path file = folder_ / (std::to_string(turn) + ".mdofrec");
    int pipe_fd[2];
    ASSERT_EQ(pipe(pipe_fd), 0);
    const pid_t child = fork();
    if (child == 0) {
      auto writer = RecordingWriter::create(file, header());
      for (int c = 0;; ++c) {
        if (!writer->append(block(100 * c, 100))) _exit(1);
        const auto acknowledged = writer->commit();
        if (!acknowledged || ::write(pipe_fd[1], &*acknowledged, 8) != 8) _exit(1);
      }
    }
    close(pipe_fd[1]);
    std::int64_t acknowledged = 0;
    for (int k = 0; k < 3 + turn; ++k)
      if (::read(pipe_fd[0], &acknowledged, 8) != 8) break;
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    for (std::int64_t more = 0; ::read(pipe_fd[0], &more, 8) == 8;) acknowledged = more;
    close(pipe_fd[0]);
    ASSERT_GE(acknowledged, 3 + turn);
    const Outcome outcome = read_all(file);
    ASSERT_TRUE(outcome.status) << outcome.status.error().message;
    EXPECT_GE(outcome.time_ns.size(), 100 * static_cast<std::size_t>(acknowledged));
  }
}

TEST_F(RecordingTest, AFlippedBitNamesFileChunkSpanAndWhatIsStillWhole) {
  write(file_, 5, true);
  {
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
    ASSERT_TRUE(db->execute("DROP TRIGGER chunk_no_update"));
    ASSERT_TRUE(
        db->execute("UPDATE chunk SET payload = CAST(substr(payload, 1, 99) || x'00' || "
                    "substr(payload, 101) AS BLOB) WHERE seq = 3"));
  }
  const Outcome outcome = read_all(file_);
  ASSERT_FALSE(outcome.status);
  const std::string& message = outcome.status.error().message;
  EXPECT_EQ(outcome.status.error().code, ErrorCode::bad_input);
  EXPECT_EQ(outcome.time_ns.size(), 2000u);
  for (const char* part : {"log.mdofrec", "chunk 3 of 5", "0.500 s to 0.750 s", "chunks 1-2, 4-5"})
    EXPECT_TRUE(contains(message, part)) << message;
}

TEST_F(RecordingTest, AChunkTakenOutIsNoticed) {
  write(file_, 5, true);
  for (const int seq : {5, 2}) {  // the end first: only the seal knows of it
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
    ASSERT_TRUE(db->execute("DROP TRIGGER IF EXISTS chunk_no_delete"));
    ASSERT_TRUE(db->execute("DELETE FROM chunk WHERE seq = " + std::to_string(seq)));
    const Outcome outcome = read_all(file_);
    ASSERT_FALSE(outcome.status);
    EXPECT_TRUE(contains(outcome.status.error().message, seq == 5 ? "seal" : "chunk 2 of 4"))
        << outcome.status.error().message;
  }
}

TEST_F(RecordingTest, AChangedRigIsNoticed) {
  write(file_, 1, true);
  {
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
    ASSERT_TRUE(db->execute("DROP TRIGGER header_no_update"));
    ASSERT_TRUE(db->execute("UPDATE header SET value = 'name = \"gir\"' WHERE key = 'rig'"));
  }
  const Outcome outcome = read_all(file_);
  ASSERT_FALSE(outcome.status);
  EXPECT_TRUE(contains(outcome.status.error().message, "header"));
}

// Wherever a bit flips, the samples that come out are the right ones: as many as come.
TEST_F(RecordingTest, NoFlippedBitChangesASample) {
  write(file_, 5, true);
  const std::vector<std::int64_t> truth = read_all(file_).time_ns;
  const std::string sound = contents(file_);
  int noticed = 0, tried = 0;
  for (std::size_t byte = 0; byte < sound.size(); byte += 61, ++tried) {
    std::string flipped = sound;
    flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << (byte % 8)));
    put_contents(folder_ / "flipped.mdofrec", flipped);
    const Outcome outcome = read_all(folder_ / "flipped.mdofrec");
    ASSERT_LE(outcome.time_ns.size(), truth.size());
    EXPECT_TRUE(std::equal(outcome.time_ns.begin(), outcome.time_ns.end(), truth.begin()));
    if (outcome.status) {
      EXPECT_EQ(outcome.time_ns, truth) << "byte " << byte;
    } else {
      ++noticed;
    }
  }
  EXPECT_GT(noticed, tried / 3);  // the rest fell on bytes that mean nothing
}

TEST_F(RecordingTest, ACutFileIsAnError) {
  write(file_, 5, true);
  const std::string sound = contents(file_);
  for (const std::size_t size :
       {sound.size() - 4096, sound.size() / 2, std::size_t{5000}, std::size_t{100}}) {
    put_contents(folder_ / "cut.mdofrec", sound.substr(0, size));
    const Outcome outcome = read_all(folder_ / "cut.mdofrec");
    ASSERT_FALSE(outcome.status) << size;
    EXPECT_TRUE(contains(outcome.status.error().message, "cut.mdofrec"));
  }
}

TEST_F(RecordingTest, WhatIsNotARecordingIsRefusedByName) {
  EXPECT_EQ(read_all(folder_ / "absent.mdofrec").status.error().code, ErrorCode::not_found);
  put_contents(file_, "time_s,encoder_mm,A_um\n0,0,0\n" + std::string(1000, '#'));
  const Outcome text = read_all(file_);
  ASSERT_FALSE(text.status);
  EXPECT_EQ(text.status.error().code, ErrorCode::bad_input);
  EXPECT_TRUE(contains(text.status.error().message, "not a SQLite database"))
      << text.status.error().message;
  const fs::path other = folder_ / "other.db";
  ASSERT_TRUE(
      sqlite::Connection::open(other, sqlite::OpenMode::create)->execute("CREATE TABLE t(x)"));
  EXPECT_TRUE(contains(read_all(other).status.error().message, "not a recording"));
}

TEST_F(RecordingTest, ANewerFormatIsRefusedWithBothVersions) {
  write(file_, 1, true);
  ASSERT_TRUE(sqlite::Connection::open(file_, sqlite::OpenMode::read_write)
                  ->execute("PRAGMA user_version = 9"));
  const Outcome outcome = read_all(file_);
  ASSERT_FALSE(outcome.status);
  EXPECT_TRUE(contains(outcome.status.error().message, "format 9"));
  EXPECT_TRUE(
      contains(outcome.status.error().message, "up to " + std::to_string(kRecordingFormat)));
}

// Made by an mdof of before there was a format 2.
TEST_F(RecordingTest, AFileOfFormatOneIsReadAndCheckedAsItWasWritten) {
  const fs::path kept = MDOF_TEST_DATA "/devices/recordings/format-1/mcc_usb1608fs_plus.mdofrec";
  RecordingLog log("replay", kept);
  ASSERT_TRUE(log.open());
  EXPECT_EQ(log.header().format, 1);
  EXPECT_EQ(log.header().request, "");
  const Outcome outcome = read_all(kept);
  ASSERT_TRUE(outcome.status) << outcome.status.error().message;
  EXPECT_GT(outcome.time_ns.size(), 1000u);
}

TEST_F(RecordingTest, TheRequestIsKeptAndGuarded) {
  write(file_, 1, true);
  {
    RecordingLog log("replay", file_);
    ASSERT_TRUE(log.open());
    EXPECT_EQ(log.header().request, header().request);
  }
  const auto outcome_of = [&](const std::string& sql) {
    fs::copy_file(file_, folder_ / "changed.mdofrec", fs::copy_options::overwrite_existing);
    auto db = sqlite::Connection::open(folder_ / "changed.mdofrec", sqlite::OpenMode::read_write);
    EXPECT_TRUE(
        db->execute("DROP TRIGGER header_no_update; DROP TRIGGER header_no_delete; " + sql));
    return read_all(folder_ / "changed.mdofrec");
  };
  for (const char* sql : {"UPDATE header SET value = '{}' WHERE key = 'request'",
                          "DELETE FROM header WHERE key = 'request'",
                          "PRAGMA user_version = 1"}) {  // whose hash would leave it out
    const Outcome outcome = outcome_of(sql);
    ASSERT_FALSE(outcome.status) << sql;
    EXPECT_TRUE(contains(outcome.status.error().message, "header"))
        << outcome.status.error().message;
  }
  EXPECT_TRUE(outcome_of("").status);
}

TEST_F(RecordingTest, ReadingLeavesNothingBesideASealedFile) {
  write(file_, 2, true);
  const std::string before = contents(file_);
  ASSERT_TRUE(read_all(file_).status);
  EXPECT_EQ(contents(file_), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(RecordingTest, SealedAndUnsealedFilesAreReadInAReadOnlyFolder) {
  write(file_, 2, true);
  write(folder_ / "unsealed.mdofrec", 2, false);
  in_read_only_folder(folder_, [&] {
    return read_all(file_).time_ns.size() == 2000 &&
           read_all(folder_ / "unsealed.mdofrec").time_ns.size() == 2000;
  });
}

}  // namespace
}  // namespace mdof::drivers
