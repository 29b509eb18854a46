#include "drivers/csv_stream/protocol.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::drivers {
namespace {

struct Fed {
  std::vector<CsvStreamRow> rows;
  std::string error;
};

Fed feed(CsvStreamProtocol& protocol, const std::string& text, std::size_t piece = 1) {
  Fed fed;
  for (std::size_t at = 0; at < text.size(); at += piece)
    if (auto status = protocol.give(text.substr(at, piece), fed.rows); !status) {
      fed.error = status.error().message;
      break;
    }
  return fed;
}

const std::string kText =
    "# simulated: no\r\n\r\ntime_s,encoder_mm,A_um,B_V\r\n0.001,1.5,2.25,-0.5\r\n"
    "0.002,1.75,,nan\r\n";

TEST(CsvStreamProtocol, PiecesDoNotChangeTheRows) {
  for (const std::size_t piece : {1u, 2u, 7u, 1000u}) {
    CsvStreamProtocol protocol("probe", 0);
    const Fed fed = feed(protocol, kText, piece);
    ASSERT_EQ(fed.error, "");
    ASSERT_TRUE(protocol.header());
    EXPECT_EQ(protocol.header()->channels,
              (std::vector<Channel>{{"encoder", Unit::mm}, {"A", Unit::um}, {"B", Unit::volt}}));
    EXPECT_EQ(protocol.header()->comments, std::vector<std::string>{"simulated: no"});
    ASSERT_EQ(fed.rows.size(), 2u);
    EXPECT_EQ(fed.rows[0].time_ns, 1'000'000);
    EXPECT_EQ(fed.rows[0].values, (std::vector<double>{1.5, 2.25, -0.5}));
    EXPECT_TRUE(std::isnan(fed.rows[1].values[1]) && std::isnan(fed.rows[1].values[2]));
  }
}

TEST(CsvStreamProtocol, TimeAndEncoderAreOptional) {
  CsvStreamProtocol protocol("probe", 0);
  const Fed fed = feed(protocol, "A_um\n1\n2\n");
  ASSERT_EQ(fed.error, "");
  EXPECT_EQ(protocol.header()->time_column, -1);
  ASSERT_EQ(fed.rows.size(), 2u);
  EXPECT_EQ(fed.rows[1].values, std::vector<double>{2});
}

TEST(CsvStreamProtocol, CountsAndReportsSkippedBadLines) {
  CsvStreamProtocol protocol("probe", 3);
  const Fed fed = feed(protocol, "A_um,B_um\n1,2\n1\n1,x\n3,4\n\n# a word\n5,6\n");
  ASSERT_EQ(fed.error, "");
  ASSERT_EQ(fed.rows.size(), 3u);
  EXPECT_EQ(fed.rows[0].lost, 0u);
  EXPECT_EQ(fed.rows[1].lost, 2u);
  EXPECT_EQ(fed.rows[2].lost, 1u);
  EXPECT_EQ(protocol.bad_lines(), 3u);
  EXPECT_EQ(protocol.bad_line_reasons(),
            (std::vector<std::string>{"probe:3: 1 fields in the line, but the header has 2 columns",
                                      "probe:4: column B_um: \"x\" is not a number",
                                      "probe:6: empty line"}));
}

TEST(CsvStreamProtocol, OneBadLineTooManyIsAnErrorAfterEarlierRows) {
  CsvStreamProtocol protocol("probe", 1);
  const Fed fed = feed(protocol, "A_um,B_um\nx\n1,2\ny\n3,4\n", 1000);
  ASSERT_EQ(fed.rows.size(), 1u);
  EXPECT_NE(fed.error.find("more than 1 of 10000 lines are bad"), fed.error.npos) << fed.error;
  EXPECT_NE(fed.error.find("probe:2: 1 fields"), fed.error.npos) << fed.error;
}

TEST(CsvStreamProtocol, RareBadLinesAreNoError) {
  CsvStreamProtocol protocol("probe", 1);
  ASSERT_EQ(feed(protocol, "A_um,B_um\n", 1000).error, "");
  std::string good;
  for (int i = 0; i < 9'999; ++i) good += "1,2\n";
  for (int day = 0; day < 4; ++day)
    ASSERT_EQ(feed(protocol, "what\n" + good, 100'000).error, "") << day;
  EXPECT_EQ(protocol.bad_lines(), 4u);
}

TEST(CsvStreamProtocol, ReportsAMissingHeader) {
  CsvStreamProtocol protocol("probe", 3);
  const Fed fed = feed(protocol, "0.1,2,3\n0.2,3,4\n");
  EXPECT_NE(fed.error.find("the line has numbers instead of the header"), fed.error.npos)
      << fed.error;
}

TEST(CsvStreamProtocol, TimeMustIncreaseUntilTheHeaderIsRepeated) {
  CsvStreamProtocol protocol("probe", 3);
  const Fed fed = feed(protocol, "time_s,A_um\n5,1\n6,2\ntime_s,A_um\n0.5,3\n0.5,4\n");
  ASSERT_EQ(fed.rows.size(), 3u);
  EXPECT_FALSE(fed.rows[1].restarted);
  EXPECT_TRUE(fed.rows[2].restarted);
  EXPECT_NE(fed.error.find("the time must increase"), fed.error.npos) << fed.error;
}

TEST(CsvStreamProtocol, LimitsTheLengthOfALine) {
  CsvStreamProtocol protocol("probe", 3);
  EXPECT_NE(feed(protocol, std::string(70'000, 'x'), 4096).error.find("newline"),
            std::string::npos);
  CsvStreamProtocol comments("probe", 3);
  std::string text;
  for (int i = 0; i < 10'000; ++i) text += "# comment\n";
  EXPECT_NE(feed(comments, text, 4096).error.find("no header line"), std::string::npos);
}

TEST(CsvStreamProtocol, ImpossibleTimesAreBadLines) {
  CsvStreamProtocol protocol("probe", 3);
  const Fed fed = feed(protocol, "time_s,A_um\n9e9,1\n-9e9,1\n1,2\n");
  ASSERT_EQ(fed.rows.size(), 1u);
  EXPECT_EQ(fed.rows[0].lost, 2u);
}

}  // namespace
}  // namespace mdof::drivers
