#include "schema/base/number/number.h"

#include "schema/base/number/number_scan.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

namespace mdof {
namespace {

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

// The fast scanner may reject a text. If it accepts the text, it must use all of it and return the
// correct number. The bytes before and after the text must have no effect.
bool expect_scan_agrees(const std::string& text, bool is_number, double expected) {
  bool understood = false;
  for (const char around : {'7', '.', '-', ',', '\xff'}) {
    const std::string margin(kScanMargin, around);
    const std::string padded = margin + text + margin;
    const char* const p = padded.data() + kScanMargin;
    ScannedNumber number;
    understood = scan_number(p, p + text.size(), number);
    if (!understood) continue;
    EXPECT_TRUE(is_number) << text;
    EXPECT_EQ(bits(to_double(number)), bits(expected)) << text;
  }
  return understood;
}

void expect_as_from_chars(const std::string& text, bool must_scan = false) {
  double expected = 0, got = -1;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const auto [after, error] = std::from_chars(begin, end, expected);
  ASSERT_EQ(parse_double(begin, end, got), after) << text;
  // For such a text std::from_chars leaves the value unchanged; parse_double returns ±inf or ±0.
  if (error == std::errc::result_out_of_range) {
    ASSERT_TRUE(std::isinf(got) || got == 0) << text;
    return;
  }
  ASSERT_EQ(bits(got), bits(expected)) << text;
  if (after == end && std::isfinite(expected)) {
    ASSERT_EQ(bits(expected), bits(std::strtod(text.c_str(), nullptr))) << text;
  }
  const bool understood = expect_scan_agrees(text, after == end, expected);
  ASSERT_TRUE(understood || !must_scan) << text;
}

void expect_like_printf(double x) {
  char expected[64], got[kDouble17Size + 1];
  std::snprintf(expected, sizeof expected, "%.17g", x);
  *write_double_17(got, x) = 0;
  ASSERT_STREQ(got, expected);
}

// The text of a number must not depend on the other numbers of the array.
void expect_single_number_texts(const std::vector<double>& x) {
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(to_string(set));
    std::vector<DoubleText> got(x.size());
    write_doubles_17(x.data(), x.size(), got.data(), set);
    for (std::size_t i = 0; i < x.size(); ++i) {
      char expected[kDouble17Size + 1];
      *write_double_17(expected, x[i]) = 0;
      ASSERT_EQ(std::string(got[i].text, static_cast<std::size_t>(got[i].size)), expected);
    }
  }
}

class Random {
 public:
  std::uint64_t below(std::uint64_t n) { return engine_() % n; }
  double any_bits() { return std::bit_cast<double>(engine_()); }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  std::string digits(std::size_t n) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i) text += static_cast<char>('0' + below(10));
    return text;
  }
  std::string number(std::size_t whole, std::size_t fraction) {
    return (below(2) ? "-" : "") + digits(whole) + (fraction ? "." + digits(fraction) : "");
  }

 private:
  std::mt19937_64 engine_{20240229};
};

