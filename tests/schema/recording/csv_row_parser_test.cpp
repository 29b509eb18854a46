#include "schema/recording/csv_row_parser.h"
#include "tests/shown.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace mdof {
namespace {

struct Parsed {
  std::vector<SampleBlock> blocks;
  std::vector<std::string> bad_lines;
  Notices missing;    // notices about missing values of columns
  std::string error;  // empty if there is no error

  std::vector<std::int64_t> times() const {
    std::vector<std::int64_t> all;
    for (const SampleBlock& b : blocks) all.insert(all.end(), b.time_ns.begin(), b.time_ns.end());
    return all;
  }
  std::vector<double> column(std::size_t channel) const {
    std::vector<double> all;
    for (const SampleBlock& b : blocks)
      all.insert(all.end(), b.value[channel].begin(), b.value[channel].end());
    return all;
  }
};

// Passes `text` to the parser in pieces of at most `piece` bytes. Each piece is in separate
// memory.
Parsed parse(std::string text, CsvLimits limits = {}, CsvKind kind = CsvKind::probe_log,
             std::size_t piece = 1'000'000) {
  Parsed result;
  auto header = parse_csv_header(text, kind, "x.csv");
  if (!header) return {{}, {}, {}, header.error().message};
  text.erase(0, header->bytes);
  if (!text.empty() && text.back() != '\n') text += '\n';
  CsvRowParser parser(*header, limits);
  auto take = [&](Result<bool> (CsvRowParser::*next)(SampleBlock&)) {
    SampleBlock block;
    const Result<bool> more = (parser.*next)(block);
    if (!more) result.error = more.error().message;
    if (more && *more) result.blocks.push_back(block);
    return more && *more;
  };
  while (!text.empty() && result.error.empty()) {
    std::size_t size = text.rfind('\n', std::max<std::size_t>(piece, 1) - 1);
    size = (size == text.npos ? text.find('\n') : size) + 1;
    const std::string margin(kCsvMargin, '5');
    const std::string padded = margin + text.substr(0, size) + margin;
    text.erase(0, size);
    parser.give(std::string_view(padded).substr(kCsvMargin, size));
    while (take(&CsvRowParser::next)) {
    }
  }
  if (result.error.empty()) take(&CsvRowParser::last);
  result.bad_lines = parser.bad_lines();
  result.missing = parser.missing_values();
  return result;
}

const std::string kHeader = "time_s,encoder_mm,A_um\n";

void expect_contains(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), text.npos) << text << "\nlacks: " << word;
}

TEST(CsvRowParser, ReadsRowsIntoColumns) {
  const Parsed p = parse(kHeader + "0.000000,-1.5,0.25\n0.002500,-1.25,1e-3\n0.005,3,.5");
  ASSERT_EQ(p.error, "");
  ASSERT_EQ(p.blocks.size(), 1u);
  EXPECT_EQ(p.times(), (std::vector<std::int64_t>{0, 2'500'000, 5'000'000}));
  EXPECT_EQ(p.column(0), (std::vector<double>{-1.5, -1.25, 3}));
  EXPECT_EQ(p.column(1), (std::vector<double>{0.25, 1e-3, 0.5}));
  EXPECT_EQ(p.blocks[0].channels[1], (Channel{"A", Unit::um}));
  EXPECT_EQ(p.blocks[0].lost, 0u);
}

TEST(CsvRowParser, ReadsMixedCarriageReturns) {
  const Parsed p =
      parse("time_s,encoder_mm,A_um\r\n0,1.0,2.0\r\n1,1.0,2.0\r\n2,1.0,2.0\n3,1.0,2.5\r\n");
  ASSERT_EQ(p.error, "");
  EXPECT_EQ(p.times().size(), 4u);
  EXPECT_EQ(p.column(1), (std::vector<double>{2, 2, 2, 2.5}));
  EXPECT_TRUE(p.bad_lines.empty());
}

TEST(CsvRowParser, ReadsColumnsInAnyOrder) {
  const Parsed p = parse("A_um,temperature_C,time_s,encoder_mm\n1.5,20.1,0.25,7.75\n");
  ASSERT_EQ(p.error, "");
  EXPECT_EQ(p.times(), std::vector<std::int64_t>{250'000'000});
  EXPECT_EQ(p.column(1), std::vector<double>{20.1});
  EXPECT_EQ(p.column(2), std::vector<double>{7.75});
}

