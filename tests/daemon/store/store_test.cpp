#include "daemon/store/store.h"

#include <cmath>
#include <thread>

#include "daemon/store/result_hash.h"
#include "schema/plausibility/plausibility_json.h"
#include "schema/sample.h"
#include "tests/daemon/store/fixtures.h"
#include "tests/shown.h"

namespace mdof::store {
namespace {

void expect_same(const MeasuredPoint& a, const MeasuredPoint& b) {
  EXPECT_EQ(a.target, b.target);
  EXPECT_EQ(a.run, b.run);
  EXPECT_EQ(a.point.begin_ns, b.point.begin_ns);
  EXPECT_EQ(a.point.end_ns, b.point.end_ns);
  EXPECT_EQ(a.point.direction, b.point.direction);
  EXPECT_EQ(a.point.samples, b.point.samples);
  EXPECT_EQ(a.point.flags, b.point.flags);
  EXPECT_EQ(bits(a.point.probe_m), bits(b.point.probe_m));
  EXPECT_EQ(bits(a.point.probe_u_m), bits(b.point.probe_u_m));
  EXPECT_EQ(bits(std::vector{a.target_m, a.point.position_m, a.errors.residual_m}),
            bits(std::vector{b.target_m, b.point.position_m, b.errors.residual_m}));
  EXPECT_EQ(a.errors.valid, b.errors.valid);
  EXPECT_EQ(a.errors.reason, b.errors.reason);
  EXPECT_EQ(bits(a.errors.local), bits(b.errors.local));
  EXPECT_EQ(bits(a.errors.covariance), bits(b.errors.covariance));
}

void expect_same(const RunHeader& a, const RunHeader& b) {
  EXPECT_EQ(a.axis, b.axis);
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.simulated, b.simulated);
  EXPECT_EQ(a.started_utc, b.started_utc);
  EXPECT_EQ(a.start_known, b.start_known);
  EXPECT_EQ(a.note, b.note);
  EXPECT_EQ(a.supersedes, b.supersedes);
  EXPECT_EQ(a.scans, b.scans);
  EXPECT_EQ(a.scans_lost, b.scans_lost);
  EXPECT_EQ(a.notices, b.notices);
  const Provenance &p = a.provenance, &q = b.provenance;
  EXPECT_EQ(std::tie(p.recording_kind, p.recording_path, p.recording_sha256, p.rig_text, p.model),
            std::tie(q.recording_kind, q.recording_path, q.recording_sha256, q.rig_text, q.model));
  EXPECT_EQ(std::tie(p.software_version, p.options_json, p.configuration),
            std::tie(q.software_version, q.options_json, q.configuration));
}

TEST_F(StoreTest, ReturnsARunBitForBit) {
  mdof::Run run = make_run();
  run.points[0].errors.local = {-0.0, 5e-324, 3.0, -1e300, 0.1};
  run.points[1].target_m = -0.0;
  run.points[2].point.probe_m[3] = kNaN;
  run.points[3].errors = AxisErrors{};
  run.points[3].errors.reason = "probe \"C\" lost";
  run.header.temperature = Temperature{20.1, 19.9, 20.3};
  run.header.start_known = true;
  auto store = writer();
  ASSERT_TRUE(store) << store.error().message;
  const auto id = store->add_run(run);
  ASSERT_TRUE(id) << id.error().message;
  const auto back = store->run(*id);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->header.id, *id);
  expect_same(run.header, back->header);
  EXPECT_EQ(back->header.temperature, run.header.temperature);
  ASSERT_EQ(back->points.size(), run.points.size());
  for (std::size_t i = 0; i < run.points.size(); ++i) expect_same(run.points[i], back->points[i]);
  EXPECT_EQ(result_sha256(run), result_sha256(*back));
  EXPECT_EQ(result_sha256(run), store->result_sha256(*id).value());
}