std::string printed(const char* format, double x) {
  char text[400];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

TEST(ParseDouble, MatchesFromCharsForNumbersOfAnyLength) {
  Random random;
  for (int i = 0; i < 1'000'000; ++i)
    expect_as_from_chars(random.number(1 + random.below(10), random.below(22)));
}

TEST(ParseDouble, MatchesFromCharsForRandomBits) {
  Random random;
  for (int i = 0; i < 500'000; ++i) {
    const double x = random.any_bits();
    if (std::isfinite(x)) expect_as_from_chars(printed("%.17g", x));
  }
}

TEST(ParseDouble, MatchesFromCharsForExponents) {
  Random random;
  for (int i = 0; i < 500'000; ++i)
    expect_as_from_chars(random.number(1 + random.below(3), random.below(25)) +
                         (random.below(2) ? "e" : "E") +
                         std::to_string(static_cast<int>(random.below(700)) - 350));
}

TEST(ParseDouble, RoundsHalfwayCasesToEven) {
  Random random;
  // Numbers exactly halfway between two doubles, and numbers slightly above or below halfway.
  for (int i = 0; i < 50'000; ++i) {
    const std::uint64_t odd =
        (std::uint64_t{1} << 53) + 2 * random.below(std::uint64_t{1} << 52) + 1;
    const std::string text = std::to_string(odd);
    for (const char* tail : {"", ".0", ".000000000000000000000000001", "e0"})
      expect_as_from_chars(text + tail);
    const double x = random.uniform(0, 60);
    const std::string half = printed("%.70f", x + 0x1p-60);
    for (std::size_t length = 10; length < 45; length += 3)
      expect_as_from_chars(half.substr(0, length));
  }
}

TEST(ParseDouble, ReadsSubnormalsAndLimits) {
  for (const char* text : {"0",
                           "-0",
                           "0.0",
                           "-0.000000",
                           "4.9e-324",
                           "2.4703282292062327e-324",
                           "1e-400",
                           "-1e-400",
                           "2.2250738585072011e-308",
                           "2.2250738585072014e-308",
                           "1.7976931348623157e308",
                           "1e309",
                           "-1e400",
                           "9007199254740993",
                           "9007199254740992.5",
                           "0.00000000000000000000000000000001",
                           "123456789012345678901234567890",
                           "12345678.12345678901",
                           "12345678.123456789012",
                           ".5",
                           "-.5",
                           "5.",
                           "1e5",
                           "1E+5",
                           "1e-5",
                           "0.1e1",
                           "00000001.5",
                           "000000001.5",
                           "inf",
                           "-inf",
                           "nan",
                           "1e",
                           "1e+",
                           "1.5e",
                           "1.5.5",
                           "1-",
                           "1.5-2"})
    expect_as_from_chars(text);
}

#ifdef __SSE2__
TEST(ScanNumber, ReadsNumbersOfLogs) {
  Random random;
  for (int i = 0; i < 500'000; ++i) {
    expect_as_from_chars(printed("%.6f", random.uniform(-100, 100)), true);
    expect_as_from_chars(printed("%.17g", random.uniform(1, 9'999'999)), true);
    expect_as_from_chars(printed("%.3f", random.uniform(-1e6, 1e6)), true);
    expect_as_from_chars(std::to_string(random.below(1'000'000'000)), true);
  }
}
#endif

TEST(ScanNumber, RejectsTextsThatAreNoNumber) {
  Random random;
  const std::string alphabet =
      "0123456789012345678901234567890123456789..--+eE ,;:/\n\x7f\x80\xb0x";
  for (int i = 0; i < 400'000; ++i) {
    std::string text;
    for (std::size_t n = 1 + random.below(22); n > 0; --n)
      text += alphabet[random.below(alphabet.size())];
    double expected = 0;
    const char* const end = text.data() + text.size();
    const bool is_number = std::from_chars(text.data(), end, expected).ptr == end;
    expect_scan_agrees(text, is_number, expected);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

TEST(ParseDouble, ReturnsNullWithoutANumber) {
  for (const std::string text :
       {"", "-", ".", "-.", "abc", " 1", "+1", ",", "e5", "--1", "\n", "-,5"}) {
    double x = 1;
    EXPECT_EQ(parse_double(text.data(), text.data() + text.size(), x), nullptr) << text;
  }
}

TEST(WriteDouble17, MatchesPrintfForRandomBits) {
  Random random;
  for (int i = 0; i < 1'000'000; ++i) expect_like_printf(random.any_bits());
}

TEST(WriteDouble17, MatchesPrintfForMeasuredValues) {
  Random random;
  for (double scale = 1e-12; scale < 1e12; scale *= 10)
    for (int i = 0; i < 100'000; ++i) expect_like_printf(random.uniform(-scale, scale));
}

TEST(WriteDouble17, MatchesPrintfForShortDecimalsAndIntegers) {
  Random random;
  for (int i = 0; i < 500'000; ++i) {
    const double n = static_cast<double>(random.below(100'000'000));
    for (double divisor : {1e0, 1e1, 1e3, 1e6, 1e9, 1e14}) expect_like_printf(n / divisor);
  }
}

TEST(WriteDouble17, MatchesPrintfAroundPowersOfTwoAndTen) {
  for (int e = -1074; e <= 1023; ++e)
    for (double x : {std::ldexp(1, e), std::ldexp(3, e - 1), std::ldexp(5, e - 2)})
      for (double y : {x, std::nextafter(x, 0), std::nextafter(x, 1e308)}) expect_like_printf(y);
  for (int e = -320; e <= 308; ++e) {
    double x = std::stod("1e" + std::to_string(std::max(e, -307)));
    for (int i = 0; i < 20; ++i) x = std::nextafter(x, 0);
    for (int i = 0; i < 40; ++i, x = std::nextafter(x, 1e308)) expect_like_printf(x);
  }
}

TEST(WriteDouble17,
     // Numbers whose 18 digits end in 5: odd multiples of small powers of 2.
     MatchesPrintfForTies) {
  Random random;
  for (int e = -60; e <= -1; ++e)
    for (int i = 0; i < 2'000; ++i)
      expect_like_printf(
          std::ldexp(static_cast<double>(2 * random.below(std::uint64_t{1} << 52) + 1), e));
}

TEST(WriteDouble17, WritesZeroAndNonFiniteNumbers) {
  for (double x : {0.0, -0.0, double{INFINITY}, -double{INFINITY}}) expect_like_printf(x);
}

TEST(WriteDoubles17, EqualsSingleNumbers) {
  Random random;
  std::vector<double> x;
  for (int i = 0; i < 300'003; ++i) {
    const double exponent = random.uniform(-110, 12);
    switch (random.below(4)) {
      case 0:
        x.push_back(random.uniform(-60, 60));
        break;
      case 1:
        x.push_back(random.uniform(-1, 1) * std::pow(10, exponent));
        break;
      case 2:
        x.push_back(random.any_bits());
        break;
      default:
        x.push_back(std::pow(10, std::floor(exponent)) * (random.below(2) ? 1 : -1));
        break;
    }
    if (random.below(3) == 0) x.back() = std::nextafter(x.back(), random.below(2) ? 0.0 : 1e300);
  }
  for (const double y : {0.0, -0.0, 0.5, 0.1, 9999999.9999999981, 1e7, 1e-98, 1e-5, 1e-4, 99.999})
    x.push_back(y);
  expect_single_number_texts(x);
}

}  // namespace
}  // namespace mdof