// Some programs write a comment at each stop, and the header again after each pause.
TEST(CsvRowParser, CommentsAndTheSameHeaderBetweenRowsAreNoLoss) {
  const Parsed p = parse(kHeader + "0,1,2\n# stop 1\n1,1,3\n" + kHeader + "2,1,4\n #,,\n3,1,5\n");
  ASSERT_EQ(p.error, "");
  EXPECT_EQ(p.column(1), (std::vector<double>{2, 3, 4, 5}));
  EXPECT_TRUE(p.bad_lines.empty());
  for (const SampleBlock& block : p.blocks) EXPECT_EQ(block.lost, 0u);
}

// With the columns of the first header, the readings of two probes would be exchanged.
TEST(CsvRowParser, AnotherHeaderBetweenRowsIsAnError) {
  const std::string header = "time_s,encoder_mm,A_um,B_um\n", row = "0,1,2,3\n";
  for (const char* other : {"time_s,encoder_mm,B_um,A_um\n", "time_s,encoder_mm,A_um\n"})
    expect_contains(parse(header + row + other + "1,1,3,2\n").error,
                    {"x.csv:3: ", "other columns", "split the file"});
}

TEST(CsvRowParser, AHeaderInQuotesOrBelowOtherLinesNamesTheRemedy) {
  expect_contains(parse("\"time_s\",\"encoder_mm\",\"A_um\"\n0,1,2\n").error,
                  {"x.csv:1: ", "save the file without quotes"});
  expect_contains(parse("Measured by PC 4\n" + kHeader + "0,1,2\n").error,
                  {"x.csv:1: no column time_s", "put # at its beginning"});
}

TEST(CsvRowParser, RoundsTimesToTheNearestNanosecond) {
  const Parsed p = parse(kHeader +
                         "-1.5,0,0\n-0.0000000014,0,0\n0.0000000005,0,0\n1.0000000004,0,0\n"
                         "2e0,0,0\n3.25e0,0,0\n12345678.123456789,0,0\n1700000000.123456789,0,0\n"
                         "1700000000.1234567895,0,0\n");
  ASSERT_EQ(p.error, "");
  EXPECT_EQ(p.times(), (std::vector<std::int64_t>{-1'500'000'000, -1, 1, 1'000'000'000,
                                                  2'000'000'000, 3'250'000'000, 12345678123456789,
                                                  1700000000123456789, 1700000000123456790}));
}

TEST(CsvRowParser, ToleratesSpacesAndPlusSigns) {
  const Parsed p = parse(kHeader + "0, 1.5 ,+2.5\n 1,\t1.5,-2.5 \n");
  ASSERT_EQ(p.error, "");
  EXPECT_EQ(p.column(1), (std::vector<double>{2.5, -2.5}));
}

TEST(CsvRowParser, ReportsAndSkipsBadLines) {
  const Parsed p = parse(kHeader +
                         "0,1.0,2.0\n1,abc,2.0\n2,1.0\n3,1.0,2.0,3.0\n4,1.0,inf\n5,inf,2.0\n"
                         "6,1.0,1e999\n7,,2.0\n8,1.0,1/5\n9,1.0,2.0\n\n10,1.0,2.0\n");
  ASSERT_EQ(p.error, "");
  EXPECT_EQ(p.times(), (std::vector<std::int64_t>{0, 9'000'000'000, 10'000'000'000}));
  ASSERT_EQ(p.bad_lines.size(), 9u);
  expect_contains(p.bad_lines[0], {"x.csv:3: ", "encoder_mm", "\"abc\" is not a number"});
  expect_contains(p.bad_lines[1], {"x.csv:4: ", "2 fields", "3 columns"});
  expect_contains(p.bad_lines[2], {"x.csv:5: ", "4 fields"});
  expect_contains(p.bad_lines[3], {"x.csv:6: ", "A_um", "not a finite"});
  expect_contains(p.bad_lines[4], {"x.csv:7: ", "encoder_mm", "not a finite"});
  expect_contains(p.bad_lines[5], {"x.csv:8: ", "A_um", "not a finite"});
  expect_contains(p.bad_lines[6], {"x.csv:9: ", "encoder_mm", "is empty"});
  expect_contains(p.bad_lines[7], {"x.csv:10: ", "A_um", "\"1/5\""});
  expect_contains(p.bad_lines[8], {"x.csv:12: ", "empty line"});
}

