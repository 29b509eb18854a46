// Reads the columns of a measured series from a CSV file. An error message contains the line
// number.
#include "drivers/csv/csv_table.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "drivers/csv/positioning_csv.h"

namespace mdof::drivers {
namespace {

const std::vector<std::string> kSeries = {"position_mm", "deviation_um"};

class CsvTableTest : public testing::Test {
 protected:
  CsvTableTest()
      : path_(std::filesystem::temp_directory_path() /
              ("mdof_csv_table_test." + std::to_string(::getpid()))) {}
  ~CsvTableTest() override { std::filesystem::remove(path_); }

  Result<CsvTable> read(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    return read_csv_table(path_.string(), kSeries);
  }
  void expect_error(const std::string& text, const std::vector<std::string>& words) const {
    const auto table = read(text);
    ASSERT_FALSE(table) << text;
    for (const auto& word : words)
      EXPECT_NE(table.error().message.find(word), std::string::npos) << table.error().message;
  }
  std::filesystem::path path_;
};

TEST_F(CsvTableTest, ReadsItsColumnsInAnyOrder) {
  const auto table = read(
                         "# simulated: yes\r\ntime_s,deviation_um,note_C,position_mm\r\n"
                         "9,1.5,,10\r\n8,-2,20,+5.25\r\n\r\n")
                         .value();
  EXPECT_EQ(table.columns[0], (std::vector<double>{10, 5.25}));
  EXPECT_EQ(table.columns[1], (std::vector<double>{1.5, -2}));
  EXPECT_TRUE(table.simulated);
  EXPECT_FALSE(read("position_mm,deviation_um\n1,2\n")->simulated);
}

TEST_F(CsvTableTest, ReadsOptionalColumnsIfTheyExist) {
  const auto with = [&](const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_csv_table(path_.string(), kSeries, {"u_um", "v_um"});
  };
  const auto second = with("v_um,position_mm,deviation_um\n7,1,2\n").value();
  EXPECT_EQ(second.columns, (std::vector<std::vector<double>>{{1}, {2}, {}, {7}}));
  const auto first = with("u_um,position_mm,deviation_um\n7,1,2\n").value();
  EXPECT_EQ(first.columns, (std::vector<std::vector<double>>{{1}, {2}, {7}, {}}));
  const auto none = with("position_mm,deviation_um\n1,2\n").value();
  EXPECT_EQ(none.columns, (std::vector<std::vector<double>>{{1}, {2}, {}, {}}));
  const auto unit = with("position_mm,deviation_um,u_mm\n1,2,3\n");
  ASSERT_FALSE(unit);
  EXPECT_NE(unit.error().message.find("rename the column to u_um"), std::string::npos)
      << unit.error().message;
  // If no row has a value in a column, the column does not exist. If only some rows have a value,
  // a row without a value is invalid.
  const auto empty = with("position_mm,u_um,deviation_um\n1,,2\n3,nan,4\n").value();
  EXPECT_EQ(empty.columns, (std::vector<std::vector<double>>{{1, 3}, {2, 4}, {}, {}}));
  const auto partly = with("position_mm,deviation_um,u_um\n1,2,3\n4,5,\n");
  ASSERT_FALSE(partly);
  EXPECT_NE(partly.error().message.find(":3: column u_um: no value"), std::string::npos)
      << partly.error().message;
}

TEST_F(CsvTableTest, RefusesMisspeltOptionalColumns) {
  const auto with = [&](const std::string& column) {
    std::ofstream(path_, std::ios::binary) << "position_mm,deviation_um," + column + "\n1,2,-1\n";
    return read_csv_table(path_.string(), kSeries,
                          {"direction", "run", "u_um", "u_EYX_um", "reverse_EXX_um"});
  };
  const std::vector<std::pair<std::string, std::string>> meant = {
      {"Direction", "direction"},
      {"RUN", "run"},
      {"runs", "run"},
      {"dirction", "direction"},
      {"directoin", "direction"},
      {"U_um", "u_um"},
      {"u_eyx_um", "u_EYX_um"},
      {"revers_EXX_um", "reverse_EXX_um"},
      {"reverseEXX_um", "reverse_EXX_um"}};
  for (const auto& [column, name] : meant) {
    const auto table = with(column);
    ASSERT_FALSE(table) << column;
    EXPECT_NE(table.error().message.find(":1: column " + column), std::string::npos)
        << table.error().message;
    EXPECT_NE(table.error().message.find("rename the column to " + name), std::string::npos)
        << table.error().message;
  }
  for (const char* other :
       {"rung", "point", "u_EZX_um", "time_s", "reverse_EYX_um", "reverse_EX0X_um"})
    EXPECT_TRUE(with(other)) << other;
  std::ofstream(path_, std::ios::binary) << "position_mm,deviation_um,U_um,u_um\n1,2,6,3\n";
  EXPECT_EQ(read_csv_table(path_.string(), kSeries, {"u_um"})->columns[2], std::vector<double>{3});
}

TEST_F(CsvTableTest, SkipsTextColumnsAndReadsTheSense) {
  const auto with = [&](const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_csv_table(path_.string(), kSeries, {"positioning_sense"});
  };
  const auto words = with(
      "u_covers,position_mm,positioning_sense,deviation_um,not_declared\n"
      "\"a, \"\"b\"\", c\",1,command,2,\n"
      "none,3,body,4,\"u_x, u_y\"\n");
  ASSERT_TRUE(words) << words.error().message;
  EXPECT_EQ(words->columns, (std::vector<std::vector<double>>{{1, 3}, {2, 4}, {1, 0}}));
  const auto other = with("position_mm,positioning_sense,deviation_um\n1,command,2\n3,machine,4\n");
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find(":3: column positioning_sense: \"machine\""),
            std::string::npos)
      << other.error().message;
}

TEST_F(CsvTableTest, ReadsMoreThanABlock) {
  std::string text = "position_mm,deviation_um\n";
  for (int i = 0; i < 20000; ++i) text += std::to_string(i) + "," + std::to_string(-i) + "\n";
  const auto table = read(text).value();
  ASSERT_EQ(table.rows(), 20000u);
  EXPECT_EQ(table.columns[1][19999], -19999);
  expect_error(text + "1,nan\n", {":20002: column deviation_um: no value", "add the value"});
}

TEST_F(CsvTableTest, ErrorsNameLineAndRemedy) {
  const std::string head = "# a\nposition_mm,deviation_um\n1,2\n";
  expect_error(head + "2,\n", {":4: column deviation_um: no value", "delete the line"});
  expect_error(head + "nan,3\n", {":4: column position_mm: no value"});
  expect_error(head + "2,inf\n", {":4: column deviation_um", "not a finite number"});
  expect_error(head + "2,abc\n", {":4: column deviation_um: \"abc\" is not a number"});
  expect_error(head + "2\n", {":4: 1 fields in the line, but the header has 2"});
  expect_error(head + "\n3,4\n", {":4: empty line"});
  expect_error("position_mm;deviation_um\n1,5;2.5\n", {"contain commas and points"});
  expect_error("1,2\n3,4\n", {":1: the line has numbers", "position_mm,deviation_um"});
  expect_error("position_mm,deviation_um\n", {"no rows"});
  expect_error("", {"empty"});
}

TEST_F(CsvTableTest, ErrorsNameTheExpectedColumnOrUnit) {
  expect_error("position_um,deviation_um\n1,2\n",
               {":1: column position_um does not have the expected unit",
                "rename the column to position_mm"});
  expect_error("x_mm,deviation_um\n1,2\n",
               {":1: no column position_mm (columns: x_mm, deviation_um)"});
  expect_error("position_inch,deviation_um\n1,2\n", {":1:", "position_inch", "unknown unit"});
  expect_error("position_mm,deviation_um,deviation_um\n1,2,3\n", {"given twice"});
}

TEST_F(CsvTableTest, LimitsRowsAndReadings) {
  const std::string head = "target_mm,direction,run,deviation_um\n", rows = "1,1,1,1\n2,1,1,1\n";
  const auto with = [&](const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_positioning_csv(path_.string(), 2);
  };
  EXPECT_EQ(with(head + rows)->readings.size(), 2u);
  const auto refused = with(head + rows + "3,1,1,1\n");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("more than 2 rows"), std::string::npos);
  EXPECT_LE(kMostReadings, 1'000'000u) << "of some 120 bytes each";
}

TEST_F(CsvTableTest, MissingFileIsAnError) {
  EXPECT_FALSE(read_csv_table("/nonexistent/x.csv", kSeries));
}

}  // namespace
}  // namespace mdof::drivers
