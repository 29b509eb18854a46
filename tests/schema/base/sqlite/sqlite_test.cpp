#include "schema/base/sqlite/sqlite.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>

#include "schema/base/database/files.h"

namespace mdof::sqlite {
namespace {

namespace fs = std::filesystem;

// A text may be destroyed after it is bound and before the statement runs. Then other bytes would
// be stored and hashed. Therefore the connection copies bound texts.
TEST(Sqlite, CopiesBoundTexts) {
  auto connection = Connection::open(":memory:", OpenMode::create);
  ASSERT_TRUE(connection) << connection.error().message;
  ASSERT_TRUE(connection->execute("CREATE TABLE t (x TEXT)"));
  {
    auto insert = connection->prepare("INSERT INTO t VALUES (?)");
    std::string text = "Y+ X- Z-";
    insert->bind(text);
    text.assign(8, '#');
    ASSERT_TRUE(insert->run());
  }
  auto row = connection->prepare("SELECT x FROM t");
  ASSERT_TRUE(*row->step());
  EXPECT_EQ(row->text(0), "Y+ X- Z-");
}

class ForeignDatabase : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "mdof-foreign-XXXXXX").string();
    ASSERT_TRUE(mkdtemp(name.data()));
    folder_ = name;
    file_ = folder_ / "theirs.db";
    auto connection = Connection::open(file_, OpenMode::create);
    ASSERT_TRUE(connection->execute("CREATE TABLE t (x); INSERT INTO t VALUES (1)"));
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs `sql` in a child process that exits without closing the database.
  void leave(const std::string& sql) const {
    const pid_t child = fork();
    if (child == 0) {
      auto db = Connection::open(file_, OpenMode::read_write);
      _exit(db && db->execute(sql) ? 0 : 1);  // exits without closing the database
    }
    int status = -1;
    waitpid(child, &status, 0);
    ASSERT_EQ(status, 0);
  }
  void leave_half_written() const {
    leave(
        "PRAGMA cache_size = 1; PRAGMA cache_spill = 1; BEGIN IMMEDIATE; UPDATE t SET x = 2; "
        "CREATE TABLE half (x); WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n "
        "WHERE i < 500) INSERT INTO half SELECT zeroblob(2000) FROM n");
    ASSERT_GT(fs::file_size(file_.string() + "-journal"), 0u);
  }
  // Adds the name of a super-journal to the journal. SQLite does this for a transaction over
  // several databases.
  void name_super_journal(const fs::path& victim) const {
    const std::string name = victim.string();
    std::uint32_t sum = 0;
    for (const char c : name) sum += static_cast<std::uint32_t>(static_cast<signed char>(c));
    std::ofstream journal(file_.string() + "-journal", std::ios::binary | std::ios::app);
    const auto put = [&](std::uint32_t x) {
      for (const int shift : {24, 16, 8, 0}) journal.put(static_cast<char>(x >> shift));
    };
    put(1);
    journal << name;
    put(static_cast<std::uint32_t>(name.size()));
    put(sum);
    journal << std::string("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
  }
  // The bytes of each file in the folder, by name.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      std::ifstream in(entry.path(), std::ios::binary);
      all[entry.path().filename()] = {std::istreambuf_iterator<char>(in), {}};
    }
    return all;
  }
  static std::int64_t sum(Connection& db) {
    return db.integer("SELECT sum(x) FROM t").value_or(-1);
  }

  fs::path folder_, file_;
};

TEST_F(ForeignDatabase, DoesNotDeleteAFileNamedInAJournal) {
  leave_half_written();
  const fs::path victim = folder_ / "victim";
  std::ofstream(victim) << "the only copy";
  name_super_journal(victim);
  const auto before = contents();
  for (const OpenMode mode :
       {OpenMode::read_only, OpenMode::snapshot, OpenMode::read_write, OpenMode::create}) {
    const auto opened = Connection::open(file_, mode);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().code, ErrorCode::bad_input);
    EXPECT_NE(opened.error().message.find("names a super-journal"), std::string::npos);
    EXPECT_EQ(contents(), before);
  }
  // The journal may appear after the check and before SQLite opens the database. In this case
  // SQLite must not delete the file `victim` either.
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &database), SQLITE_OK);
  (void)sqlite3_exec(database, "SELECT count(*) FROM t", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  EXPECT_TRUE(fs::exists(victim));
}

TEST_F(ForeignDatabase, IsReadWithoutWriting) {
  const struct {
    const char* sql;  // empty: the database has an incomplete transaction and a -journal
    std::int64_t sum;
  } cases[] = {
      {"SELECT 1", 1},
      {"", 1},
      {"PRAGMA journal_mode = WAL; INSERT INTO t VALUES (10)", 11},
  };
  for (const auto& c : cases) {
    *c.sql ? leave(c.sql) : leave_half_written();
    const auto before = contents();
    {
      auto db = Connection::open(file_, OpenMode::snapshot);
      ASSERT_TRUE(db) << db.error().message;
      EXPECT_EQ(sum(*db), c.sum) << c.sql;
      EXPECT_FALSE(db->execute("INSERT INTO t VALUES (100)"));
      EXPECT_EQ(db->file(), file_);
      EXPECT_EQ(contents(), before) << c.sql;
    }
    EXPECT_EQ(contents(), before) << c.sql;
    auto rolled_back = Connection::open(file_, OpenMode::read_write);
    ASSERT_EQ(sum(*rolled_back), c.sum);
  }
}

