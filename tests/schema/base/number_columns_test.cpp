#include "schema/base/number/number_columns.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "schema/base/csv/csv_stops.h"

namespace mdof {
namespace {

// Rows with two columns, and other text before and after the rows. The tests read the first column.
class Rows {
 public:
  explicit Rows(const std::vector<std::string>& fields, const std::string& line_end = "\n")
      : fields_(fields), stops_of_row_(1 + line_end.size()) {
    text_ = std::string(kColumnMargin, '9');
    for (const std::string& field : fields) text_ += field + ",7.5" + line_end;
    size_ = text_.size() - kColumnMargin;
    text_ += std::string(kColumnMargin, '9');
    find_stops({text(), size_}, stops_);
  }
  ColumnText column(std::size_t from = 0) const {
    return {text(), stops_.at.get() + from * stops_of_row_, stops_of_row_};
  }
  std::size_t size() const { return fields_.size(); }
  const std::string& field(std::size_t j) const { return fields_[j]; }

 private:
  const char* text() const { return text_.data() + kColumnMargin; }
  std::vector<std::string> fields_;
  std::size_t stops_of_row_;
  std::string text_;
  std::size_t size_ = 0;
  CsvStops stops_;
};

std::vector<double> read_all(const Rows& rows, InstructionSet set) {
  std::vector<double> read(rows.size());
  read.resize(read_doubles(rows.column(), rows.size(), read.data(), set));
  return read;
}
std::vector<std::int64_t> read_all_ns(const Rows& rows, InstructionSet set) {
  std::vector<std::int64_t> read(rows.size());
  read.resize(read_times_ns(rows.column(), rows.size(), read.data(), set));
  return read;
}

void expect_like_baseline(const Rows& rows) {
  const auto doubles = read_all(rows, InstructionSet::baseline);
  const auto times_ns = read_all_ns(rows, InstructionSet::baseline);
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(to_string(set));
    const auto read = read_all(rows, set);
    ASSERT_EQ(read.size(), doubles.size());
    for (std::size_t j = 0; j < read.size(); ++j)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(read[j]), std::bit_cast<std::uint64_t>(doubles[j]))
          << rows.field(j);
    const auto read_ns = read_all_ns(rows, set);
    ASSERT_EQ(read_ns.size(), times_ns.size());
    for (std::size_t j = 0; j < read_ns.size(); ++j)
      ASSERT_EQ(read_ns[j], times_ns[j]) << rows.field(j);
  }
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The value that std::from_chars reads from the whole field; NaN if the field is not a finite
// number.
double from_chars(const std::string& field) {
  double x = kNaN;
  const char* const end = field.data() + field.size();
  const auto [after, error] = std::from_chars(field.data(), end, x);
  if (after != end) return kNaN;
  if (error == std::errc::result_out_of_range) x = std::strtod(field.c_str(), nullptr);
  return error == std::errc::invalid_argument || !std::isfinite(x) ? kNaN : x;
}

// Reads all fields. After each field that is not a number, it continues with the next.
void expect_as_from_chars(const Rows& rows) {
  std::vector<double> expected;
  for (std::size_t j = 0; j < rows.size(); ++j) expected.push_back(from_chars(rows.field(j)));
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(to_string(set));
    std::vector<double> read(rows.size());
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const ColumnText rest = rows.column(j);
      const std::size_t end = j + read_doubles(rest, rows.size() - j, read.data() + j, set);
      for (; j < end; ++j)
        ASSERT_EQ(std::bit_cast<std::uint64_t>(read[j]), std::bit_cast<std::uint64_t>(expected[j]))
            << rows.field(j);
      if (j < rows.size()) {
        ASSERT_TRUE(std::isnan(expected[j])) << rows.field(j);
      }
    }
  }
}

