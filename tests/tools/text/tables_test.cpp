#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "algo/uncertainty/run_uncertainty.h"
#include "schema/run_json.h"
#include "schema/sample.h"
#include "tests/shown.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/csv/log_csv.h"
#include "tools/mdof/csv/run_csv.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/run_text.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

std::size_t widest(const std::string& text) {
  std::istringstream lines(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(lines, line);) widest = std::max(widest, text_width(line));
  return widest;
}

TEST(TextTable, SplitsIntoTablesThatBeginWithTheKeyColumns) {
  TextTable table({"run", "dir", "a/µm", "b/µm", "flags"}, 2);
  table.add({"1", "+", "1.0000", "2.0000", ""});
  table.add({"2", "-", "3.0000", "4.0000", ""});
  EXPECT_EQ(table.text(40), table.text());
  EXPECT_EQ(table.text(18),
            "run  dir    a/µm\n"
            "---  ---  ------\n"
            "  1    +  1.0000\n"
            "  2    -  3.0000\n"
            "\n"
            "run  dir    b/µm\n"
            "---  ---  ------\n"
            "  1    +  2.0000\n"
            "  2    -  4.0000\n");
}

TEST(TextTable, BreaksTextWithinItsColumn) {
  TextTable table({"run", "flags"});
  table.add({"1", "saturated:A lost:B unsolved: five probes are needed and three are left"});
  table.add({"2", "short"});
  EXPECT_EQ(table.text(36),
            "run  flags\n"
            "---  -------------------------------\n"
            "  1  saturated:A lost:B unsolved:\n"
            "     five probes are needed and\n"
            "     three are left\n"
            "  2  short\n");
}

TEST(TextTable, NarrowsTheWidestTextColumnFirst) {
  TextTable table({"check", "value", "result"});
  table.add({"the errors of a known movement are calculated", "0.1", "ok"});
  EXPECT_EQ(table.text(46),
            "check                            value  result\n"
            "-------------------------------  -----  ------\n"
            "the errors of a known movement     0.1  ok\n"
            "are calculated\n");
}

TEST(TextTable, BreaksLongWordsButNoPaths) {
  const std::string word(100, 'w'), path = "/" + word;
  for (const std::string& note : {word, path}) {
    TextTable table({"run", "note"});
    table.add({"1", note});
    EXPECT_EQ(widest(table.text(40)), note == word ? 40u : path.size() + 5);
  }
}

// The example of GUM 7.2.6: 10.057 62 Ω with u = 27 mΩ is written as 10.058 Ω.
TEST(Rounded, UHasTwoDigitsAndTheValueEqualDecimals) {
  EXPECT_EQ(with_u(10.05762, 0.027, 4), "10.058 ± 0.027");
  EXPECT_EQ(with_u(12.3456, 1.149, 4), "12.3 ± 1.1");
  EXPECT_EQ(with_u(-0.123456, 0.00996, 4), "-0.123 ± 0.010");  // 0.00996 is rounded to 0.010
  EXPECT_EQ(with_u(12345.6, 1234, 4), "12300 ± 1200");
  EXPECT_EQ(with_u(1.25, 99.6, 4), "0 ± 100");
  EXPECT_EQ(with_u(-1e-9, 0.5, 4), "0.00 ± 0.50");  // the result is never -0
  EXPECT_EQ(um_with_u(1.23456e-6, 3.21e-9), "1.2346 ± 0.0032");
  EXPECT_EQ(urad_with_u(1.23456e-6, 0.32e-6), "1.23 ± 0.32");
  EXPECT_EQ(um_to_place(1.23456e-6, 0.64e-6), "1.23");
  EXPECT_EQ(urad_to_place(3.3e-5, 3.3e-5), "33");
}

TEST(Rounded, AColumnWithSimilarUHasEqualDecimals) {
  EXPECT_EQ(column_u({0.9, 1.1, 0.5}), 1.1);
  EXPECT_EQ(column_u({0.2, 1.0}), 1.0);
  EXPECT_EQ(column_u({0.19, 1.0}), 0);  // with the place of 1.0, 0.19 would have only one digit
  EXPECT_EQ(column_u({}), 0);
  EXPECT_EQ(um_with_u(1e-6, 0.99e-9, 1.1e-9), "1.0000 ± 0.0010");
  EXPECT_EQ(urad_with_u(1e-6, 0.099e-6, 0.11e-6), "1.00 ± 0.10");
}

