#include "schema/base/database/journal_watch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "schema/base/sqlite/sqlite.h"

namespace mdof::sqlite {
namespace {

namespace fs = std::filesystem;

class WatchedJournal : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "mdof-watch-XXXXXX").string();
    ASSERT_TRUE(mkdtemp(name.data()));
    folder_ = name;
    file_ = folder_ / "mdof.db";
    wal_ = file_.string() + "-wal";
    shm_ = file_.string() + "-shm";
  }
  void TearDown() override { fs::remove_all(folder_); }

  Connection writer() const {
    auto db = Connection::open(file_, OpenMode::create).value();
    EXPECT_TRUE(db.execute("PRAGMA journal_mode = WAL; CREATE TABLE IF NOT EXISTS t (x)"));
    db.watch_journal();
    return db;
  }
  // Inserts a row in a transaction. If this succeeds, the row is acknowledged.
  static Status insert(Connection& db) {
    MDOF_TRY(Transaction transaction, Transaction::begin(db));
    MDOF_CHECK(db.execute("INSERT INTO t VALUES (1)"));
    return transaction.commit();
  }
  std::int64_t rows_after_restart() const {
    auto db = Connection::open(file_, OpenMode::read_write);
    return db ? db->integer("SELECT count(*) FROM t").value_or(-1) : -1;
  }
  // Does the work in a child process, which then exits without cleanup, as if it were killed.
  // Returns the status of the child.
  static int in_child(const std::function<bool()>& work) {
    const pid_t child = fork();
    if (child == 0) _exit(work() ? 0 : 1);
    int status = -1;
    waitpid(child, &status, 0);
    return status;
  }
  fs::path folder_, file_, wal_, shm_;
};

TEST_F(WatchedJournal, KeepsTheContentOfARemovedOrReplacedWal) {
  const std::function<void()> spoils[] = {
      [this] { fs::remove(wal_); },
      [this] {
        fs::copy_file(wal_, folder_ / "old");  // SQLite would apply the old WAL over later changes
        fs::rename(folder_ / "old", wal_);
      },
      [this] { fs::remove(shm_); },
      [this] {
        fs::copy_file(shm_, folder_ / "old");
        fs::rename(folder_ / "old", shm_);
      },
  };
  std::int64_t acknowledged = 0;
  for (const auto& spoil : spoils) {
    for (const bool in_transaction : {false, true}) {
      int kept = 0;
      const int status = in_child([&] {
        auto db = writer();
        if (!insert(db)) return false;
        if (in_transaction) {
          auto transaction = Transaction::begin(db);
          if (!transaction || !db.execute("INSERT INTO t VALUES (2)")) return false;
          spoil();
          // The commit must succeed, so its row is acknowledged.
          if (!transaction->commit()) return false;
        } else {
          spoil();
        }
        const auto refused = insert(db);
        return !refused &&
               refused.error().message.find("are in the database file") != std::string::npos;
      });
      EXPECT_EQ(status, 0);
      kept = in_transaction ? 2 : 1;
      acknowledged += kept;
      EXPECT_EQ(rows_after_restart(), acknowledged);
    }
  }
}

TEST_F(WatchedJournal, TruncatedWalIsAPermanentFault) {
  auto db = writer();
  ASSERT_TRUE(insert(db));
  fs::resize_file(wal_, 0);
  EXPECT_NE(db.journal_fault().find("-wal was truncated"), std::string::npos);
  fs::resize_file(wal_, 1 << 20);
  EXPECT_NE(db.journal_fault().find("may be missing"), std::string::npos);
  EXPECT_FALSE(insert(db));
}

TEST_F(WatchedJournal, CheckpointOfAnotherProgramIsNoFault) {
  auto db = writer();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(insert(db));
    EXPECT_EQ(in_child([&] {
                return Connection::open(file_, OpenMode::read_write)
                    ->execute("PRAGMA wal_checkpoint(TRUNCATE)")
                    .has_value();
              }),
              0);
    EXPECT_EQ(fs::file_size(wal_), 0u);
    EXPECT_EQ(db.journal_fault(), "");
  }
}

// Truncates the -shm file, which contains the index of the WAL, to 0 bytes or to 4096 bytes.
TEST_F(WatchedJournal, ProcessSurvivesATruncatedShm) {
  for (const std::uintmax_t bytes : {std::uintmax_t{0}, std::uintmax_t{4096}}) {
    const fs::path file = folder_ / std::to_string(bytes);
    const int status = in_child([&] {
      survive_truncated_shm();
      file_ = file;
      auto db = writer();
      auto reader = Connection::open(file, OpenMode::read_only);
      if (!db.execute("CREATE TABLE u (x); WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 "
                      "FROM n WHERE i < 1500) INSERT INTO u SELECT zeroblob(4000) FROM n") ||
          !insert(db))
        return false;
      fs::resize_file(file.string() + "-shm", bytes);
      const auto read = reader->integer("SELECT count(*) FROM u WHERE length(x) = 4000");
      if (read && *read != 1500) return false;  // the read gives an error or the correct number
      return !insert(db) && db.journal_fault().find("-shm was truncated") != std::string::npos;
    });
    EXPECT_EQ(status, 0) << "cut to " << bytes;
    auto after = Connection::open(file, OpenMode::read_write);
    EXPECT_EQ(after->integer("SELECT count(*) FROM t").value_or(-1), 1);
    EXPECT_EQ(after->integer("SELECT count(*) FROM u").value_or(-1), 1500);
    auto check = after->prepare("PRAGMA integrity_check");
    ASSERT_TRUE(check && check->step().value_or(false));
    EXPECT_EQ(check->text(0), "ok");
  }
}

// Truncates the -shm file during a read transaction. The index of the WAL is then empty; without
// the check, SQLite would return older pages.
TEST_F(WatchedJournal, TruncatedShmGivesNoOlderPages) {
  const int status = in_child([&] {
    survive_truncated_shm();
    auto db = writer();
    auto reader = Connection::open(file_, OpenMode::read_only);
    if (!db.execute("CREATE TABLE u (x, filler); WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT "
                    "i + 1 FROM n WHERE i < 300) INSERT INTO u SELECT 1, zeroblob(3000) FROM n; "
                    "PRAGMA wal_checkpoint(TRUNCATE); PRAGMA wal_autocheckpoint = 0; "
                    "UPDATE u SET x = 2") ||
        !reader->execute("BEGIN; SELECT count(*) FROM t"))
      return false;
    fs::resize_file(shm_, 0);
    const auto sum = reader->integer("SELECT sum(x) FROM u");
    return !sum || *sum == 600;
  });
  EXPECT_EQ(status, 0);
  auto after = Connection::open(file_, OpenMode::read_write);
  EXPECT_EQ(after->integer("SELECT sum(x) FROM u").value_or(-1), 600);
}

}  // namespace
}  // namespace mdof::sqlite