// The store adds the notice to runs that were stored before this notice existed. A later run
// already has the notice and must not get it twice.
TEST_F(StoreTest, ARunWithoutADatumHasItsNoticeOnce) {
  auto store = writer();
  mdof::Run run = make_run();
  run.header.provenance.options_json = R"({"encoder_datum":{"kind":"none","device":"t7"}})";
  const Notices stored = run.header.notices;
  Notices shown = stored;
  shown.push_back(notice(NoticeCode::datum_missing, "t7"));
  const auto older = store->add_run(run);
  run.header.notices.insert(run.header.notices.begin(), shown.back());
  const Notices with_it = run.header.notices;
  const auto later = store->add_run(run);
  ASSERT_TRUE(older && later);
  EXPECT_EQ(store->run_header(*older)->notices, shown);
  EXPECT_EQ(store->run_header(*later)->notices, with_it);
}

TEST_F(StoreTest, KeepsFigures) {
  auto store = writer();
  const mdof::Run run = make_run();
  const mdof::Run back = store->run(store->add_run(run).value()).value();
  ASSERT_EQ(back.straightness.size(), 1u);
  EXPECT_EQ(back.straightness[0].error_key, "EYX_um");
  EXPECT_EQ(back.straightness[0].approach, "forward");
  EXPECT_EQ(back.straightness[0].straightness_end_point_m, 5e-7);
  EXPECT_TRUE(std::signbit(back.straightness[0].valley_position_m));
  ASSERT_EQ(back.angles.size(), 1u);
  EXPECT_EQ(back.angles[0].error_key, "EAX_urad");
  EXPECT_EQ(back.angles[0].max_rad, 3e-6);
}

