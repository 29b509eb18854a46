// An active table depends on data of the store, and no bit of these data may change undetected.
// The test inverts each bit in the file. Then the store must return the stored values or an error,
// and verify() must report the change.
#include <fstream>
#include <regex>

#include "daemon/store/file/announced_head.h"
#include "daemon/store/store.h"
#include "tests/daemon/store/fixtures.h"
#include "tests/shown.h"

namespace mdof::store {
namespace {

constexpr const char* kActor = "uid 1000 pid 4711";

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class LedgerTest : public StoreTest {
 protected:
  // Two tables for X, of which the second is active. One table for Y, which is deactivated.
  void store_all() {
    auto store = writer();
    ASSERT_TRUE(store) << store.error().message;
    for (const Axis axis : {Axis::x, Axis::x, Axis::y}) {
      const auto run = store->add_run(make_run(4, axis)).value();
      const auto table = store->add_table(make_table({run}, axis)).value();
      ASSERT_TRUE(store->activate(table, kActor, "2026-11-21T05:00:0" + std::to_string(table)));
    }
    ASSERT_TRUE(store->deactivate(Axis::y, kActor, "2026-11-21T05:00:05"));
    mdof::Squareness squareness;
    squareness.run_a = 1;
    squareness.run_b = 3;
    squareness.error_rad = 12e-6;
    ASSERT_TRUE(store->add_squareness(squareness));
  }

  // The values that a client gets; empty if the store returns an error.
  static std::string served(Result<Store>& store) {
    std::string all;
    for (const Axis axis : {Axis::x, Axis::y}) {
      const auto active = store ? store->active(axis) : tl::unexpected(store.error());
      const bool none = !active && active.error().code == ErrorCode::not_found;
      all += none ? "none|" : active ? text_of(*active) : "";
    }
    return all;
  }

  static std::string text_of(const ActiveTable& active) {
    return std::to_string(active.table.id) + letter(active.table.axis) +
           std::to_string(active.generation) + active.actor + active.activated_utc + "|";
  }

  static bool found_by_verify(Result<Store>& store) {
    if (!store) return true;
    const auto findings = store->verify();
    return !findings || !findings->empty();
  }

  // Merges the journal into the database, so that all data are in one file.
  void close_journal() {
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
    ASSERT_TRUE(db->execute("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE"));
  }

  void write_bytes(const std::string& bytes) {
    std::ofstream(file_, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
};

TEST_F(LedgerTest, EveryBitOfTheActivationsIsUnderAHash) {
  store_all();
  close_journal();
  const std::string whole = contents(file_);
  std::string before;
  {
    auto store = reader();
    before = served(store);
    ASSERT_TRUE(before.starts_with("2X") && before.ends_with("none|")) << before;
    ASSERT_FALSE(found_by_verify(store));
  }
  // A row in SQLite's format: length of the header, generation, four or five types, axis, table.
  // The value of table 1 needs no bytes.
  const std::regex row(std::string("([^]{12}[XYZ][\\x02-\\x7f]|[^]{12}X|[^]{11}Y)") + kActor +
                       "2026-11-21T05:00:0[0-9]");
  std::fstream file(file_, std::ios::binary | std::ios::in | std::ios::out);
  const auto put = [&](std::size_t at, char byte) {
    file.seekp(static_cast<std::streamoff>(at)).put(byte).flush();
  };
  int rows = 0, bits = 0, unread = 0;
  for (std::sregex_iterator found(whole.begin(), whole.end(), row), end; found != end; ++found) {
    ++rows;
    const auto begin = static_cast<std::size_t>(found->position());
    for (std::size_t bit = 0; bit < 8 * static_cast<std::size_t>(found->length()); ++bit, ++bits) {
      const std::size_t at = begin + bit / 8;
      put(at, static_cast<char>(whole[at] ^ (1 << (bit % 8))));
      auto store = reader();
      const std::string now = served(store);
      EXPECT_TRUE(now == before || now.empty()) << "bit " << bit << " of " << begin << ": " << now;
      unread += !found_by_verify(store);
      put(at, whole[at]);
    }
  }
  EXPECT_GE(bits, 904);
  // SQLite does not use one bit of the type of each key, because it stores the key elsewhere.
  EXPECT_LE(unread, rows);
}

// The test drops the triggers first, so that SQL can change the data as by accident.
TEST_F(LedgerTest, EveryFactIsCheckedWhenServedAndByVerify) {
  store_all();
  close_journal();
  const std::string whole = contents(file_);
  struct Case {
    const char* table;
    const char* change;
    std::function<bool(Store&)> served;
  };
  const auto run = [](Store& s) { return s.run_header(1).has_value(); };
  const auto table = [](Store& s) { return s.table(2).has_value(); };
  const auto active = [](Store& s) { return s.active(Axis::x).has_value(); };
  const auto square = [](Store& s) { return s.list_squareness(0, 9).has_value(); };
  const std::vector<Case> cases = {
      {"run", "UPDATE run SET axis = 'Y' WHERE id = 1", run},
      {"run", "UPDATE run SET simulated = 0 WHERE id = 1", run},
      {"run", "UPDATE run SET moves = 'fixture' WHERE id = 1", run},
      {"run_end", "UPDATE run_end SET state = 'partial' WHERE run = 1", run},
      {"run_end", "UPDATE run_end SET warnings = '[]' WHERE run = 1", run},
      {"recording", "UPDATE recording SET path = '/elsewhere'", run},
      {"recording", "UPDATE recording SET sha256 = upper(sha256)", run},
      {"document", "UPDATE document SET text = replace(text, 'rig', 'rag')", run},
      {"point", "UPDATE point SET dy_m = 0 WHERE run = 1 AND row = 2",
       [](Store& s) { return s.run(1).has_value(); }},
      {"compensation_table", "UPDATE compensation_table SET slope_removed = 1 - slope_removed",
       table},
      {"compensation_source", "UPDATE compensation_source SET run = 3", table},
      {"activation", "UPDATE activation SET compensation_table = 1 WHERE compensation_table = 2",
       active},
      {"activation", "DELETE FROM activation WHERE compensation_table = 2", active},
      {"activation", "INSERT INTO activation VALUES (4000000000, 'X', 1, 'me', 'now')", active},
      {"deactivation", "UPDATE deactivation SET axis = 'X'", active},
      {"ledger", "UPDATE ledger SET sha256 = '0' WHERE fact = 'activation'", active},
      {"ledger", "DELETE FROM ledger WHERE fact = 'activation'", active},
      {"squareness", "UPDATE squareness SET EC0Y_rad = -EC0Y_rad", square},
  };
  for (const Case& c : cases) {
    write_bytes(whole);
    {
      auto untouched = reader();
      ASSERT_TRUE(c.served(*untouched)) << c.change;
    }
    tamper(std::string("DROP TRIGGER IF EXISTS ") + c.table +
           "_no_update; DROP TRIGGER IF EXISTS " + c.table + "_no_delete; " + c.change);
    auto store = reader();
    EXPECT_FALSE(c.served(*store)) << c.change;
    EXPECT_TRUE(found_by_verify(store)) << c.change;
  }
}

// An attacker replaces data and recalculates the whole chain of hashes. The database alone cannot
// show this; only the head that was announced earlier can.
TEST_F(LedgerTest, ARecalculatedChainDiffersFromTheAnnouncedHead) {
  store_all();
  ChainHead reported;
  std::int64_t generation = 0;
  {
    auto store = reader();
    reported = store->chain_head().value();
    generation = store->generation().value();
    ASSERT_TRUE(store->check_announced_head()) << "nothing was told";
    EXPECT_GT(reported.link, 0);
  }
  ASSERT_TRUE(write_announced_head(file_, {reported, generation}));
  EXPECT_TRUE(reader()->active(Axis::x));
  EXPECT_TRUE(reader()->verify()->empty());
  {  // a permitted change extends the chain
    ASSERT_TRUE(writer()->add_run(make_run(4)));
    auto store = reader();
    EXPECT_NE(store->chain_head()->link, reported.link);
    EXPECT_TRUE(store->check_announced_head());
    EXPECT_TRUE(store->has_hash(reported.sha256).value());
  }
  const std::string whole = contents(file_);
  {
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
    ASSERT_TRUE(
        db->execute("DROP TRIGGER activation_no_update; DROP TRIGGER ledger_no_delete; "
                    "UPDATE activation SET compensation_table = 1 WHERE "
                    "compensation_table = 2; DELETE FROM ledger"));
    ASSERT_TRUE(link_old_facts(*db));
  }
  auto store = reader();
  EXPECT_FALSE(store->has_hash(reported.sha256).value());
  for (const Status& noticed :
       {store->check_announced_head(), Status(store->active(Axis::x).map([](auto&&) {}))}) {
    ASSERT_FALSE(noticed);
    EXPECT_TRUE(contains(noticed.error().message, "mdofd last reported link"))
        << noticed.error().message;
  }
  EXPECT_EQ(store->verify()->size(), 1u) << store->verify()->front();
  fs::remove(announced_head_file(file_));
  EXPECT_TRUE(reader()->verify()->empty()) << "the chain itself fits";
  EXPECT_EQ(reader()->active(Axis::x)->table.id, 1);
}

TEST_F(LedgerTest, ChangedRowsAreServedOnNoPage) {
  std::int64_t run = 0;
  { run = writer()->add_run(make_run(22)).value(); }
  auto store = reader();
  const auto page = store->points(run, 10, 5).value();
  ASSERT_EQ(page.size(), 5u);
  EXPECT_EQ(page[0].target, make_run(22).points[10].target);
  tamper("DROP TRIGGER point_no_update; UPDATE point SET ez_rad = ez_rad + 1e-9 WHERE row = 12");
  EXPECT_TRUE(store->points(run, 0, 10));  // this part of the points did not change
  EXPECT_FALSE(store->points(run, 10, 5));
  EXPECT_FALSE(reader()->points(run, 0, 10)) << "of a run that is not what was stored";
}

TEST_F(LedgerTest, ADamagedRunIsListedAsFailedWithTheReason) {
  store_all();
  tamper("DROP TRIGGER run_no_update; UPDATE run SET note = 'another' WHERE id = 2");
  const auto list = reader()->list_runs(0, 10).value();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[1].state, RunState::failed);
  EXPECT_EQ(list[1].notices.front().code, NoticeCode::row_damaged);
  EXPECT_TRUE(contains(test::shown(list[1].notices), "run 2: was changed after it was stored"))
      << test::shown(list[1].notices);
  EXPECT_EQ(list[0].state, RunState::complete);
}

}  // namespace
}  // namespace mdof::store