// ---- missing values ----

const std::string kTwoProbes = "time_s,encoder_mm,A_um,B_um\n";

TEST(CsvRowParser, TreatsAnEmptyFieldAndNanAsMissing) {
  const Parsed p = parse(kTwoProbes +
                         "0,1.0,,2.0\n1,1.0,nan,2.0\n2,1.0,3.0,NaN\n3,1.0,-nan,\n4,1.0, ,2.0\n"
                         "5,1.0,4.0,5.0\n6,1.0,4.0,\r\n");
  ASSERT_EQ(p.error, "");
  EXPECT_TRUE(p.bad_lines.empty());
  ASSERT_EQ(p.blocks.size(), 1u);
  const std::vector<int> a_missing = {1, 1, 0, 1, 1, 0, 0}, b_missing = {0, 0, 1, 1, 0, 0, 1};
  for (std::size_t row = 0; row < 7; ++row) {
    EXPECT_EQ(std::isnan(p.column(1)[row]), a_missing[row] == 1) << row;
    EXPECT_EQ(std::isnan(p.column(2)[row]), b_missing[row] == 1) << row;
    EXPECT_EQ(p.blocks[0].quality_at(1, row), a_missing[row] ? Quality::missing : Quality::good);
    EXPECT_EQ(p.blocks[0].quality_at(2, row), b_missing[row] ? Quality::missing : Quality::good);
  }
  EXPECT_TRUE(p.blocks[0].quality[0].empty());  // all values of the encoder are good
  EXPECT_EQ(test::shown(p.missing),
            "log_values_missing x.csv: column A_um missing=4 rows=7 first=at 0.000 s\n"
            "log_values_missing x.csv: column B_um missing=3 rows=7 first=at 2.000 s\n");
}

