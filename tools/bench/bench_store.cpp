// Compares the rate at which the store writes runs with the rate of a simple loop of prepared
// SQLite statements, which writes the same rows with the same durability. Limit: the ratio is at
// least 0.8. The simple loop writes to a table without keys, checks and references, and its rows
// are ready to be bound. The store also writes provenance, references and the hash of the results.
//
//   bench_store [FOLDER]    prints both rates and their ratio for small and large runs; exit status
//                           1 below 0.8. FOLDER must be on a disk: in memory, durability needs no
//                           time
#include <sqlite3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "daemon/store/store.h"

namespace {

namespace fs = std::filesystem;
using mdof::MeasuredPoint;
using mdof::Run;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void expect(bool ok, const std::string& what) {
  if (ok) return;
  std::fprintf(stderr, "bench_store: %s\n", what.c_str());
  std::exit(4);
}

Run make_run(int points) {
  std::mt19937_64 random(1);
  const auto any = [&] { return static_cast<double>(random()) * 1e-25; };
  Run run;
  run.header.state = mdof::RunState::complete;
  run.header.provenance = {"csv", "/log.csv", std::string(64, 'a'), "rig", "exact", "0.1.0",
                           "{}",  ""};
  for (int i = 0; i < points; ++i) {
    MeasuredPoint point;
    point.target = i / 10;
    point.target_m = point.point.position_m = any();
    point.point.probe_m = {any(), any(), any(), any(), any()};
    point.point.probe_u_m = {any(), any(), any(), any(), any()};
    point.point.samples = 2000;
    point.errors.valid = true;
    for (double& x : point.errors.local) x = any();
    for (double& x : point.errors.covariance) x = any();
    run.points.push_back(point);
  }
  return run;
}

// The simple loop, with direct calls of SQLite only.
class Bare {
 public:
  explicit Bare(const fs::path& file) {
    expect(sqlite3_open(file.c_str(), &database_) == SQLITE_OK, "cannot open the bare database");
    run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;"
        "CREATE TABLE point (run INTEGER, row INTEGER, target INTEGER, target_m REAL, "
        "repetition INTEGER, direction INTEGER, begin_ns INTEGER, end_ns INTEGER, position_m REAL, "
        "samples INTEGER, flags TEXT, probe_m BLOB, probe_u_m BLOB, reason TEXT, dy_m REAL, "
        "dz_m REAL, ex_rad REAL, ey_rad REAL, ez_rad REAL, residual_m REAL, covariance BLOB)");
    sqlite3_prepare_v2(database_,
                       "INSERT INTO point VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)", -1,
                       &insert_, nullptr);
  }
  ~Bare() {
    sqlite3_finalize(insert_);
    sqlite3_close(database_);
  }
  Bare(const Bare&) = delete;
  Bare& operator=(const Bare&) = delete;

  void store(sqlite3_int64 run_id, const Run& whole) {
    run("BEGIN IMMEDIATE");
    sqlite3_int64 row = 0;
    for (const MeasuredPoint& point : whole.points) insert(run_id, row++, point);
    run("COMMIT");
  }

 private:
  void run(const char* sql) {
    expect(sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) == SQLITE_OK,
           sqlite3_errmsg(database_));
  }
  void bind_doubles(int column, const double* x, std::size_t n) {
    sqlite3_bind_blob(insert_, column, x, static_cast<int>(8 * n), SQLITE_STATIC);
  }
  void insert(sqlite3_int64 run_id, sqlite3_int64 row, const MeasuredPoint& point) {
    const mdof::Point& p = point.point;
    int column = 0;
    for (const sqlite3_int64 x : {run_id, row, sqlite3_int64{point.target}})
      sqlite3_bind_int64(insert_, ++column, x);
    sqlite3_bind_double(insert_, ++column, point.target_m);
    for (const sqlite3_int64 x : {sqlite3_int64{point.run}, sqlite3_int64{p.direction},
                                  sqlite3_int64{p.begin_ns}, sqlite3_int64{p.end_ns}})
      sqlite3_bind_int64(insert_, ++column, x);
    sqlite3_bind_double(insert_, ++column, p.position_m);
    sqlite3_bind_int64(insert_, ++column, static_cast<sqlite3_int64>(p.samples));
    sqlite3_bind_text(insert_, ++column, "[]", 2, SQLITE_STATIC);
    bind_doubles(++column, p.probe_m.data(), p.probe_m.size());
    bind_doubles(++column, p.probe_u_m.data(), p.probe_u_m.size());
    sqlite3_bind_null(insert_, ++column);
    for (const double x : point.errors.local) sqlite3_bind_double(insert_, ++column, x);
    sqlite3_bind_double(insert_, ++column, point.errors.residual_m);
    bind_doubles(++column, point.errors.covariance.data(), point.errors.covariance.size());
    expect(sqlite3_step(insert_) == SQLITE_DONE, sqlite3_errmsg(database_));
    sqlite3_reset(insert_);
  }

  sqlite3* database_ = nullptr;
  sqlite3_stmt* insert_ = nullptr;
};

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

// Measures both rates in alternating rounds, so that a slow phase of the disk or the computer
// affects both.
double compare(const fs::path& folder, int points_per_run, int runs_per_round, int rounds) {
  const Run run = make_run(points_per_run);
  const std::string size = std::to_string(points_per_run);
  Bare bare(folder / ("bare-" + size + ".db"));
  auto store =
      mdof::store::Store::open(folder / ("store-" + size + ".db"), mdof::store::Access::read_write);
  expect(store.has_value(), store ? "" : store.error().message);
  std::vector<double> bare_s, store_s, ratio;
  for (int round = 0; round < rounds; ++round) {
    auto start = Clock::now();
    for (int i = 0; i < runs_per_round; ++i) bare.store(round * runs_per_round + i, run);
    bare_s.push_back(seconds_since(start));
    start = Clock::now();
    for (int i = 0; i < runs_per_round; ++i) expect(store->add_run(run).has_value(), "add_run");
    store_s.push_back(seconds_since(start));
    ratio.push_back(bare_s.back() / store_s.back());
  }
  const double rows = static_cast<double>(points_per_run) * runs_per_round;
  std::printf(
      "%7d points a run: SQLite alone %9.0f rows/s, store %9.0f rows/s, ratio %.2f (median of "
      "%d)\n",
      points_per_run, rows / median(bare_s), rows / median(store_s), median(ratio), rounds);
  return median(ratio);
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder = std::string(argc > 1 ? argv[1] : ".") + "/bench-store-XXXXXX";
  expect(mkdtemp(folder.data()) != nullptr, "cannot create a folder in the given folder");
  double worst = compare(folder, 110, 20, 15);
  worst = std::min(worst, compare(folder, 2000, 5, 15));
  worst = std::min(worst, compare(folder, 50000, 1, 15));
  fs::remove_all(folder);
  return worst >= 0.8 ? 0 : 1;
}