class RandomFields {
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

TEST(NumberColumns, ReadsShortNumbersLikeFromChars) {
  RandomFields random;
  expect_as_from_chars(Rows(many(40'003, [&] { return random.number(5, 8); })));
}

TEST(NumberColumns, ReadsLongNumbersLikeFromChars) {
  RandomFields random;
  expect_as_from_chars(Rows(many(40'003, [&] { return random.number(8, 22); })));
}

TEST(NumberColumns, ReadsMixedShortAndLongNumbers) {
  RandomFields random;
  const auto make = [&] { return random.below(20) ? random.number(3, 6) : random.number(9, 17); };
  expect_as_from_chars(Rows(many(40'003, make)));
}

// Numbers that are exactly halfway between two doubles, and numbers that differ from them in the
// last digit. They are 2^53 + 1 and similar numbers, divided by powers of two, so that their
// decimal text is exact.
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

// A field as in usual files, or as an attacker would write it. It contains no byte that ends a
// field.
std::string adversarial_field(RandomFields& random) {
  switch (random.below(16)) {
    case 0:
      return random.number(1, 17) + "e-" +
             random.digits(1 + random.below(3));  // the smallest numbers are denormal or 0
    case 1:
      // The largest numbers are infinite.
      return random.number(18, 3) + "E" + random.digits(1 + random.below(3));
    case 2:
      return std::string(random.below(28), '0') + random.digits(random.below(20));
    case 3:
      return "-0." + std::string(random.below(24), '0') + random.digits(random.below(20));
    case 4:
      return random.digits(random.below(40));
    case 5:
      return std::array{
          "nan", "-inf", "inf", "NaN", "", "-", ".", "-.", "--1", "1e"}[random.below(10)];
    case 6: {  // changes one byte of a valid number
      std::string text = random.number(4, 14);
      text[random.below(text.size())] = "./-0:e9;_\x7f"[random.below(10)];
      return text;
    }
    case 7:
      return random.number(2, 20) + std::array{"", ".", "-", "."}[random.below(4)];
    default:
      return random.below(2) ? random.number(3, 6) : random.number(2, 17);
  }
}

TEST(NumberColumns, ReadsAMillionHostileCellsLikeFromChars) {
  RandomFields random;
  for (int round = 0; round < 100; ++round) {
    const auto cell = [&] {
      return random.below(24) > static_cast<std::uint64_t>(round % 25) ? random.number(3, 6)
                                                                       : adversarial_field(random);
    };
    expect_as_from_chars(Rows(many(10'007, cell), round % 2 ? "\n" : "\r\n"));
    if (HasFatalFailure()) return;
  }
}

// The shortest texts of random doubles: all exponents, denormal numbers, 1 to 17 digits.
TEST(NumberColumns, ReadsTextsOfRandomDoubles) {
  RandomFields random;
  const auto cell = [&] {
    const auto x = std::bit_cast<double>(random.below(~std::uint64_t{0}));
    std::array<char, 400> text{};
    const auto format = std::abs(x) < 1e18 && std::abs(x) > 1e-12 ? std::chars_format::fixed
                                                                  : std::chars_format::scientific;
    std::string shortest(text.data(), std::to_chars(text.data(), text.data() + 400, x, format).ptr);
    std::erase(shortest, '+');
    return shortest;
  };
  expect_as_from_chars(Rows(many(200'003, cell)));
}

TEST(NumberColumns, ReadsEdgeCases) {
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

// Texts that are shorter or longer than the part that is read in one step.
TEST(NumberColumns, AcceptsAPointBeforeAllDigits) {
  for (std::size_t size = 2; size < 40; ++size) {
    const std::string digits(size - 1, '0');
    expect_as_from_chars(Rows(std::vector<std::string>(24, "." + digits.substr(1) + "7")));
    expect_as_from_chars(Rows(std::vector<std::string>(24, "-." + digits.substr(1) + "7")));
  }
}

// One field is not a number. The reader must stop before this field wherever it is in a group of
// fields, and must read the fields before it correctly.
TEST(NumberColumns, StopsBeforeAFieldThatIsNoNumber) {
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
      expect_like_baseline(rows);
      // This field is a number, although a long one.
      if (std::string(odd).starts_with("1234567890")) continue;
      EXPECT_EQ(read_all(rows, InstructionSet::baseline).size(), at) << odd;
    }
  }
}

TEST(NumberColumns, ReadsTimesToTheNanosecond) {
  RandomFields random;
  expect_like_baseline(Rows(many(20'003, [&] { return random.number(9, 9); })));
  const Rows rows({"0.000250", "1.000000001", "-3.5", "9199999998.999999999", "0", "12.", "7.25",
                   "1e-3", "0.1234567894", "0.1234567895", "99.5", "4", "5", "6", "7", "8"});
  expect_like_baseline(rows);
  EXPECT_EQ(read_all_ns(rows, best_instruction_set()),
            (std::vector<std::int64_t>{
                250'000, 1'000'000'001, -3'500'000'000, 9'199'999'998'999'999'999, 0,
                12'000'000'000, 7'250'000'000, 1'000'000, 123'456'789, 123'456'790, 99'500'000'000,
                4'000'000'000, 5'000'000'000, 6'000'000'000, 7'000'000'000, 8'000'000'000}));
}

TEST(NumberColumns, FindsEveryByteThatEndsAField) {
  RandomFields random;
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
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(to_string(set));
      CsvStops stops;
      find_stops({padded.data(), text.size()}, stops, set);
      ASSERT_EQ(stops.count, expected.size() + 1);
      EXPECT_EQ(std::vector(stops.at.get() + 1, stops.at.get() + stops.count), expected);
      EXPECT_EQ(std::string(stops.byte.get() + 1, stops.byte.get() + stops.count), bytes);
    }
  }
}

}  // namespace
}  // namespace mdof
