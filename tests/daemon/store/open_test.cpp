// Files that the store must not open, or must repair first: foreign files, incomplete files, and
// files of other versions.
#include <csignal>
#include <fstream>

#include <sys/resource.h>

#include "daemon/store/file/migrate.h"
#include "daemon/store/store.h"
#include "tests/daemon/store/fixtures.h"
#include "tests/shown.h"

namespace mdof::store {
namespace {

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST_F(StoreTest, CreatesTheFolderAndTheFile) {
  file_ = folder_ / "state" / "mdof" / "mdof.db";
  auto store = writer();
  ASSERT_TRUE(store) << store.error().message;
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_only);
  EXPECT_EQ(db->integer("PRAGMA application_id").value(), kApplication);
  EXPECT_EQ(db->integer("PRAGMA user_version").value(), sql::migrations().back().version);
}

TEST_F(StoreTest, ReadingAMissingFileIsNotFoundAndCreatesNothing) {
  const auto store = reader();
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().code, ErrorCode::not_found);
  EXPECT_EQ(files_in(folder_), 0u);
}

TEST_F(StoreTest, RejectsANewerSchemaWithBothVersions) {
  { ASSERT_TRUE(writer()); }
  tamper("PRAGMA user_version = 42");
  for (const auto& store : {writer(), reader()}) {
    ASSERT_FALSE(store);
    EXPECT_EQ(store.error().code, ErrorCode::bad_input);
    EXPECT_TRUE(contains(store.error().message, "version 42"));
    EXPECT_TRUE(contains(store.error().message,
                         "up to " + std::to_string(sql::migrations().back().version)));
  }
}

TEST_F(StoreTest, RejectsANonDatabaseAndLeavesItUnchanged) {
  const std::string text(3000, 'x');
  std::ofstream(file_) << text;
  for (const auto& store : {writer(), reader()}) {
    ASSERT_FALSE(store);
    EXPECT_EQ(store.error().code, ErrorCode::bad_input);
    EXPECT_TRUE(contains(store.error().message, "not a SQLite database"));
  }
  EXPECT_EQ(contents(file_), text);
  EXPECT_EQ(files_in(folder_), 1u);
}

TEST_F(StoreTest, RejectsAnotherApplicationsDatabase) {
  ASSERT_TRUE(sqlite::Connection::open(file_, sqlite::OpenMode::create)
                  ->execute("CREATE TABLE bookmarks (url)"));
  const std::string before = contents(file_);
  for (const auto& store : {writer(), reader()}) {
    ASSERT_FALSE(store);
    EXPECT_EQ(store.error().code, ErrorCode::bad_input);
    EXPECT_TRUE(contains(store.error().message, "another application"));
  }
  EXPECT_EQ(contents(file_), before);
  EXPECT_EQ(files_in(folder_), 1u);
}

TEST_F(StoreTest, AFolderIsNotADatabase) {
  file_ = folder_;
  EXPECT_FALSE(writer());
  EXPECT_FALSE(reader());
}

TEST_F(StoreTest, RejectsASecondWriter) {
  auto first = writer();
  const auto second = writer();
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::conflict);
  EXPECT_TRUE(contains(second.error().message, "another program"));
  first = tl::unexpected(Error{});
  EXPECT_TRUE(writer());
}

// If a second program opened the file under another name, it would write at the same time and mark
// the run of the first program as aborted.
TEST_F(StoreTest, RejectsASecondWriterByAnyName) {
  const auto first = writer();
  ASSERT_TRUE(first);
  const fs::path database = file_;
  for (const char* name : {"symbolic.db", "hard.db", "far/symbolic.db"}) {
    file_ = folder_ / name;
    fs::create_directories(file_.parent_path());
    std::string(name) == "hard.db" ? fs::create_hard_link(database, file_)
                                   : fs::create_symlink(database, file_);
    EXPECT_TRUE(WriterLock::held(file_)) << name;
    const auto second = writer();
    ASSERT_FALSE(second) << name;
    EXPECT_EQ(second.error().code, ErrorCode::conflict) << name;
  }
}

// SQLite names its journal after the file. If a file has two names, a program that uses one name
// does not find the journal of the other name.
TEST_F(StoreTest, RejectsAHardLinkUntilTheOtherNameIsRemoved) {
  { ASSERT_TRUE(writer()); }
  const fs::path other = folder_ / "other.db";
  fs::create_hard_link(file_, other);
  for (const auto& store : {writer(), reader()}) {
    ASSERT_FALSE(store);
    EXPECT_TRUE(contains(store.error().message, "2 names (hard links)")) << store.error().message;
  }
  fs::remove(other);
  EXPECT_TRUE(writer());
  EXPECT_TRUE(reader());
}