// If u is unknown, the number has the usual number of decimals.
TEST(Rounded, WithoutUHasTheUsualDecimals) {
  EXPECT_EQ(um_to_place(1.23456e-6, 0), "1.2346");
  EXPECT_EQ(urad_to_place(1.23456e-6, kNaN), "1.235");
  EXPECT_EQ(um_with_u(1.23456e-6, kNaN), "1.2346 ± -");
  EXPECT_EQ(um_with_u(kNaN, 1e-9), "-");
}

TEST(Wrapped, KeepsALongWordWholeAndCountsCharacters) {
  EXPECT_EQ(wrapped("note       a bb ccc", 14, 11), "note       a\n           bb\n           ccc");
  EXPECT_EQ(wrapped("/a/path/that/is/longer x", 10), "/a/path/that/is/longer\nx");
  EXPECT_EQ(wrapped("µµµµ ±±±± µ", 11), "µµµµ ±±±± µ");
  EXPECT_EQ(wrapped("", 10), "");
}

TEST(Fixed, HasNoMinusZeroAndNo300Digits) {
  EXPECT_EQ(fixed(-0.0, 4), "0.0000");
  EXPECT_EQ(fixed(-4e-5, 4), "0.0000");
  EXPECT_EQ(fixed(-6e-5, 4), "-0.0001");
  EXPECT_EQ(fixed(-0.0, 0), "0");
  EXPECT_EQ(fixed(-1e300, 4), "-1.0000e+300");
  EXPECT_EQ(fixed(123456789.5, 1), "123456789.5");
  EXPECT_EQ(fixed(kNaN, 4), "-");
}

TEST(NoticeLines, ShowsThreeOfACodeAndACount) {
  Notices many{notice(NoticeCode::cycle_unknown)};
  for (int i = 0; i < 100; ++i)
    many.push_back(notice(NoticeCode::probe_stepped, "A", {{"step_um", i}, {"time_s", 2}}));
  const auto few = summarised(many, false);
  ASSERT_EQ(few.size(), 5u);
  EXPECT_EQ(few[0], many[0]);
  EXPECT_EQ(few[3], many[3]);
  EXPECT_EQ(test::shown(few[4]), "not_shown count=97");
  EXPECT_EQ(few[4].severity, Severity::doubtful);
  EXPECT_EQ(summarised(many, true), many);
  const Notices four(many.begin() + 1, many.begin() + 5);
  EXPECT_EQ(summarised(four, false),
            four);  // a line "and 1 more" would be as long as the fourth notice
}

TEST(TerminalColumns, APipeHas80OrTheStatedColumns) {
  if (::isatty(STDOUT_FILENO) == 1) GTEST_SKIP() << "the standard output is a terminal";
  const std::pair<const char*, std::size_t> cases[] = {
      {"132", 132}, {"20", 80}, {"0", 80}, {"", 80}, {"x", 80}, {"99999999999999999999", 80}};
  for (const auto& [stated, columns] : cases) {
    ::setenv("COLUMNS", stated, 1);
    EXPECT_EQ(terminal_columns(), columns) << stated;
  }
  ::unsetenv("COLUMNS");
  EXPECT_EQ(terminal_columns(), 80u);
}

TEST(CsvText, UnknownIsEmptyAndSpecialTextIsQuoted) {
  CsvText csv;
  csv.cell(0.1).cell(kNaN).cell(-0.0).cell(7LL).cell("a, \"b\"").cell("c").end_row();
  EXPECT_EQ(csv.take(), "0.10000000000000001,,0,7,\"a, \"\"b\"\"\",c\n");
}

Run one_point(bool valid, const std::string& reason) {
  Run run;
  run.header.notices.assign(40, notice(NoticeCode::cycle_unknown));
  MeasuredPoint p;
  p.target = 1;
  p.run = 1;
  p.point.position_m = -0.12345678;
  p.point.flags = {{Flag::saturated, "A"}, {Flag::spike, "B"}, {Flag::frozen, "C"},
                   {Flag::lost, "D"},      {Flag::slow, "E"},  {Flag::gap}};
  p.errors.valid = valid;
  p.errors.reason = reason;
  p.errors.local = {-123.4567e-6, 1e-9, -4999.123e-6, -0.0, 1e290};
  for (std::size_t k = 0; k < 5; ++k) p.errors.covariance[6 * k] = k == 3 ? 0 : 1e-14;
  run.points.push_back(p);
  return run;
}