// Another process writes and makes checkpoints as fast as possible. Each copy must be the complete
// state of the database at one time.
TEST_F(ForeignDatabase, CopiesAreConsistentDuringWrites) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    auto db = Connection::open(file_, OpenMode::read_write);
    if (!db->execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = OFF; "
                     "PRAGMA wal_autocheckpoint = 1; CREATE TABLE u (x, filler); WITH RECURSIVE "
                     "n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 100) INSERT INTO u "
                     "SELECT 1, zeroblob(30000) FROM n"))
      _exit(1);
    for (int i = 2;; ++i) {
      if (!db->execute("BEGIN; UPDATE t SET x = x + 1; UPDATE u SET x = x + 1 WHERE rowid = 1 + "
                       "(SELECT x % 100 FROM t); COMMIT"))
        _exit(1);
      if (i == 100 && write(ready[1], "x", 1) != 1) _exit(1);
    }
  }
  close(ready[1]);
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  close(ready[0]);
  std::int64_t last = 100;
  for (int turn = 0; turn < 30; ++turn) {
    auto db = Connection::open(file_, OpenMode::snapshot);
    ASSERT_TRUE(db) << db.error().message;
    const std::int64_t now = sum(*db);
    EXPECT_GE(now, last);
    EXPECT_EQ(db->integer("SELECT sum(x) FROM u").value_or(-1), now + 99);
    auto check = db->prepare("PRAGMA integrity_check");
    ASSERT_TRUE(check && check->step().value_or(false));
    EXPECT_EQ(check->text(0), "ok");
    last = now;
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST_F(ForeignDatabase, FilesOpenForWritingAreKnownByAnyName) {
  EXPECT_FALSE(is_open_for_writing(file_));
  auto db = Connection::open(file_, OpenMode::read_write);
  ASSERT_TRUE(db->execute("PRAGMA journal_mode = WAL; INSERT INTO t VALUES (10)"));
  fs::create_hard_link(file_, folder_ / "hard");
  fs::create_symlink(file_.string() + "-shm", folder_ / "soft");
  for (const char* name : {"theirs.db", "theirs.db-wal", "theirs.db-shm", "hard", "soft"})
    EXPECT_TRUE(is_open_for_writing(folder_ / name)) << name;
  std::ofstream(folder_ / "other").flush();
  EXPECT_FALSE(is_open_for_writing(folder_ / "other"));
  EXPECT_FALSE(is_open_for_writing(folder_ / "absent"));
}

// Returns whether another process finds SQLite's reader lock on the file.
bool is_locked(const fs::path& file) {
  const pid_t child = fork();
  if (child == 0) {
    const int fd = ::open(file.c_str(), O_RDWR);
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_start = 0x40000002;
    lock.l_len = 510;
    _exit(fd >= 0 && ::fcntl(fd, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status == 0;
}

TEST_F(ForeignDatabase, OpeningAFileByAnotherNameKeepsItsLocks) {
  auto own = Connection::open(file_, OpenMode::read_write);
  ASSERT_TRUE(own->execute("PRAGMA journal_mode = WAL; INSERT INTO t VALUES (10)"));
  const fs::path foreign = folder_ / "foreign";
  fs::create_hard_link(file_, folder_ / "hard");
  for (const char* ending : {"-wal", "-shm", "-journal"}) {
    ASSERT_TRUE(Connection::open(foreign, OpenMode::create)->execute("CREATE TABLE t (x)"));
    fs::create_hard_link(file_, foreign.string() + ending);
    for (const OpenMode mode : {OpenMode::snapshot, OpenMode::read_only})
      (void)Connection::open(foreign, mode);
    EXPECT_TRUE(is_locked(file_)) << ending;
    for (const char* end : {"", "-wal", "-shm", "-journal"}) fs::remove(foreign.string() + end);
  }
  for (const char* name : {"theirs.db", "theirs.db-wal", "theirs.db-shm", "hard"}) {
    EXPECT_EQ(open_foreign(folder_ / name, 0), -1) << name;
    EXPECT_EQ(errno, EBUSY) << name;
  }
  EXPECT_TRUE(is_locked(file_));
  // Closing any descriptor of the file drops SQLite's lock; open_foreign() prevents this fault.
  ::close(::open(file_.c_str(), O_RDONLY));
  EXPECT_FALSE(is_locked(file_));
}

TEST(OpenForeign, DoesNotWaitForAFifo) {
  std::string name = (fs::temp_directory_path() / "mdof-fifo-XXXXXX").string();
  ASSERT_TRUE(mkdtemp(name.data()));
  const fs::path fifo = fs::path(name) / "fifo", link = fs::path(name) / "link";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(open_foreign(fifo, 0), -1);
  EXPECT_EQ(errno, EINVAL);
  fs::create_symlink(fifo, link);
  EXPECT_EQ(open_foreign(link, O_NOFOLLOW), -1);
  fs::remove_all(name);
}

}  // namespace
}  // namespace mdof::sqlite
