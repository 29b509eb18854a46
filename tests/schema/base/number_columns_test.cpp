#include "schema/base/number/number_columns.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "schema/base/csv/csv_stops.h"

namespace mdof {
namespace {

// Text of rows of two columns, the first of which is looked at, with other text around it.
class Rows {
 public:
  explicit Rows(const std::vector<std::string>& fields) : fields_(fields) {
    text_ = std::string(kColumnMargin, '9');
    for (const std::string& field : fields) text_ += field + ",7.5\n";
    size_ = text_.size() - kColumnMargin;
    text_ += std::string(kColumnMargin, '9');
    find_stops({text(), size_}, stops_);
  }
  ColumnText column() const { return {text(), stops_.at.get(), 2}; }
  std::size_t size() const { return fields_.size(); }
  const std::string& field(std::size_t j) const { return fields_[j]; }

 private:
  const char* text() const { return text_.data() + kColumnMargin; }
  std::vector<std::string> fields_;
  std::string text_;
  std::size_t size_ = 0;
  CsvStops stops_;
};

void expect_as_baseline(const Rows& rows) {
  std::vector<double> fast(rows.size()), slow(rows.size());
  const std::size_t n = read_doubles_baseline(rows.column(), rows.size(), slow.data());
  ASSERT_EQ(read_doubles(rows.column(), rows.size(), fast.data()), n);
  for (std::size_t j = 0; j < n; ++j)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(fast[j]), std::bit_cast<std::uint64_t>(slow[j]))
        << rows.field(j);
  std::vector<std::int64_t> fast_ns(rows.size()), slow_ns(rows.size());
  const std::size_t times = read_times_ns_baseline(rows.column(), rows.size(), slow_ns.data());
  ASSERT_EQ(read_times_ns(rows.column(), rows.size(), fast_ns.data()), times);
  for (std::size_t j = 0; j < times; ++j) ASSERT_EQ(fast_ns[j], slow_ns[j]) << rows.field(j);
}

void expect_as_from_chars(const Rows& rows) {
  std::vector<double> read(rows.size());
  ASSERT_EQ(read_doubles(rows.column(), rows.size(), read.data()), rows.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    double expected = 0;
    const std::string& field = rows.field(j);
    std::from_chars(field.data(), field.data() + field.size(), expected);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(read[j]), std::bit_cast<std::uint64_t>(expected))
        << field;
  }
}

class Random {
 public:
  std::uint64_t below(std::uint64_t n) { return engine_() % n; }
  std::string digits(std::uint64_t n) {
    std::string text;
    for (; n > 0; --n) text += static_cast<char>('0' + below(10));
    return text;
  }
  std::string number(std::uint64_t most_before, std::uint64_t most_behind) {
    const std::string sign = below(2) ? "-" : "", before = digits(1 + below(most_before));
    const std::uint64_t behind = below(most_behind + 1);
    return sign + before + (behind > 0 || below(8) == 0 ? "." : "") + digits(behind);
  }

 private:
  std::mt19937_64 engine_{20261121};
};

std::vector<std::string> many(std::size_t n, const auto& make) {
  std::vector<std::string> fields;
  while (fields.size() < n) fields.push_back(make());
  return fields;
}