// Closing a file drops all locks of the process on this file. The query of the lock must not drop
// SQLite's locks in this way.
TEST_F(StoreTest, QueryingTheLockKeepsTheLocksOfAReader) {
  { ASSERT_TRUE(writer()); }
  auto held = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
  ASSERT_TRUE(held->execute("PRAGMA journal_mode = DELETE; BEGIN IMMEDIATE"));
  EXPECT_FALSE(WriterLock::held(file_));
  { ASSERT_TRUE(WriterLock::acquire(file_, 0)); }
  const pid_t child = fork();
  if (child == 0) {
    auto other = sqlite::Connection::open(file_, sqlite::OpenMode::read_write, 0);
    _exit(other && other->execute("BEGIN IMMEDIATE") ? 1 : 0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0) << "another process could begin to write";
}

// Simulates a program that was killed during a transaction, after it had begun to change the
// database file.
void leave_half_written(const fs::path& file) {
  const pid_t child = fork();
  if (child == 0) {
    auto db = sqlite::Connection::open(file, sqlite::OpenMode::read_write);
    const bool done = db && db->execute(
                                "PRAGMA journal_mode = DELETE; PRAGMA cache_size = 1; "
                                "PRAGMA cache_spill = 1; BEGIN IMMEDIATE; "
                                "CREATE TABLE half (x); PRAGMA user_version = 4711; "
                                "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 "
                                "FROM n WHERE i < 500) INSERT INTO half SELECT "
                                "zeroblob(2000) FROM n");
    _exit(done ? 0 : 1);  // ends without closing the database
  }
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  ASSERT_GT(fs::file_size(file.string() + "-journal"), 0u);
}

TEST_F(StoreTest, AnUnfinishedTransactionIsRolledBackFirst) {
  { ASSERT_TRUE(writer()->add_run(make_run())); }
  for (const bool by_reader : {true, false}) {
    leave_half_written(file_);
    auto store = by_reader ? reader() : writer();
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ(store->count_runs().value(), 1);
    EXPECT_TRUE(store->verify()->empty());
  }
  ASSERT_TRUE(writer());
}

TEST_F(StoreTest, AnUnfinishedNewFileIsCreatedAgain) {
  ASSERT_TRUE(sqlite::Connection::open(file_, sqlite::OpenMode::create));
  std::ofstream(file_).flush();
  leave_half_written(file_);
  auto store = writer();
  ASSERT_TRUE(store) << store.error().message;
  EXPECT_TRUE(store->verify()->empty());
}

TEST_F(StoreTest, AReaderCannotWrite) {
  { ASSERT_TRUE(writer()); }
  const auto added = reader()->add_run(make_run(1));
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::io);
}

constexpr char kOne[] = "CREATE TABLE a (x INTEGER) STRICT; INSERT INTO a VALUES (1);";
constexpr char kTwo[] = "ALTER TABLE a RENAME TO b; CREATE TABLE c (y INTEGER) STRICT;";
constexpr char kBroken[] = "ALTER TABLE b RENAME TO d; CREATE TABLE nonsense (z NOTHING) STRICT;";

TEST_F(StoreTest, AMigrationMakesABackupFirst) {
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::create);
  const sql::Migration steps[] = {{1, "001", kOne}, {2, "002", kTwo}};
  ASSERT_TRUE(migrate(*db, std::span(steps, 1)));
  EXPECT_EQ(files_in(folder_), 1u);  // a new database needs no backup
  ASSERT_TRUE(migrate(*db, steps));
  EXPECT_EQ(db->integer("SELECT x FROM b").value(), 1);
  EXPECT_EQ(db->integer("PRAGMA user_version").value(), 2);
  const fs::path backup = file_.string() + ".schema-1.backup";
  auto old = sqlite::Connection::open(backup, sqlite::OpenMode::read_only);
  ASSERT_TRUE(old);
  EXPECT_EQ(old->integer("SELECT x FROM a").value(), 1);
  EXPECT_EQ(old->integer("PRAGMA user_version").value(), 1);
  EXPECT_EQ(old->integer("PRAGMA application_id").value(), kApplication);
}

