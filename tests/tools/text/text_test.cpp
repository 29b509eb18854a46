#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "schema/sample.h"
#include "schema/study/study.h"
#include "tools/mdof/commands/measure/live_view.h"
#include "tools/mdof/study/output.h"
#include "tools/mdof/text/json_text.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr const char* kUpdate =
    R"({"jsonrpc":"2.0","method":"live.update","params":{"missed":0,"value":{"axis":"X",)"
    R"("time_ns":1,"encoder_mm":12.5,"still":true,"simulated":true,"probes":[)"
    R"({"id":"A","um":50,"quality":"simulated","range_um":200},)"
    R"({"id":"B","um":null,"quality":"missing","range_um":200}],)"
    R"("errors":{"EYX_um":0.25,"EAX_urad":-3.5},"run":7}}})";

TEST(TextTable, AlignsNumbersRightAndTextLeft) {
  TextTable table({"error", "value/µm"});
  table.add({"EYX", "-12.5000"});
  table.add({"E", "3.0000"});
  EXPECT_EQ(table.text(),
            "error  value/µm\n"
            "-----  --------\n"
            "EYX    -12.5000\n"
            "E        3.0000\n");
}

TEST(TextTable, CountsCharactersNotBytes) {
  TextTable table({"a", "b"});
  table.add({"±±", "x"});
  table.add({"zz", "y"});
  EXPECT_EQ(table.text(), "a   b\n--  -\n±±  x\nzz  y\n");
}

TEST(TextTable, UnknownValuesAreADash) {
  EXPECT_EQ(in_um(kNaN), "-");
  EXPECT_EQ(with_u(in_um(kNaN), in_um(1e-9)), "-");
  EXPECT_EQ(with_u(in_um(58.44e-9), in_um(2.1e-9)), "0.0584 ± 0.0021");
  EXPECT_EQ(in_urad(-1.0005e-6), "-1.000");
}

TEST(RangeBar, ShowsThePositionInTheRange) {
  EXPECT_EQ(range_bar(0, -100, 100)[21], '#');
  EXPECT_EQ(range_bar(-99.9, -100, 100)[1], '#');
  EXPECT_EQ(range_bar(99.9, -100, 100)[41], '#');
  EXPECT_EQ(range_bar(100, -100, 100).back(), '>');
  EXPECT_EQ(range_bar(-100, -100, 100).front(), '<');
  EXPECT_EQ(range_bar(1e300, -100, 100).back(), '>');
  // A gap probe with a range of 200 um and an offset of 40 um.
  EXPECT_EQ(range_bar(-130, -159.9, 39.9).find('#'), 7u);
  EXPECT_EQ(range_bar(41.98, -159.9, 39.9).back(), '>');
  EXPECT_EQ(range_bar(kNaN, -100, 100).find_first_of("#<>."), std::string::npos);
  EXPECT_EQ(range_bar(1, 0, 0).find_first_of("#<>."), std::string::npos);
}

TEST(LiveUpdate, IsReadFromItsNotification) {
  const auto update = read_update(kUpdate);
  ASSERT_TRUE(update);
  EXPECT_EQ(update->axis, "X");
  EXPECT_EQ(update->encoder_mm, 12.5);
  EXPECT_TRUE(update->still && update->simulated);
  ASSERT_EQ(update->probes.size(), 2u);
  EXPECT_EQ(update->probes[0].um, 50);
  EXPECT_TRUE(std::isnan(update->probes[1].um));
  ASSERT_EQ(update->errors.size(), 2u);
  EXPECT_EQ(update->errors[1], (std::pair<std::string, double>("EAX_urad", -3.5)));
  EXPECT_EQ(update->run, 7);
}

TEST(LiveUpdate, RejectsOtherMessages) {
  for (const char* line :
       {"", "{", "[]", "42", "null", "{\"method\":\"run.event\",\"params\":{\"value\":{}}}",
        "{\"method\":\"live.update\"}", "{\"method\":\"live.update\",\"params\":[1]}"})
    EXPECT_FALSE(read_update(line)) << line;
  EXPECT_TRUE(read_update(R"({"method":"live.update","params":{"value":{}}})"));
}

TEST(LiveScreen, PrintsOneLineWithoutATerminal) {
  LiveScreen screen(false, 80);
  const std::string line = screen.next(*read_update(kUpdate));
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  EXPECT_EQ(line.find('\x1b'), std::string::npos);
  EXPECT_NE(line.find("SIMULATED"), std::string::npos);
  EXPECT_NE(line.find("A 50.000 µm"), std::string::npos);
}