RunUncertainty noise_of(const Run& run) {
  Rig nothing_declared;
  return algo::run_uncertainty(nothing_declared, run);
}

TEST(RunTables, FitTheWidthOfTheTerminal) {
  for (const bool valid : {true, false}) {
    const auto run = one_point(valid, "five probes are needed, and of A, B, C two are left");
    for (const std::size_t width : {80u, 100u, 132u, 200u})
      for (const Extent extent : {Extent::brief, Extent::figures, Extent::all})
        EXPECT_LE(widest(run_text(run, {noise_of(run), {{}, "too few"}}, std::string(64, 'a'),
                                  width, extent)),
                  width);
  }
}

TEST(RunTables, UnknownUncertaintyIsNotShownAsZero) {
  const auto run = one_point(true, "");
  const std::string text = points_text(run, noise_of(run), 200);
  EXPECT_EQ(text.find("± 0.000"), std::string::npos) << text;
  EXPECT_EQ(text.find("-0.000 "), std::string::npos) << text;
}

TEST(RunCsv, HasUnitsAndEmptyCellsForUnknownValues) {
  const auto run = one_point(true, ""), unsolved = one_point(false, "why");
  const std::string csv = points_csv(run, noise_of(run));
  EXPECT_TRUE(
      csv.starts_with("target,target_mm,run,direction,position_mm,EYX_um,EZX_um,EAX_urad,"
                      "EBX_urad,ECX_urad,u_EYX_um,u_EZX_um,u_EAX_urad,u_EBX_urad,"
                      "u_ECX_urad,u_random_EYX_um,u_random_EZX_um,u_random_EAX_urad,"
                      "u_random_EBX_urad,u_random_ECX_urad,U_EYX_um,U_EZX_um,U_EAX_urad,"
                      "U_EBX_urad,U_ECX_urad,samples,flags,reason,u_covers,"
                      "not_declared,reference,reference_mm\n1,0,1,0,-123.45678"));
  EXPECT_NE(csv.find(",fixture,0 0 0\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",0.099999999999999992,,0.099999999999999992,"), std::string::npos) << csv;
  EXPECT_NE(points_csv(unsolved, noise_of(unsolved)).find(",,,,,,,,,,,,,,,,,,,,0,saturated:A"),
            std::string::npos);
}

// The keys of the errors are for the moving body. If the fixture moves, the errors in the CSV have
// the opposite sign, as in the JSON.
TEST(RunCsv, StatesTheErrorsOfTheMovingBody) {
  auto run = one_point(true, "");
  EXPECT_NE(points_csv(run, noise_of(run)).find(",-123.4567,"), std::string::npos)
      << points_csv(run, noise_of(run));
  run.header.sides.fixture_moves = true;
  EXPECT_NE(points_csv(run, noise_of(run)).find(",123.4567,"), std::string::npos)
      << points_csv(run, noise_of(run));
  JsonWriter json;
  const RunUncertainty uncertainty = noise_of(run);
  write_run_members(json.begin_object(), {run, run.header, uncertainty, {}}, nullptr);
  EXPECT_NE(json.text().find("\"EYX_um\":123.4567,"), std::string::npos);
}

TEST(LogCsv, HasTimesToTheNanosecond) {
  const std::vector<Channel> channels{
      {"encoder", Unit::um}, {"A", Unit::volt}, {"temperature", Unit::deg_c}, {"n", Unit::other}};
  EXPECT_EQ(log_csv_head({"axis: X"}, channels),
            "# axis: X\ntime_s,encoder_mm,A_V,temperature_C,n\n");
  SampleBlock block;
  block.channels = channels;
  block.time_ns = {-1, 1'000'000'002};
  block.value = {{1500, kNaN}, {0.5, 1}, {20.25, 3}, {1, 2}};
  block.quality = {{}, {Quality::good, Quality::missing}, {Quality::over_range, Quality::good}, {}};
  std::string rows;
  append_log_csv(rows, block);
  EXPECT_EQ(rows, "-0.000000001,1.5,0.5,20.25,1\n1.000000002,,,3,2\n");
  EXPECT_EQ(marked_values(block), 1u);
}

}  // namespace
}  // namespace mdof::tools