TEST(CsvRowParser, SkipsALineWithoutPositionOrTime) {
  const Parsed p =
      parse(kTwoProbes + "0,1.0,2.0,2.0\n1,,2.0,2.0\n,1.0,2.0,2.0\n3,nan,,2.0\n4,1.0,2.0,2.0\n");
  ASSERT_EQ(p.error, "");
  EXPECT_EQ(p.times(), (std::vector<std::int64_t>{0, 4'000'000'000}));
  ASSERT_EQ(p.bad_lines.size(), 3u);
  expect_contains(p.bad_lines[0], {"x.csv:3: ", "encoder_mm", "is empty"});
  expect_contains(p.bad_lines[1], {"x.csv:4: ", "time_s", "is empty"});
  expect_contains(p.bad_lines[2], {"x.csv:5: ", "encoder_mm", "nan"});
  EXPECT_EQ(test::shown(p.missing), "") << "a line that is skipped has no missing values";
}

// The parser processes 256 rows at a time. In the first half of the text, random values of probe A
// are missing; in the second half, all its values are missing.
TEST(CsvRowParser, FindsEachMissingValueInItsRow) {
  std::string text = kTwoProbes;
  std::mt19937_64 random(3);
  std::vector<bool> missing;
  for (int i = 0; i < 20'000; ++i) {
    missing.push_back(i >= 10'000 || random() % 50 == 0);
    text += std::to_string(i) + "," + std::to_string(i) + (missing.back() ? ",," : ",7.5,") +
            std::to_string(-i) + "\n";
  }
  const Parsed p = parse(text, {.bad_lines = 0});
  ASSERT_EQ(p.error, "");
  const std::vector<double> a = p.column(1), b = p.column(2);
  ASSERT_EQ(a.size(), missing.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(std::isnan(a[i]), missing[i]) << i;
    if (!missing[i]) {
      ASSERT_EQ(a[i], 7.5) << i;
    }
    ASSERT_EQ(b[i], -static_cast<double>(i));
  }
  std::uint64_t marked = 0;
  for (const SampleBlock& block : p.blocks)
    for (std::size_t i = 0; i < block.scans(); ++i)
      marked += block.quality_at(1, i) == Quality::missing;
  EXPECT_EQ(marked, static_cast<std::uint64_t>(std::count(missing.begin(), missing.end(), true)));
}

TEST(CsvRowParser, CountsSkippedLinesAsLostBeforeTheNextBlock) {
  const Parsed p = parse(kHeader + "x\n0,1,2\n1,1,2\nx\nx\n2,1,2\nx\n");
  ASSERT_EQ(p.blocks.size(), 2u);
  EXPECT_EQ(p.blocks[0].lost, 1u);
  EXPECT_EQ(p.blocks[0].scans(), 2u);
  EXPECT_EQ(p.blocks[1].lost, 2u);
  EXPECT_EQ(p.blocks[1].scans(), 1u);
}

TEST(CsvRowParser, AcceptsBlankLinesAtTheEnd) {
  const Parsed p = parse(kHeader + "0,1,2\n\n\r\n  \n\n", {.bad_lines = 0});
  EXPECT_EQ(p.error, "");
  EXPECT_TRUE(p.bad_lines.empty());
  EXPECT_EQ(p.times().size(), 1u);
}

TEST(CsvRowParser, LimitsConsecutiveEmptyLines) {
  const CsvLimits limits{.blank_bytes = 10};
  const std::string row = "0,1,2\n", next = "1,1,2\n";
  // 10 bytes of empty lines.
  EXPECT_EQ(parse(kHeader + row + "\n\r\n\n \r\n\n \n", limits).error, "");
  for (const char* blank : {"\n\n\n\n\n\n\n\n\n\n\n", "\n         \n", "\r\n\r\n\r\n\r\n\r\n\r\n"})
    for (const std::string& end : {std::string(), next})
      for (const std::size_t piece : {1u, 7u, 1'000'000u})
        expect_contains(parse(kHeader + row + blank + end, limits, CsvKind::probe_log, piece).error,
                        {"x.csv:3: ", "more than 10 bytes of empty lines", "record"});
}

TEST(CsvRowParser, RestartsTheCountOfEmptyLinesAfterEachRow) {
  std::string text = kHeader;
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + ",1,2\n\n\n\n\n";
  const Parsed p = parse(text, {.bad_lines = 100, .blank_bytes = 4});
  EXPECT_EQ(p.error, "");
  EXPECT_EQ(p.bad_lines.size(), 19u * 4u);
}

TEST(CsvRowParser, StopsAfterTheStatedNumberOfBadLines) {
  std::string text = kHeader + "0,1,2\n";
  for (int i = 0; i < 5; ++i) text += "bad\n";
  EXPECT_EQ(parse(text, {.bad_lines = 5}).error, "");
  expect_contains(parse(text, {.bad_lines = 4}).error,
                  {"more than 4 bad lines", "x.csv:3: ", "x.csv:5: "});
  expect_contains(parse(text, {.bad_lines = 0}).error, {"x.csv:3: ", "repair"});
}

TEST(CsvRowParser, RejectsTimeThatDoesNotIncrease) {
  expect_contains(parse(kHeader + "0,1,2\n1,1,2\n0.5,1,2\n").error,
                  {"x.csv:4: ", "time_s", "decreases"});
  expect_contains(parse(kHeader + "0,1,2\n1,1,2\n1.0,1,2\n").error,
                  {"x.csv:4: ", "time_s", "does not change"});
}

TEST(CsvRowParser, RecognisesADecimalComma) {
  expect_contains(parse(kHeader + "0,000,1,500,2,250\n").error, {"x.csv:2: ", "decimal comma"});
  expect_contains(parse(kHeader + "0,000;1,500;2,250\n").error, {"x.csv:2: "});
  expect_contains(parse(kHeader + "0.000;1.500;2.250\n").error, {"x.csv:2: ", "semicolon"});
  // Two joined lines are reported as a bad line and are no other error.
  EXPECT_EQ(parse(kHeader + "0.1,1.0,2.00.2,1.0,2.0\n0.3,1.0,2.0\n").bad_lines.size(), 1u);
}

TEST(CsvRowParser, RejectsAFileWithoutAValidRow) {
  expect_contains(parse(kHeader).error, {"x.csv", "no rows"});
  expect_contains(parse(kHeader + "\n\n").error, {"x.csv", "no rows"});
  expect_contains(parse(kHeader + "a,b,c\n").error, {"no valid row", "x.csv:2: ", "\"a\""});
}

TEST(CsvRowParser, RowNumbersAreTheTimesOfAFramesFile) {
  const Parsed p = parse("encoder_mm,A_um\n5,1\n4,2\n4,3\n", {.bad_lines = 0, .scans_per_block = 2},
                         CsvKind::frames);
  ASSERT_EQ(p.error, "");
  ASSERT_EQ(p.blocks.size(), 2u);
  EXPECT_EQ(p.times(), (std::vector<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(p.column(0), (std::vector<double>{5, 4, 4}));
}

// A log with all kinds of fields and line ends, and with some bad lines.
std::string log_with_all_cases(int rows) {
  std::mt19937_64 random(7);
  std::string text = "# c\nA_um,time_s,encoder_mm,B_um\n";
  char line[200];
  for (int i = 0; i < rows; ++i) {
    const double x = static_cast<double>(random() % 2'000'000) * 1e-4 - 100;
    const char* const formats[] = {"%.6f,%d.%03d,%.4f,%.17g", "%.17g,%d.%03d,%.0f,%.17g",
                                   "%.3e,%d.%03d,%g,%.12f", " %f,%d.%03d,%f,+%f", "%f;%d,%d,%f %f"};
    const std::uint64_t kind = random() % 1000;
    std::snprintf(line, sizeof line, formats[kind < 4 ? kind : kind % 2], x, i / 1000, i % 1000,
                  x / 3, std::abs(x) / 7);
    const std::string_view from_time = std::strchr(line, ',');
    text += kind == 10        ? "bad"
            : kind == 11      ? "nan" + std::string(from_time)
            : kind / 20 == 20 ? from_time
                              : line;
    text += random() % 100 ? "\n" : "\r\n";
  }
  return text;
}

// The bits of all values. With bits, a NaN is equal to the same NaN.
std::vector<std::uint64_t> bits(const std::vector<std::vector<double>>& columns) {
  std::vector<std::uint64_t> all;
  for (const auto& column : columns)
    for (const double x : column) all.push_back(std::bit_cast<std::uint64_t>(x));
  return all;
}

TEST(CsvRowParser, GivesTheSameBlocksForAnyDivisionOfTheText) {
  const std::string text = log_with_all_cases(3000);
  const CsvLimits limits{.bad_lines = 1000, .scans_per_block = 100};
  const Parsed whole = parse(text, limits);
  ASSERT_EQ(whole.error, "");
  EXPECT_GT(whole.blocks.size(), 30u);
  EXPECT_GT(whole.bad_lines.size(), 0u);
  EXPECT_EQ(whole.times().size() + whole.bad_lines.size(), 3000u);
  for (const std::size_t piece : {1u, 70u, 1000u, 4096u, 50'000u}) {
    const Parsed cut = parse(text, limits, CsvKind::probe_log, piece);
    ASSERT_EQ(cut.blocks.size(), whole.blocks.size()) << piece;
    EXPECT_EQ(cut.bad_lines, whole.bad_lines);
    for (std::size_t b = 0; b < cut.blocks.size(); ++b) {
      EXPECT_EQ(cut.blocks[b].time_ns, whole.blocks[b].time_ns);
      EXPECT_EQ(bits(cut.blocks[b].value), bits(whole.blocks[b].value));
      EXPECT_EQ(cut.blocks[b].quality, whole.blocks[b].quality);
      EXPECT_EQ(cut.blocks[b].lost, whole.blocks[b].lost);
    }
  }
}

TEST(CsvRowParser, SurvivesAnyBytes) {
  std::mt19937_64 random(11);
  const std::string good = log_with_all_cases(60);
  for (int round = 0; round < 3000; ++round) {
    std::string text = good;
    for (std::uint64_t n = random() % 20; n > 0; --n)
      text[35 + random() % (text.size() - 35)] = static_cast<char>(random());
    const Parsed p = parse(text, {.bad_lines = 1000, .scans_per_block = 16}, CsvKind::probe_log,
                           1 + random() % 500);
    for (const SampleBlock& block : p.blocks)
      for (const auto& column : block.value) EXPECT_EQ(column.size(), block.scans());
  }
}

}  // namespace
}  // namespace mdof