TEST(LiveScreen, DrawsReadingsInTheRangesOfTheRig) {
  ProbeRanges ranges;
  ranges.add("Y", R"({"probes":[{"id":"A","low_um":0,"high_um":1}]})");
  ranges.add("X", R"({"probes":[{"id":"A","low_um":-159.9,"high_um":39.9}]})");
  LiveUpdate update = *read_update(kUpdate);
  ranges.apply(update);
  EXPECT_EQ(update.probes[0].low_um, -159.9);
  EXPECT_EQ(update.probes[1].high_um, 100) << "not in the rig: half the range";
  const std::string shown = LiveScreen(true, 100).next(update);
  EXPECT_NE(shown.find(">"), std::string::npos) << shown;
}

TEST(LiveScreen, StatesTheAgeOfStaleReadingsAndTheLateProbe) {
  std::string update = kUpdate;
  update.insert(update.find("\"probes\""), R"("stale":true,"age_s":3.02,"waiting_for":"E",)");
  LiveScreen screen(false, 200);
  const std::string line = screen.next(*read_update(update));
  EXPECT_NE(line.find("STALE: the values are 3.0 s old, waiting for E"), std::string::npos) << line;
}

TEST(LiveScreen, StatesThatAPositionIsUnknownOrSuspect) {
  const auto shown = [](const std::string& position) {
    std::string update = kUpdate;
    const auto at = update.find("\"encoder_mm\"");
    update.replace(at, update.find(",\"simulated\"") - at, position);
    return LiveScreen(false, 200).next(*read_update(update));
  };
  const std::string none = shown(R"("encoder_mm":null,"encoder_quality":"missing","still":null)");
  EXPECT_NE(none.find("X: position unknown"), std::string::npos) << none;
  EXPECT_EQ(none.find("moving"), std::string::npos) << none;
  const std::string suspect =
      shown(R"("encoder_mm":12.5,"encoder_quality":"suspect","still":false)");
  EXPECT_NE(suspect.find("X at 12.5000 mm, moving, position suspect"), std::string::npos)
      << suspect;
}

TEST(LiveScreen, RedrawsInPlaceOnATerminal) {
  LiveScreen screen(true, 80);
  const std::string first = screen.next(*read_update(kUpdate));
  const std::string second = screen.next(*read_update(kUpdate));
  EXPECT_EQ(first.find("\x1b["), first.find("\x1b[K"));
  const auto lines = std::count(first.begin(), first.end(), '\n');
  EXPECT_TRUE(second.starts_with("\x1b[" + std::to_string(lines) + "A"));
}

TEST(LiveScreen, ShowsNoControlCharactersOfADevice) {
  std::string update = kUpdate;
  const auto at = update.find("\"A\"");
  ASSERT_NE(at, std::string::npos);
  update.replace(at, 3, "\"A\\u001b[2J\\u009b\"");
  for (const bool terminal : {false, true}) {
    LiveScreen screen(terminal, 80);
    const std::string shown = screen.next(*read_update(update));
    EXPECT_EQ(shown.find("\x1b[2J"), std::string::npos);
    EXPECT_NE(shown.find("A?[2J?"), std::string::npos) << shown;
  }
}

TEST(JsonText, ShowsMembersAndTables) {
  EXPECT_EQ(readable(R"({"a":1,"b":{"c":"x"},"d":[{"e":1,"f":null},{"e":20}],"g":[]})"),
            "a: 1\nb.c: x\ng: -\n\nd\n e  f\n--  -\n 1  -\n20\n");
}

TEST(JsonText, ReturnsInvalidJsonWithANewline) {
  EXPECT_EQ(readable("{"), "{\n");
}

// The first requirement is not met even without the tolerance. In the second, its size is 0.
TEST(StudyText, AToleranceThatCannotMeetTheLimitIsNotZero) {
  StudyResult result;
  result.allocations = {{"EYX_um", 2, 0.95, 0.5, {{"probe.A.x_um", 0, 0, 0}}, 0, {}},
                        {"EZX_um", 2, 0.95, 0.97, {{"probe.B.x_um", 0, 0, 0}}, 1, {}}};
  const std::string text = study_text(result);
  EXPECT_NE(text.find("alone     probe.A.x_um: none; the limit is not met"), std::string::npos)
      << text;
  EXPECT_NE(text.find("together: none; the limit is not met"), std::string::npos) << text;
  EXPECT_EQ(text.find("probe.B.x_um: none"), std::string::npos) << text;
  EXPECT_NE(text.find("multiplied by 1.0000"), std::string::npos) << text;
}

}  // namespace
}  // namespace mdof::tools
