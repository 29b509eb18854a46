// Valid and damaged bytes of statistics. The test assembles them in the format of
// statistics_bytes.cpp. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "algo/sensitivity/statistics/statistics.h"
#include "schema/base/bytes.h"

namespace mdof::algo {
namespace {

using Pairs = std::vector<std::pair<std::int64_t, std::uint64_t>>;

// Bytes of one output in one bin. `core`: pairs of the number of empty bins before and the count.
// `tails`: pairs of key and count.
struct OutputBytes {
  std::uint64_t n = 0, unsolved = 0;
  double min = 1.5, max = 2.5;
  std::uint8_t lost = 0;
  Pairs core = {}, tails = {};
  bool ends_in_core = false;  // the bytes end after the last core bin
  bool ends = false;          // the bytes end before a tail that is announced
};

class BytesShape : public Experiment {
 public:
  BytesShape(std::size_t outputs, std::size_t bins) {
    binned_ = {"travel_mm", 0.25, 0.75, bins};
    for (std::size_t k = 0; k < outputs; ++k) outputs_.push_back(k == 0 ? "EYX_um" : "EZX_um");
  }
  void run(std::uint64_t, std::uint64_t, std::size_t, std::span<double* const>) const override {}
};

std::string bytes_of(std::size_t outputs, std::size_t bins, std::uint64_t trials,
                     const std::vector<OutputBytes>& cells) {
  std::string to = "MDOFSTAT";
  put_number(to, std::uint32_t{1});
  put_number(to, std::uint64_t{outputs});
  put_number(to, std::uint64_t{bins});
  put_number(to, trials);
  for (std::size_t k = 0; k < outputs; ++k) {
    put_number(to, -0.75 + static_cast<double>(k));
    put_number(to, 0.0625);
  }
  for (const OutputBytes& cell : cells) {
    put_number(to, cell.n);
    put_number(to, cell.unsolved);
    put_number(to, cell.min);
    put_number(to, cell.max);
    put_number(to, cell.lost);
    for (const std::uint64_t word : {7u, 0u, 11u, 0u}) put_number(to, word);  // two power sums
    for (const auto& [empty, count] : cell.core) {
      put_varint(to, static_cast<std::uint64_t>(empty));
      put_varint(to, count);
    }
    if (cell.ends_in_core) return to;
    put_varint(to, 0);
    put_varint(to, 0);
    put_varint(to, cell.tails.size() + (cell.ends ? 1 : 0));
    for (const auto& [key, count] : cell.tails) {
      put_number(to, static_cast<std::int32_t>(key));
      put_varint(to, count);
    }
  }
  return to;
}

// Returns whether the bytes of one output in one bin are accepted.
bool is_read(const OutputBytes& cell) {
  const BytesShape shape(1, 1);
  const std::string bytes = bytes_of(1, 1, cell.n + cell.unsolved, {cell});
  const auto read = StudyStatistics::parse(bytes, shape);
  EXPECT_TRUE(!read || read->serialise() == bytes);
  return read.has_value();
}

// Eleven trials: in core bin 5, core bin 6 and the last core bin, and in tails with the first and
// last keys and the keys next to the core.
const OutputBytes kGood{.n = 11,
                        .unsolved = 2,
                        .core = {{5, 2}, {0, 1}, {8184, 1}},
                        .tails = {{-65153, 1}, {-1, 2}, {1, 3}, {65153, 1}}};

TEST(StatisticsBytes, AreWrittenAsTheyWereRead) {
  EXPECT_TRUE(is_read(kGood));
  for (const std::uint8_t lost : {1, 2, 3}) {
    OutputBytes some = kGood;
    some.lost = lost;
    EXPECT_TRUE(is_read(some)) << int{lost};
  }
  EXPECT_TRUE(
      is_read({.unsolved = 3, .min = 2, .max = -2}));  // without trials no extremes are required
  EXPECT_TRUE(is_read({.n = 1, .min = 2, .max = 2, .core = {{3, 1}}}));
}

TEST(StatisticsBytes, RejectsImpossibleExtremesAndPowers) {
  OutputBytes cell = kGood;
  cell.lost = 4;
  EXPECT_FALSE(is_read(cell));
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& [min, max] :
       {std::pair(2.5, 1.5), std::pair(-infinite, 1.5), std::pair(1.5, infinite)}) {
    EXPECT_FALSE(is_read({.n = 1, .min = min, .max = max, .core = {{3, 1}}})) << min << " " << max;
    EXPECT_FALSE(is_read({.n = 2, .min = min, .max = max, .core = {{3, 2}}})) << min << " " << max;
  }
}

TEST(StatisticsBytes, RejectsImpossibleCountsOfBins) {
  const auto core = [](std::uint64_t n, const Pairs& pairs, bool ends = false) {
    return is_read({.n = n, .core = pairs, .ends_in_core = ends});
  };
  EXPECT_TRUE(core(3, {{8191, 3}}));
  EXPECT_TRUE(core(3, {{1, 2}, {8189, 1}}));
  for (const bool ends : {false, true}) {
    EXPECT_FALSE(core(3, {{8192, 3}}, ends));          // bin after the last one
    EXPECT_FALSE(core(3, {{1, 2}, {8190, 1}}, ends));  // bin after the last one, as the second pair
    EXPECT_FALSE(core(3, {{1, 3}, {0, 1}}, ends));     // more counts than trials
    EXPECT_FALSE(core(3, {{1, 2}}, ends));             // fewer counts than trials
  }
}

TEST(StatisticsBytes, RejectsImpossibleTails) {
  const auto tails = [](const Pairs& pairs, bool ends = false) {
    return is_read({.n = 5, .core = {{4, 2}}, .tails = pairs, .ends = ends});
  };
  EXPECT_TRUE(tails({{-3, 1}, {2, 2}}));
  for (const bool ends : {false, true}) {
    EXPECT_FALSE(tails({{-65154, 3}}, ends));
    EXPECT_FALSE(tails({{65154, 3}}, ends));
    EXPECT_FALSE(tails({{0, 3}}, ends));
    EXPECT_FALSE(tails({{2, 2}, {2, 1}}, ends));
    EXPECT_FALSE(tails({{2, 2}, {-3, 1}}, ends));
    EXPECT_FALSE(tails({{-3, 3}, {2, 0}}, ends));
    EXPECT_FALSE(tails({{-3, 2}, {2, 2}}, ends));  // more counts than trials
    EXPECT_FALSE(tails({{-3, 2}}, ends));          // fewer counts than trials
  }
}

// Two outputs in two bins. For each output, the sum of its trials must equal the number of trials
// of the study.
TEST(StatisticsBytes, EachOutputNeedsAllTrials) {
  const auto of = [](std::uint64_t n, std::uint64_t unsolved) {
    return OutputBytes{.n = n, .unsolved = unsolved, .core = {{9, n}}};
  };
  const BytesShape shape(2, 2);
  EXPECT_TRUE(
      StudyStatistics::parse(bytes_of(2, 2, 7, {of(3, 0), of(4, 1), of(2, 2), of(1, 1)}), shape));
  EXPECT_FALSE(
      StudyStatistics::parse(bytes_of(2, 2, 7, {of(3, 0), of(4, 0), of(2, 1), of(1, 3)}), shape));
  EXPECT_FALSE(
      StudyStatistics::parse(bytes_of(2, 2, 8, {of(3, 0), of(4, 1), of(2, 2), of(1, 1)}), shape));
}

}  // namespace
}  // namespace mdof::algo
