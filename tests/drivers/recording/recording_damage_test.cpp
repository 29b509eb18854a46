// Recordings that are truncated, damaged or changed, and files that are not recordings.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/drivers/recording/recording_fixture.h"

namespace mdof::drivers {
namespace {

// A child process appends samples as fast as possible and is killed. All acknowledged samples must
// be in the file. The test does this 20 times.
TEST_F(RecordingTest, SigkillLosesNoAcknowledgedSamples) {
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

TEST_F(RecordingTest, ErrorNamesTheDamagedChunkAndTheSoundChunks) {
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

TEST_F(RecordingTest, DetectsARemovedChunk) {
  write(file_, 5, true);
  // Chunk 5 is removed first, because only the seal contains the number of chunks.
  for (const int seq : {5, 2}) {
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
    ASSERT_TRUE(db->execute("DROP TRIGGER IF EXISTS chunk_no_delete"));
    ASSERT_TRUE(db->execute("DELETE FROM chunk WHERE seq = " + std::to_string(seq)));
    const Outcome outcome = read_all(file_);
    ASSERT_FALSE(outcome.status);
    EXPECT_TRUE(contains(outcome.status.error().message, seq == 5 ? "seal" : "chunk 2 of 4"))
        << outcome.status.error().message;
  }
}

TEST_F(RecordingTest, DetectsAChangedRig) {
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

// An inverted bit never changes a sample. Reading either returns all samples, or reports the
// damage and returns fewer samples.
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
  EXPECT_GT(noticed, tried / 3);  // SQLite and the recording do not use the other bytes
}

TEST_F(RecordingTest, TruncatedFileIsAnError) {
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

TEST_F(RecordingTest, RefusesOtherFilesByName) {
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

TEST_F(RecordingTest, RefusesANewerFormatWithBothVersions) {
  write(file_, 1, true);
  ASSERT_TRUE(sqlite::Connection::open(file_, sqlite::OpenMode::read_write)
                  ->execute("PRAGMA user_version = 9"));
  const Outcome outcome = read_all(file_);
  ASSERT_FALSE(outcome.status);
  EXPECT_TRUE(contains(outcome.status.error().message, "format 9"));
  EXPECT_TRUE(
      contains(outcome.status.error().message, "up to " + std::to_string(kRecordingFormat)));
}

TEST_F(RecordingTest, RequestIsStoredAndProtected) {
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
                          // The hash of format 1 does not include the request.
                          "PRAGMA user_version = 1"}) {
    const Outcome outcome = outcome_of(sql);
    ASSERT_FALSE(outcome.status) << sql;
    EXPECT_TRUE(contains(outcome.status.error().message, "header"))
        << outcome.status.error().message;
  }
  EXPECT_TRUE(outcome_of("").status);
}

}  // namespace
}  // namespace mdof::drivers
