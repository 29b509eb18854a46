#include "schema/notice/notice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "schema/notice/notice_json.h"
#include "tests/shown.h"

namespace mdof {
namespace {

using test::shown;

TEST(Notice, HasTheSeverityOfItsCode) {
  EXPECT_EQ(notice(NoticeCode::cycle_unknown).severity, Severity::doubtful);
  EXPECT_EQ(notice(NoticeCode::pendulum_assumed).severity, Severity::information);
  EXPECT_EQ(severity(NoticeCode::targets_shifted), Severity::invalid);
}

TEST(Notice, EachCodeIsFoundByItsName) {
  for (int i = 0;; ++i) {
    const auto code = static_cast<NoticeCode>(i);
    EXPECT_EQ(notice_code_from(to_string(code)), code);
    if (code == NoticeCode::made_of_several_probes) break;  // the last row of the list of codes
  }
  EXPECT_FALSE(notice_code_from("probe"));
  EXPECT_FALSE(notice_code_from(""));
}

TEST(Notice, InheritedNoticesNameTheirSources) {
  Notice stepped = notice(NoticeCode::probe_stepped, "E", {{"step_um", 0.5}, {"time_s", 2}});
  EXPECT_EQ(shown(inherited("of two", inherited("run 3", stepped))),
            "of two: run 3: probe_stepped E step_um=0.5 time_s=2");
}

TEST(Notice, KeepsTenEqualNoticesAndCountsTheOthers) {
  const Notice one = notice(NoticeCode::visit_missing, "",
                            {{"run", 1}, {"approach", "forward"}, {"targets", "target 3"}});
  for (const std::size_t n : {0u, 10u, 11u, 40u}) {
    Notices kept;
    append_first(kept, Notices(n, one));
    ASSERT_EQ(kept.size(), n > 10 ? 11u : n);
    if (n <= 10) continue;
    EXPECT_EQ(shown(kept.back()),
              "more_alike count=" + std::to_string(n - 10) + " alike=visit_missing");
    EXPECT_EQ(kept.back().severity, Severity::doubtful);
  }
}

TEST(NoticeJson, IsReadAsItWasWritten) {
  Notices notices = {
      notice(NoticeCode::probe_stepped, "E", {{"step_um", -0.1}, {"time_s", 1e-9}}),
      inherited("run 3", notice(NoticeCode::failure, "", {{"words", "a \"quoted\"\nline"}})),
      notice(NoticeCode::targets_shifted, "", {{"time_s", 0.1 + 0.2}, {"shift_mm", 5}})};
  const auto read = read_notices(notices_json(notices));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, notices);
  EXPECT_EQ(notices_json({}), "[]");
  EXPECT_EQ(notices_json({notices[2]}),
            R"([{"code":"targets_shifted","severity":"invalid","time_s":0.30000000000000004,)"
            R"("shift_mm":5}])");
}

TEST(NoticeJson, MissingNumberIsNull) {
  const auto read = read_notices(
      notices_json({notice(NoticeCode::travel_too_long, "", {{"travel_m", std::nan("")}})}));
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::isnan(test::number(read->at(0), "travel_m")));
}

// Older versions stored a notice as a sentence. The first word of the sentence may be the
// severity.
TEST(NoticeJson, ReadsASentenceWithItsSeverity) {
  const auto read = read_notices(
      R"(["interrupted","information: the axis was parked","invalid: x","no information: y"])");
  ASSERT_TRUE(read);
  EXPECT_EQ(shown(*read),
            "legacy words=interrupted\nlegacy words=the axis was parked\nlegacy words=x\n"
            "legacy words=no information: y\n");
  EXPECT_EQ(read->at(0).severity, Severity::doubtful);
  EXPECT_EQ(read->at(1).severity, Severity::information);
  EXPECT_EQ(read->at(2).severity, Severity::invalid);
  EXPECT_EQ(read->at(3).severity, Severity::doubtful);
}

TEST(NoticeJson, UnknownCodeKeepsItsNameAndIsDoubtful) {
  const auto read = read_notices(R"([{"code":"new_thing","severity":"information","x_mm":1}])");
  ASSERT_TRUE(read);
  EXPECT_EQ(shown(*read), "legacy words=new_thing\n");
  EXPECT_EQ(read->at(0).severity, Severity::doubtful);
}

TEST(NoticeJson, RejectsOtherJson) {
  for (const char* text : {"", "{}", "[1]", "[null]", "[{}]", R"([{"code":1}])", "[[]]", "[",
                           R"([{"code":"cycle_unknown","x":[1]}])"})
    EXPECT_FALSE(read_notices(text)) << text;
}

}  // namespace
}  // namespace mdof
