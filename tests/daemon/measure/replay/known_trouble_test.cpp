#include "daemon/measure/replay/known_trouble.h"

#include "tests/daemon/store/fixtures.h"
#include "tests/shown.h"

namespace mdof::daemon {
namespace {

class KnownTrouble : public store::StoreTest {
 protected:
  KnownTrouble() {
    run_.header.provenance.recording_kind = "recording";
    run_.header.notices = {
        notice(NoticeCode::device_trouble, "t7",
               {{"kind", "lost"}, {"times", 1}, {"utc", ""}, {"reason", ""}, {"end", ""}}),
        notice(NoticeCode::cycle_unknown)};
  }
  // The notices of a replay of the recording of run 1.
  Notices replayed() {
    auto store = writer();
    mdof::Run again = run_;
    again.header.notices = {};
    const Status added = add_known_trouble(store.value(), again);
    EXPECT_TRUE(added) << added.error().message;
    return again.header.notices;
  }
  mdof::Run run_ = store::make_run(2);
};

TEST_F(KnownTrouble, AReplayHasTheTroublesOfItsRun) {
  ASSERT_TRUE(writer()->add_run(run_));
  EXPECT_EQ(replayed(), Notices({inherited("run 1", run_.header.notices[0])}));
  run_.header.provenance.recording_sha256 = std::string(64, 'b');
  EXPECT_EQ(replayed(), Notices());
}

TEST_F(KnownTrouble, ADamagedRunDoesNotPreventItsReplay) {
  ASSERT_TRUE(writer()->add_run(run_));
  tamper("DROP TRIGGER run_no_update; UPDATE run SET note = 'changed'");
  const Notices found = replayed();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, NoticeCode::row_damaged);
  EXPECT_EQ(found[0].source, "run 1");
}

}  // namespace
}  // namespace mdof::daemon