TEST(NumberColumns, ReadsShortNumbersAsFromChars) {
  Random random;
  expect_as_from_chars(Rows(many(40'003, [&] { return random.number(5, 8); })));
}

TEST(NumberColumns, ReadsLongNumbersAsFromChars) {
  Random random;
  expect_as_from_chars(Rows(many(40'003, [&] { return random.number(8, 22); })));
}

TEST(NumberColumns, MixesShortAndLong) {
  Random random;
  const auto make = [&] { return random.below(20) ? random.number(3, 6) : random.number(9, 17); };
  expect_as_from_chars(Rows(many(40'003, make)));
}

// Halves between two doubles, and their neighbours in the last digit: 2^53 + 1, times powers of two
// and five, so that the decimal text ends exactly on the half.
TEST(NumberColumns, RoundsHalvesToEven) {
  std::vector<std::string> fields;
  for (const std::uint64_t half :
       {9007199254740993u, 9007199254740995u, 9007199254740997u, 18014398509481985u / 2 * 2 + 1}) {
    for (const int add : {-1, 0, 1}) {
      fields.push_back(std::to_string(half + static_cast<std::uint64_t>(add)));
      fields.push_back("-" + std::to_string(half) + (add < 0 ? ".0" : add == 0 ? ".00" : ".01"));
    }
  }
  for (const char* text : {"4503599627370496.5", "4503599627370497.5", "4503599627370498.50",
                           "2251799813685248.25", "2251799813685248.75", "1125899906842624.125",
                           "1125899906842624.3750", "562949953421312.0625", "0.5", "0.50000000"})
    fields.push_back(text);
  while (fields.size() % 8 != 0) fields.push_back("1.25");
  expect_as_from_chars(Rows(fields));
}

TEST(NumberColumns, TakesTheEdges) {
  expect_as_from_chars(Rows({"0",
                             "-0",
                             "0.0",
                             "-0.000",
                             "9999999999999999999",
                             "-0.0000000000000000001",
                             "7.",
                             "5",
                             "999999999999999",
                             "0.999999999999999",
                             "00000000000000000000000000012",
                             "-1.",
                             "1e3",
                             "1234567890123456789",
                             "12345678901234567890",
                             "0.1234567890123456789012",
                             "0.12345678901234567890123",
                             "100000000000000000000000000",
                             "-123456789012.5",
                             "42",
                             "-2.5e-3",
                             "123456789012345678.9",
                             "3.14159265358979312",
                             "1"}));
}

// One odd field in any place of a group must not hide, nor spoil its neighbours.
TEST(NumberColumns, StopsBeforeWhatIsNoNumber) {
  for (const char* odd :
       {"",      "-",        ".",     "-.",   "--1",
        "1-",    "1-2",      "1.2.3", "1/2",  "0x10",
        "1e",    "nan",      "inf",   "1:2",  "12345678901234567890123456789012345",
        "1e999", "\xc2\xb5", "1_000", "1.5;", "-.-",
        "/",     "1.-2"}) {
    for (std::size_t at = 0; at < 24; ++at) {
      std::vector<std::string> fields(24, at % 2 ? "-12.0625" : "1.23456789012345678");
      fields[at] = odd;
      const Rows rows(fields);
      expect_as_baseline(rows);
      std::vector<double> read(24);
      if (std::string(odd).starts_with("1234567890")) continue;  // a number, if a long one
      EXPECT_EQ(read_doubles(rows.column(), 24, read.data()), at) << odd;
    }
  }
}

TEST(NumberColumns, ReadsTimesToTheNanosecond) {
  Random random;
  expect_as_baseline(Rows(many(20'003, [&] { return random.number(9, 9); })));
  const Rows rows({"0.000250", "1.000000001", "-3.5", "9199999998.999999999", "0", "12.", "7.25",
                   "1e-3", "0.1234567894", "0.1234567895", "99.5", "4", "5", "6", "7", "8"});
  std::vector<std::int64_t> ns(rows.size());
  ASSERT_EQ(read_times_ns(rows.column(), rows.size(), ns.data()), rows.size());
  EXPECT_EQ(
      ns, (std::vector<std::int64_t>{
              250'000, 1'000'000'001, -3'500'000'000, 9'199'999'998'999'999'999, 0, 12'000'000'000,
              7'250'000'000, 1'000'000, 123'456'789, 123'456'790, 99'500'000'000, 4'000'000'000,
              5'000'000'000, 6'000'000'000, 7'000'000'000, 8'000'000'000}));
}

TEST(NumberColumns, FindsAllStops) {
  Random random;
  for (int length = 0; length < 400; ++length) {
    std::string text;
    while (text.size() < static_cast<std::size_t>(length))
      text += "0123456789.-,,,,\n\r #\xff+\""[random.below(23)];
    std::vector<std::uint32_t> expected;
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (static_cast<signed char>(text[i]) >= '-') continue;
      expected.push_back(static_cast<std::uint32_t>(i));
      bytes += text[i];
    }
    const std::string padded = text + std::string(kStopsMargin, ',');
    CsvStops stops;
    find_stops({padded.data(), text.size()}, stops);
    ASSERT_EQ(stops.count, expected.size() + 1);
    EXPECT_EQ(std::vector(stops.at.get() + 1, stops.at.get() + stops.count), expected);
    EXPECT_EQ(std::string(stops.byte.get() + 1, stops.byte.get() + stops.count), bytes);
  }
}

}  // namespace
}  // namespace mdof
