#include "schema/recording/probe_log.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace mdof {
namespace {

Result<CsvHeader> log_header(std::string_view text) {
  return parse_csv_header(text, CsvKind::probe_log, "x.csv");
}

std::string error_of(std::string_view text, CsvKind kind = CsvKind::probe_log) {
  const Result<CsvHeader> header = parse_csv_header(text, kind, "x.csv");
  if (header) return "no error";
  EXPECT_EQ(header.error().code, ErrorCode::bad_input);
  EXPECT_TRUE(header.error().message.starts_with("x.csv:")) << header.error().message;
  return header.error().message;
}

void expect_error(std::string_view text, const std::vector<std::string>& words) {
  const std::string message = error_of(text);
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), message.npos) << message << "\nlacks: " << word;
}

TEST(ProbeLogHeader, ReadsCommentsChannelsAndUnits) {
  const auto header =
      log_header("# probe log 1\n#axis: X\r\ntime_s,encoder_mm,A_um,B_V\r\n1,2,3,4\n");
  ASSERT_TRUE(header) << header.error().message;
  EXPECT_EQ(header->comments, (std::vector<std::string>{"probe log 1", "axis: X"}));
  EXPECT_EQ(header->time_column, 0);
  EXPECT_EQ(header->channels,
            (std::vector<Channel>{{"encoder", Unit::mm}, {"A", Unit::um}, {"B", Unit::volt}}));
  EXPECT_EQ(header->lines, 3u);
  EXPECT_EQ(header->bytes, 52u);
}

TEST(ProbeLogHeader, AcceptsColumnsInAnyOrderAndKeepsOthers) {
  const auto header = log_header("E_um,temperature_C,time_s,humidity_percent,note,encoder_mm\n");
  ASSERT_TRUE(header) << header.error().message;
  EXPECT_EQ(header->time_column, 2);
  EXPECT_EQ(header->channel_columns, (std::vector<std::size_t>{0, 1, 3, 4, 5}));
  EXPECT_EQ(header->channels, (std::vector<Channel>{{"E", Unit::um},
                                                    {"temperature", Unit::deg_c},
                                                    {"humidity_percent", Unit::other},
                                                    {"note", Unit::other},
                                                    {"encoder", Unit::mm}}));
}

TEST(ProbeLogHeader, SkipsAByteOrderMark) {
  EXPECT_TRUE(log_header("\xef\xbb\xbftime_s,encoder_mm,A_um\n"));
  EXPECT_TRUE(log_header("\xef\xbb\xbf# comment\ntime_s,encoder_mm,A_um"));
}

TEST(ProbeLogHeader, NeedsNoTimeInAFramesFile) {
  const auto header = parse_csv_header("encoder_mm,A_um\n", CsvKind::frames, "x.csv");
  ASSERT_TRUE(header);
  EXPECT_EQ(header->time_column, -1);
  EXPECT_TRUE(parse_csv_header("time_s,encoder_mm,A_um\n", CsvKind::frames, "x.csv"));
}

TEST(ProbeLogHeader, TableHasAnyColumnsAndNoTime) {
  const auto header = parse_csv_header("time_s,run,deviation_um\n", CsvKind::table, "x.csv");
  ASSERT_TRUE(header);
  EXPECT_EQ(header->time_column, -1);
  EXPECT_EQ(header->channels[2].id, "deviation");
  EXPECT_TRUE(header->may_be_missing(2));
  EXPECT_NE(error_of("1,2\n", CsvKind::table).find("position_mm,deviation_um\" before this line"),
            std::string::npos);
}

TEST(ProbeLogHeader, ReportsMissingColumns) {
  expect_error("", {"empty"});
  expect_error("# only\n# comments\n", {"no header"});
  expect_error("\n\n", {"no header"});
  expect_error("encoder_mm,A_um\n", {":1:", "time_s", "encoder_mm, A_um"});
  expect_error("# c\ntime_s,A_um\n", {":2:", "encoder_mm"});
  expect_error("time_s,encoder_mm\n", {"probe"});
  expect_error("0.0,1.0,2.0\n0.1,1.0,2.0\n", {"header", "numbers"});
}

TEST(ProbeLogHeader, ReportsTheWrongColumn) {
  expect_error("time_s,encoder_mm,A_um,B_um,A_um\n", {"column 5", "A_um", "twice"});
  expect_error("time_s,encoder_mm,A_um,A_V\n", {"column 4", "A_V", "twice", "A_um"});
  expect_error("time_s,time_s,encoder_mm,A_um\n", {"column 2", "twice"});
  expect_error("time_s,encoder_mm,A_nm\n", {"column 3", "A_nm", "_um, _mm, _V and _C"});
  expect_error("time_s,encoder_mm,A_um,,B_um\n", {"column 4", "name"});
  expect_error("time_s,encoder_mm,_um\n", {"column 3"});
}

TEST(ProbeLogHeader, AcceptsThePositionInAnyNamedUnitOfLength) {
  for (const auto& [name, unit] :
       {std::pair{"encoder_um", Unit::um},
        {"encoder_mm", Unit::mm},
        {"encoder_m", Unit::metre},
        // Volts are accepted here; the rig decides whether it has a scale.
        {"encoder_V", Unit::volt}}) {
    const auto header = log_header("time_s," + std::string(name) + ",A_um\n");
    ASSERT_TRUE(header) << header.error().message;
    EXPECT_EQ(header->channels[0], (Channel{"encoder", unit})) << name;
  }
}

TEST(ProbeLogHeader, RejectsTimeAndPositionInOtherUnits) {
  for (const char* name : {"encoder", "encoder_mV", "encoder_nm", "encoder_counts", "encoder_C",
                           "encoder_urad", "encoder_s", "encoder_in"})
    expect_error("time_s," + std::string(name) + ",A_um\n",
                 {"column 2 \"" + std::string(name) + "\"", "encoder_mm"});
  for (const char* name : {"time", "time_ms", "time_us", "time_ns", "time_min", "time_hz"})
    expect_error(std::string(name) + ",encoder_mm,A_um\n",
                 {"column 1 \"" + std::string(name) + "\"", "time_s", "seconds"});
  expect_error("time_s,encoder_mm,A_m\n", {"column 3", "A_m", "to um"});
  // The meaning of both columns is obvious, but their names are not the required names.
  expect_error("t_s,encoder_mm,A_um\n", {"time_s", "t_s"});
  EXPECT_TRUE(log_header("time_s,encoder_mm,A_um,timer,encoders\n"));
}

TEST(ProbeLogHeader, RecognisesOtherSpreadsheetFormats) {
  for (const char separator : {',', ';', '\t'}) {
    const std::string names =
        std::string("time_s") + separator + "encoder_mm" + separator + "A_um\n";
    const auto log = parse_csv_header(names, CsvKind::probe_log, "x.csv");
    ASSERT_TRUE(log) << log.error().message;
    EXPECT_EQ(log->separator, separator);
    EXPECT_EQ(log->channels.size(), 2U);
    const auto stream = parse_csv_header(names, CsvKind::stream, "x.csv");
    EXPECT_EQ(stream.has_value(), separator == ',');
  }
  const auto stream = parse_csv_header("time_s;encoder_mm;A_um\n", CsvKind::stream, "x.csv");
  EXPECT_NE(stream.error().message.find("semicolons"), std::string::npos);
  expect_error("\xff\xfet\0i\0", {"UTF-16"});
}

}  // namespace
}  // namespace mdof