TEST_F(StoreTest, KeepsThePlausibilityOfARun) {
  mdof::Run run = make_run();
  Plausibility p;
  p.cycle = "standard";
  p.runs = 2;
  p.n_ij = {{0.0123456789012, {1, 0}, {1, 1}}, {30.1e-3, {1, 2}, {0, 1}}};
  p.left_out = {{-5e-3, 123'456'789'012, "the axis was \"parked\" there"}};
  p.short_stops = 3;
  p.rate_hz = 1000 / 3.0;
  p.encoder_min_m = -1e-3, p.encoder_max_m = 61e-3;
  p.scans = 123456, p.scans_lost = 7, p.gaps = 2;
  p.probes = {{"A", 78, 10.4e-9, 12e-6, -3e-6, 9e-6}, {"B", 0, kNaN, kNaN, kNaN, kNaN}};
  run.plausibility = p;
  auto store = writer();
  const auto id = store->add_run(run).value();
  const auto back = store->run(id).value().plausibility;
  ASSERT_TRUE(back);
  EXPECT_EQ(plausibility_json(*back), plausibility_json(p));
  EXPECT_EQ(back->n_ij[1].forward, (std::vector<int>{1, 2}));
  EXPECT_EQ(back->left_out[0].reason, p.left_out[0].reason);
  EXPECT_TRUE(std::isnan(back->probes[1].sd_m));
  EXPECT_EQ(result_sha256(run),
            result_sha256(make_run()));  // the plausibility is not part of the result
  EXPECT_FALSE(store->run(store->add_run(make_run()).value()).value().plausibility);
  tamper("DROP TRIGGER run_plausibility_no_update; UPDATE run_plausibility SET json = '{'");
  EXPECT_TRUE(
      contains(store->run(id).error().message, "end of run 1: was changed after it was stored"));
}

TEST_F(StoreTest, AnUnknownScalarStaysUnknown) {
  mdof::Run run = make_run(1);
  run.points[0].target_m = kNaN;
  run.points[0].errors.local[2] = kNaN;
  auto store = writer();
  const mdof::Run back = store->run(store->add_run(run).value()).value();
  EXPECT_TRUE(std::isnan(back.points[0].target_m));
  EXPECT_TRUE(std::isnan(back.points[0].errors.local[2]));
  EXPECT_EQ(result_sha256(back), result_sha256(run));
}

TEST_F(StoreTest, TheResultHashDetectsAChangeOfOneBit) {
  const mdof::Run run = make_run();
  const std::string hash = result_sha256(run);
  const auto changed = [&](auto change) {
    mdof::Run other = run;
    change(other);
    return result_sha256(other) != hash;
  };
  EXPECT_TRUE(changed([](mdof::Run& r) {
    r.points[5].errors.local[3] = std::nextafter(r.points[5].errors.local[3], 1);
  }));
  EXPECT_TRUE(changed([](mdof::Run& r) { r.points[5].errors.covariance[24] *= -1; }));
  EXPECT_TRUE(changed([](mdof::Run& r) { r.points[5].point.flags.push_back({Flag::gap}); }));
  EXPECT_TRUE(changed([](mdof::Run& r) { r.points[5].point.probe_m.pop_back(); }));
  EXPECT_TRUE(changed([](mdof::Run& r) { r.points.pop_back(); }));
  EXPECT_TRUE(changed([](mdof::Run& r) { std::swap(r.points[0], r.points[1]); }));
  EXPECT_TRUE(changed([](mdof::Run& r) { r.straightness[0].valley_position_m = 0.0; }));
  EXPECT_TRUE(changed([](mdof::Run& r) { r.angles[0].approach = "forward"; }));
  EXPECT_FALSE(changed([](mdof::Run& r) { r.header.note = "another"; }));
}

TEST_F(StoreTest, ALiveRunIsStoredInParts) {
  const mdof::Run run = make_run(30);
  auto store = writer();
  RunHeader header = run.header;
  header.provenance.recording_kind = "live";
  header.provenance.recording_sha256.clear();
  const std::int64_t id = store->begin_run(header).value();
  EXPECT_EQ(store->run_header(id)->state, RunState::open);
  // Another process reads the same state.
  EXPECT_EQ(reader()->run_header(id)->state, RunState::open);
  for (std::size_t i = 0; i < 30; i += 10) {
    const auto at = run.points.begin() + static_cast<std::ptrdiff_t>(i);
    ASSERT_TRUE(store->append_points(id, {at, at + 10}));
  }
  RunEnd end{RunState::complete,
             99,
             1,
             {notice(NoticeCode::cycle_unknown)},
             std::string(64, 'c'),
             run.straightness,
             run.angles,
             std::nullopt,
             Temperature{20.125, 19.5, 20.75}};
  ASSERT_TRUE(store->end_run(id, end));
  const RunHeader back = store->run_header(id).value();
  EXPECT_EQ(back.state, RunState::complete);
  EXPECT_EQ(back.scans, 99u);
  EXPECT_EQ(test::shown(back.notices), "cycle_unknown\n");
  EXPECT_EQ(back.temperature, (Temperature{20.125, 19.5, 20.75}));
  EXPECT_EQ(back.provenance.recording_sha256, std::string(64, 'c'));
  EXPECT_EQ(back.provenance.recording_path, header.provenance.recording_path);
  EXPECT_EQ(store->result_sha256(id).value(), result_sha256(run));
  EXPECT_EQ(store->append_points(id, run.points).error().code, ErrorCode::conflict);
  EXPECT_TRUE(store->verify()->empty());
}

TEST_F(StoreTest, ARunWithoutItsEndIsAbortedWithANotice) {
  const mdof::Run run = make_run();
  {
    auto store = writer();
    ASSERT_TRUE(store->append_points(store->begin_run(run.header).value(), run.points));
  }
  {
    // This writer holds the lock and has not written anything.
    const auto beginning = WriterLock::acquire(file_, 0);
    ASSERT_TRUE(beginning);
    const RunHeader seen = reader()->run_header(1).value();
    EXPECT_EQ(seen.state, RunState::aborted);
    EXPECT_EQ(test::shown(seen.notices), "interrupted\n");
  }
  // The lock is released, and no writer has started since.
  EXPECT_EQ(reader()->run_header(1)->state, RunState::aborted);
  auto store = writer();
  EXPECT_EQ(store->run_header(1)->state, RunState::aborted);
  EXPECT_EQ(test::shown(store->run_header(1)->notices), "interrupted\n");
  EXPECT_EQ(store->points(1, 0, 100)->size(), run.points.size());
  EXPECT_TRUE(store->verify()->empty());
}

TEST_F(StoreTest, APartialRunIsReadBackAsPartial) {
  mdof::Run run = make_run();
  run.header.state = RunState::partial;
  run.header.notices = {notice(NoticeCode::cycle_unknown)};
  auto store = writer();
  const auto id = store->add_run(run);
  ASSERT_TRUE(id) << id.error().message;
  EXPECT_EQ(store->run_header(*id)->state, RunState::partial);
  EXPECT_EQ(store->run_header(*id)->notices, run.header.notices);
  EXPECT_TRUE(store->verify()->empty());
}

TEST_F(StoreTest, ListsRunsNewestFirstByPageAndAxis) {
  auto store = writer();
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(store->add_run(make_run(1, i % 2 ? Axis::y : Axis::x)));
  const auto ids = [](const std::vector<RunHeader>& list) {
    std::vector<std::int64_t> all;
    for (const auto& header : list) all.push_back(header.id);
    return all;
  };
  EXPECT_EQ(ids(store->list_runs(0, 3).value()), (std::vector<std::int64_t>{6, 5, 4}));
  EXPECT_EQ(ids(store->list_runs(4, 3).value()), (std::vector<std::int64_t>{2, 1}));
  EXPECT_EQ(ids(store->list_runs(1, 9, Axis::y).value()), (std::vector<std::int64_t>{4, 2}));
  EXPECT_EQ(store->count_runs().value(), 6);
  EXPECT_EQ(store->count_runs(Axis::y).value(), 3);
  EXPECT_EQ(store->count_runs(Axis::z).value(), 0);
}

TEST_F(StoreTest, ReadsPointsByPage) {
  const mdof::Run run = make_run(25);
  auto store = writer();
  ASSERT_TRUE(store->add_run(run));
  EXPECT_EQ(store->count_points(1).value(), 25);
  const auto page = store->points(1, 20, 10).value();
  ASSERT_EQ(page.size(), 5u);
  expect_same(page[0], run.points[20]);
  EXPECT_TRUE(store->points(1, 25, 10)->empty());
}

TEST_F(StoreTest, StoresEqualRigsAndRecordingsOnce) {
  auto store = writer();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(store->add_run(make_run(1)));
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_only);
  EXPECT_EQ(db->integer("SELECT count(*) FROM recording").value(), 1);
  // The documents are the rig, the options and an empty text.
  EXPECT_EQ(db->integer("SELECT count(*) FROM document").value(), 3);
}

TEST_F(StoreTest, ACorrectionMustSupersedeAnExistingRun) {
  auto store = writer();
  mdof::Run run = make_run(1);
  ASSERT_TRUE(store->add_run(run));
  run.header.supersedes = 1;
  EXPECT_EQ(store->run_header(store->add_run(run).value())->supersedes, 1);
  run.header.supersedes = 77;
  const auto refused = store->add_run(run);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::not_found);
  EXPECT_EQ(store->count_runs().value(), 2);  // the rejected run left no data
}