// This database was written by mdof with schema version 2. It has three runs, of which the third
// was interrupted, and an active table. The fourth run is from a log that stated its start.
TEST_F(StoreTest, AnOldDatabaseKeepsItsDataAndAcceptsPartialRuns) {
  const auto columns = [&](sqlite::Connection& db) {
    auto row = db.prepare("SELECT group_concat(name) FROM pragma_table_info('run_end')");
    EXPECT_TRUE(row->step().value());
    return std::string(row->text(0));
  };
  std::string before;
  {
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::create);
    ASSERT_TRUE(db->execute(contents(MDOF_TEST_DATA "/store/schema-2.sql")));
    ASSERT_TRUE(
        db->execute("INSERT INTO run VALUES (4, 'X', 0, '2026-11-22T06:22:46Z', '', NULL, 1, "
                    "1, 2, 3, 'rigid', 'mdof 0.1.0')"));
    ASSERT_TRUE(db->execute("PRAGMA application_id = " + std::to_string(kApplication)));
    ASSERT_TRUE(db->execute("PRAGMA user_version = 2"));
    before = columns(*db);
  }
  auto store = writer();
  ASSERT_TRUE(store) << store.error().message;
  EXPECT_TRUE(fs::exists(file_.string() + ".schema-2.backup"));
  EXPECT_TRUE(store->verify()->empty()) << store->verify()->front();
  EXPECT_EQ(store->count_runs().value(), 4);
  EXPECT_FALSE(store->run_header(1)->start_known);
  EXPECT_TRUE(store->run_header(4)->start_known);
  EXPECT_EQ(store->run(1)->points.size(), 14u);
  EXPECT_EQ(store->run_header(2)->state, RunState::complete);
  EXPECT_EQ(store->run_header(2)->scans, 5996u);
  EXPECT_EQ(store->run_header(3)->state, RunState::aborted);
  EXPECT_EQ(test::shown(store->run_header(3)->notices), "legacy words=interrupted\n");
  EXPECT_EQ(store->active(Axis::x)->table.runs, std::vector<std::int64_t>{1});
  mdof::Run run = make_run();
  run.header.state = RunState::partial;
  EXPECT_TRUE(store->add_run(run));
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
  EXPECT_TRUE(columns(*db).starts_with(before)) << columns(*db);
  for (const char* sql : {"UPDATE run_end SET scans = 0", "DELETE FROM run_end"})
    EXPECT_TRUE(contains(db->execute(sql).error().message, "append only")) << sql;
  EXPECT_FALSE(
      db->execute("INSERT INTO run_end (run, state, warnings, result_sha256) "
                  "VALUES (99, 'whatever', '[]', '')"));
}

// The remainder of the backup would use the space that is missing.
TEST_F(StoreTest, AFailedBackupLeavesNoFile) {
  { ASSERT_TRUE(writer()); }
  tamper(
      "CREATE TABLE large (x); INSERT INTO large VALUES (zeroblob(4000000)); "
      "PRAGMA user_version = 1");
  const rlim_t limit = 1'000'000;  // no file can become larger
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit files{limit, limit};
    if (::setrlimit(RLIMIT_FSIZE, &files) != 0) _exit(2);
    const auto refused = writer();
    if (!refused) fprintf(stderr, "%s\n", refused.error().message.c_str());
    _exit(!refused && contains(refused.error().message, "backup before the schema change") ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "see the messages above";
  EXPECT_FALSE(fs::exists(file_.string() + ".schema-1.backup.partial"));
}

TEST_F(StoreTest, AFailingMigrationChangesNothing) {
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::create);
  const sql::Migration steps[] = {{1, "001", kOne}, {2, "002", kTwo}, {3, "003_broken", kBroken}};
  ASSERT_TRUE(migrate(*db, std::span(steps, 1)));
  for (int turn = 0; turn < 2;
       ++turn) {  // the second attempt must work although the backup of the first exists
    const Status done = migrate(*db, steps);
    ASSERT_FALSE(done);
    EXPECT_TRUE(contains(done.error().message, "003_broken")) << done.error().message;
    EXPECT_EQ(db->integer("PRAGMA user_version").value(), 1);
    EXPECT_EQ(db->integer("SELECT x FROM a").value(), 1);
  }
}

TEST_F(StoreTest, AReadOnlyFolderIsReadButNotWritten) {
  { ASSERT_TRUE(writer()->add_run(make_run())); }
  with_private_mounts([&] { return mount_read_only(folder_); },
                      [&] {
                        auto store = reader();
                        const auto refused = writer();
                        if (!refused) fprintf(stderr, "%s\n", refused.error().message.c_str());
                        return store && store->run(1) && store->verify()->empty() && !refused &&
                               refused.error().code == ErrorCode::io &&
                               contains(refused.error().message, "must be writable");
                      });
}

}  // namespace
}  // namespace mdof::store