TEST_F(StoreTest, ReportsMissingRowsByName) {
  auto store = writer();
  for (const Error& error :
       {store->run(5).error(), store->points(5, 0, 1).error(), store->result_sha256(5).error(),
        store->table(5).error(), store->activate(5, "me", "now").error()}) {
    EXPECT_EQ(error.code, ErrorCode::not_found);
    EXPECT_TRUE(contains(error.message, "mdof.db") && contains(error.message, "5"));
  }
  EXPECT_EQ(store->active(Axis::x).error().code, ErrorCode::not_found);
}

TEST_F(StoreTest, NoRowCanBeChangedOrDeleted) {
  {
    auto store = writer();
    mdof::Run whole = make_run();
    whole.plausibility.emplace();
    whole.header.temperature = Temperature{20, 19, 21};
    RunUncertainty known;
    known.points.resize(whole.points.size());
    ASSERT_TRUE(store->add_run(whole, std::nullopt, known));
    ASSERT_TRUE(store->add_squareness({0, {}, 1, 1, 0, 0, 0, 0, 0, 0, 0, {}, false, "utc"}));
    ASSERT_TRUE(store->activate(store->add_table(make_table({1})).value(), "me", "now",
                                HistoryEntry{"compensation.activate", {}, "now", 0, 0, {}, "why"}));
    ASSERT_TRUE(store->deactivate(Axis::x, "me", "now"));
    ASSERT_TRUE(store->end_study(store->begin_study({}).value(), {}, std::nullopt));
    ASSERT_TRUE(store->add_datum({0, Axis::x, "t7", 0, 0, 0, "now"}));
    ASSERT_TRUE(
        store->change_volumetric(store->add_volumetric(make_volume({1})).value(), "me", "now"));
  }
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
  int tables = 0;  // number of tables, except checkpoints, which are not results
  auto names = db->prepare(
      "SELECT m.name, c.name FROM sqlite_schema AS m JOIN pragma_table_info(m.name) AS c "
      "WHERE m.type = 'table' AND m.name <> 'study_checkpoint' AND c.cid = 0");
  while (names->step().value()) {
    ++tables;
    const std::string name(names->text(0)), column(names->text(1));
    for (const std::string& sql :
         {"DELETE FROM " + name, "UPDATE " + name + " SET " + column + " = " + column}) {
      const Status done = db->execute(sql);
      ASSERT_FALSE(done) << sql;
      EXPECT_TRUE(contains(done.error().message, "append only")) << done.error().message;
    }
  }
  EXPECT_EQ(tables, 25);
}

TEST_F(StoreTest, ViewsNameErrorsByAxisWithTheirSigns) {
  auto store = writer();
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    const mdof::Run run = make_run(1, axis);
    const std::int64_t id = store->add_run(run).value();
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_only);
    for (const ErrorName& error : error_names(axis)) {
      const char view = static_cast<char>(std::tolower(letter(axis)));
      auto row = db->prepare("SELECT " + std::string(error.key) + " FROM v_points_" + view +
                             " WHERE run = " + std::to_string(id));
      ASSERT_TRUE(row) << error.key;
      ASSERT_TRUE(row->step().value());
      EXPECT_EQ(row->real(0), error.sign * to_key_unit(run.points[0].errors.local[error.local]));
    }
  }
}

TEST_F(StoreTest, VerifyFindsChangedResultsAndTexts) {
  {
    auto store = writer();
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(store->add_run(make_run()));
    EXPECT_TRUE(store->verify()->empty());
  }
  const auto findings = [&] {
    const auto found = reader()->verify().value();
    std::string all;
    for (const std::string& finding : found) all += finding + "\n";
    return all;
  };
  tamper(
      "DROP TRIGGER point_no_update; UPDATE point SET ey_rad = ey_rad * 1.0000001 WHERE run = 2 "
      "AND row = 3");
  EXPECT_TRUE(contains(findings(), "run 2 ")) << findings();
  EXPECT_FALSE(contains(findings(), "run 1:")) << findings();
  tamper("DROP TRIGGER document_no_update; UPDATE document SET text = 'x' WHERE id = 1;");
  EXPECT_TRUE(contains(findings(), "document 1 ")) << findings();
  EXPECT_TRUE(contains(findings(), "run 1: was changed after it was stored")) << findings();
  tamper("PRAGMA foreign_keys = OFF; DROP TRIGGER recording_no_delete; DELETE FROM recording");
  EXPECT_TRUE(contains(findings(), "refers to a row of recording")) << findings();
  EXPECT_TRUE(contains(findings(), "run 1: is missing")) << findings();
}

}  // namespace
}  // namespace mdof::store
