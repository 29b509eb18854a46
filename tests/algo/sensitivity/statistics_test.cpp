// The statistics of many distributions are compared with exact order statistics, which are found by
// sorting. The bits must be equal for every order of blocks, every split and every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "algo/sensitivity/random.h"
#include "algo/sensitivity/simulation.h"
#include "algo/sensitivity/statistics/intervals.h"
#include "algo/sensitivity/statistics/statistics.h"
#include "schema/base/random.h"
#include "schema/base/sha256.h"

namespace mdof::algo {
namespace {

// An experiment with one output, a function of the first random number of the trial and of the
// number of the trial.
class OneOutput : public Experiment {
 public:
  using Function = std::function<double(double u, std::uint64_t trial)>;
  explicit OneOutput(Function f, std::size_t bins = 1) : f_(std::move(f)) {
    outputs_ = {"Y_um"};
    binned_ = {bins == 1 ? "" : "travel_mm", 0, 1, bins};
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j) {
      const std::uint64_t trial = first + step * j;
      out[0][j] = f_(draw({7, 0}, trial, 0), trial);
    }
  }
  std::vector<double> sorted(std::uint64_t trials) const {
    std::vector<double> x;
    for (std::uint64_t i = 0; i < trials; ++i) {
      const double y = f_(draw({7, 0}, i, 0), i);
      if (std::isfinite(y)) x.push_back(y);
    }
    std::sort(x.begin(), x.end());
    return x;
  }

 private:
  Function f_;
};

StudyStatistics study(const Experiment& e, std::uint64_t trials) {
  StudyStatistics s(e, pilot_scale(e));
  s.add_block(e, 0, trials);
  return s;
}

struct Shape {
  const char* name;
  OneOutput::Function f;
};

std::vector<Shape> shapes() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  return {
      {"rectangular", [](double u, auto) { return 3 + 2 * u; }},
      {"normal", [](double u, auto) { return 5 + gaussian(u); }},
      {"exponential", [](double u, auto) { return -std::log(u); }},
      {"lognormal, sd 2", [](double u, auto) { return std::exp(2 * gaussian(u)); }},
      {"Cauchy", [](double u, auto) { return std::tan(M_PI * (u - 0.5)); }},
      {"U-shaped", [](double u, auto) { return std::cos(M_PI * u); }},
      {"two values", [](double u, auto) { return u < 0.3 ? -1.0 : 4.0; }},
      {"rarely not zero", [](double u, auto) { return u < 1e-3 ? u : 0.0; }},
      {"constant", [](double, auto) { return 0.1; }},
      {"zero", [](double u, auto) { return u < 0.5 ? 0.0 : -0.0; }},
      {"far from zero", [](double u, auto) { return 1e9 + gaussian(u); }},
      {"tiny", [](double u, auto) { return 1e-150 * gaussian(u); }},
      {"huge", [](double u, auto) { return 1e150 * gaussian(u); }},
      {"a third unsolved", [=](double u, auto) { return u < 1 / 3.0 ? kNaN : gaussian(u); }},
      {"infinite at times",
       [](double u, std::uint64_t i) {
         return i % 1000 == 5 ? std::numeric_limits<double>::infinity() : u;
       }},
      {"wider after the pilot",
       [](double u, std::uint64_t i) { return gaussian(u) * (i < 20'000 ? 1e-3 : 1e3); }},
  };
}

// Compares each value of the summary with the sorted trial at its rank.
void expect_order(const OutputSummary& s, const std::vector<double>& x) {
  const auto at = [&](std::uint64_t rank) { return x[rank - 1]; };
  ASSERT_EQ(s.n, x.size());
  EXPECT_EQ(s.min, x.front());
  EXPECT_EQ(s.max, x.back());
  for (const Quantile& q : s.quantiles) {
    EXPECT_NEAR(q.value, at(quantile_rank(q.p, s.n)), s.resolution) << q.p;
  }
  const IntervalRanks r = symmetric_ranks(s.coverage, s.n);
  EXPECT_NEAR(s.symmetric.low, at(r.low), s.resolution);
  EXPECT_NEAR(s.symmetric.high, at(r.high), s.resolution);
  // The shortest interval is searched over all ranks. The interval in the summary must contain as
  // many trials and be as short, within the resolution.
  const std::uint64_t q = r.high - r.low;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::uint64_t i = 1; i + q <= s.n; ++i) shortest = std::min(shortest, at(i + q) - at(i));
  EXPECT_NEAR(s.shortest.high - s.shortest.low, shortest, 2 * s.resolution);
  const auto within = std::upper_bound(x.begin(), x.end(), s.shortest.high + s.resolution) -
                      std::lower_bound(x.begin(), x.end(), s.shortest.low - s.resolution);
  EXPECT_GE(static_cast<std::uint64_t>(within), q);
}

TEST(StudyStatistics, OrderIsWithinTheStatedResolutionOfSorting) {
  for (const Shape& shape : shapes()) {
    for (const std::uint64_t trials : {1ull, 2ull, 1000ull, 60'001ull}) {
      SCOPED_TRACE(std::string(shape.name) + ", " + std::to_string(trials));
      const OneOutput e(shape.f);
      const std::vector<double> x = e.sorted(trials);
      const StudyStatistics s = study(e, trials);
      const OutputSummary summary =
          s.overall({0.95, {0.0001, 0.01, 0.025, 0.3, 0.5, 0.9, 0.975, 0.9999}}).at(0);
      EXPECT_EQ(summary.unsolved, trials - x.size());
      if (x.empty()) {
        EXPECT_TRUE(std::isnan(summary.mean) && std::isnan(summary.symmetric.low));
      } else {
        expect_order(summary, x);
      }
    }
  }
}

TEST(StudyStatistics, ResolutionIsASmallPartOfTheSpread) {
  const auto resolution = [](OneOutput::Function f) {
    const OneOutput e(std::move(f));
    const OutputSummary s = study(e, 100'000).overall().at(0);
    return s.resolution / (s.symmetric.high - s.symmetric.low);
  };
  EXPECT_LT(resolution([](double u, auto) { return gaussian(u); }), 1 / 3000.0);
  EXPECT_LT(resolution([](double u, auto) { return u; }), 1 / 3000.0);
  EXPECT_EQ(resolution([](double u, auto) { return u < 0.5 ? 1.0 : 2.0; }) < 1 / 1000.0, true);
}

TEST(StudyStatistics, MomentsMatchTheTrials) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const OneOutput e(shape.f);
    const std::vector<double> x = e.sorted(30'000);
    const OutputSummary s = study(e, 30'000).overall().at(0);
    if (x.front() == x.back()) {
      EXPECT_EQ(s.mean, x.front());
      EXPECT_EQ(s.sd, 0);
      EXPECT_EQ(s.sd_se, 0);
      continue;
    }
    const auto n = static_cast<long double>(x.size());
    long double sum = 0, m2 = 0, m4 = 0;
    for (const double y : x) sum += y;
    const long double mean = sum / n;
    for (const double y : x) m2 += (y - mean) * (y - mean);
    for (const double y : x) m4 += (y - mean) * (y - mean) * (y - mean) * (y - mean);
    const long double sd = std::sqrt(m2 / (n - 1));
    const auto scale = static_cast<double>(std::max<long double>(std::abs(mean), sd));
    EXPECT_NEAR(s.mean, static_cast<double>(mean), 1e-12 * scale);
    EXPECT_NEAR(s.sd, static_cast<double>(sd), 1e-9 * static_cast<double>(sd));
    EXPECT_NEAR(s.mean_se, static_cast<double>(sd / std::sqrt(n)), 1e-9 * static_cast<double>(sd));
    const long double of_variance = (m4 / n - (n - 3) / (n - 1) * sd * sd * sd * sd) / n;
    const auto sd_se = static_cast<double>(std::sqrt(of_variance) / (2 * sd));
    EXPECT_NEAR(s.sd_se, sd_se, 0.01 * sd_se);
  }
}

// If a moment exceeds the range of the fixed-point sums, it must be NaN and not a wrong number.
TEST(StudyStatistics, OverflowingMomentIsNaN) {
  const OneOutput e([](double u, std::uint64_t i) { return i == 50'000 ? 1e200 : gaussian(u); });
  const OutputSummary s = study(e, 60'000).overall().at(0);
  EXPECT_TRUE(std::isnan(s.mean));
  EXPECT_TRUE(std::isnan(s.sd));
  EXPECT_TRUE(std::isnan(s.sd_se));
  EXPECT_EQ(s.max, 1e200);
  EXPECT_NEAR(s.symmetric.high, 1.96, 0.05);
}

// The values are constant except for rounding. A rare event, from nm to mm, does not occur in the
// pilot.
TEST(StudyStatistics, PilotWithoutSpreadKeepsLaterValues) {
  for (const double usual : {0.0, -3.0, 250.0}) {
    for (const double event : {1e-3, 50.0, 1000.0}) {
      SCOPED_TRACE(std::to_string(usual) + ", " + std::to_string(event));
      const OneOutput e([=](double u, std::uint64_t i) {
        return i % 10'000 == 5'000 ? usual + event : usual * (u < 0.5 ? 1 : 1 + 0x1p-52);
      });
      const OutputSummary s = study(e, 100'000).overall().at(0);
      const double p = 1e-4, sd = event * std::sqrt(p * (1 - p) * 100'000 / 99'999);
      EXPECT_NEAR(s.mean, usual + event * p, 1e-12 * std::max(std::abs(usual), event));
      EXPECT_NEAR(s.sd, sd, 1e-6 * sd);
      EXPECT_TRUE(std::isfinite(s.sd_se));
      EXPECT_NEAR(s.symmetric.high, usual, s.resolution);
      EXPECT_LE(s.resolution, std::max(1.0, std::abs(usual)) * 1e-6);
    }
  }
}

TEST(StudyStatistics, AnyOrderSplitAndInstructionSetGivesSameBytes) {
  const auto experiment = make_simulation(simulation_1_defaults()).value();
  const StudyScale scale = pilot_scale(*experiment);
  const std::uint64_t block = block_trials(*experiment), trials = 7 * block + 4321;
  StudyStatistics whole(*experiment, scale);
  whole.add_block(*experiment, 0, trials);
  const std::string bytes = whole.serialise();
  for (const InstructionSet set : available_instruction_sets()) {
    StudyStatistics a(*experiment, scale, set), b(*experiment, scale, set);
    a.add_block(*experiment, 7 * block, 4321);
    b.add_block(*experiment, 2 * block, block);
    a.add_block(*experiment, 0, 2 * block);
    b.add_block(*experiment, 3 * block, 4 * block);
    b.merge(a);
    EXPECT_EQ(b.serialise(), bytes) << to_string(set);
    StudyStatistics c = StudyStatistics::parse(a.serialise(), *experiment, set).value();
    c.add_block(*experiment, 2 * block, 5 * block);  // as in a run that is continued
    EXPECT_EQ(c.serialise(), bytes) << to_string(set);
    EXPECT_EQ(c.trials(), trials);
  }
}

// The bytes of the pilot, sums and histograms of the first 10^5 trials were stored from g++ 12.
// clang++ must give the same bits.
TEST(StudyStatistics, HaveTheStoredBits) {
  const auto experiment = make_simulation(simulation_1_defaults()).value();
  EXPECT_EQ(sha256_hex(study(*experiment, 100'000).serialise()),
            "ac88faf275d7f348882d393ca3ca9be5fcce86b392242f3bc2d4c0b6da52873e");
}

TEST(StudyStatistics, TailsAndUnsolvedTrialsDoNotDependOnOrder) {
  for (const Shape& shape : shapes()) {
    const OneOutput e(shape.f, 5);
    const std::uint64_t block = block_trials(e);
    StudyStatistics whole(e, pilot_scale(e)), a(e, pilot_scale(e)), b(e, pilot_scale(e));
    whole.add_block(e, 0, 3 * block + 17);
    a.add_block(e, 3 * block, 17);
    b.add_block(e, 2 * block, block);
    a.add_block(e, 0, 2 * block);
    a.merge(b);
    EXPECT_EQ(a.serialise(), whole.serialise()) << shape.name;
    EXPECT_EQ(a.overall()[0].sd, whole.overall()[0].sd) << shape.name;
  }
}

TEST(StudyStatistics, BinsContainTheirOwnTrials) {
  const OneOutput e([](double u, std::uint64_t i) { return static_cast<double>(i % 4) + u; }, 4);
  const StudyStatistics s = study(e, 40'003);
  const auto bins = s.bins();
  ASSERT_EQ(bins.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const OutputSummary& out = bins[i].outputs.at(0);
    EXPECT_EQ(out.n, i < 3 ? 10'001u : 10'000u);
    EXPECT_NEAR(out.mean, static_cast<double>(i) + 0.5, 5 * out.mean_se);
    EXPECT_DOUBLE_EQ(bins[i].from, 0.25 * static_cast<double>(i));
  }
  EXPECT_EQ(s.overall().at(0).n, 40'003u);
}

TEST(StudyStatistics, DrawnHistogramCountsEveryTrialOnce) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const OneOutput e(shape.f);
    const OutputSummary s = study(e, 30'000).overall().at(0);
    std::uint64_t n = s.histogram.below + s.histogram.above;
    for (const std::uint64_t count : s.histogram.counts) n += count;
    EXPECT_EQ(n, s.n);
    EXPECT_LE(s.histogram.counts.size(), 121u);
    EXPECT_GT(s.histogram.width, 0);
  }
  const OneOutput normal([](double u, auto) { return gaussian(u); });
  EXPECT_GE(study(normal, 30'000).overall().at(0).histogram.counts.size(), 100u);
}

TEST(StudyStatistics, RejectsDamagedBytes) {
  const OneOutput e([](double u, auto) { return std::tan(M_PI * (u - 0.5)); }, 2);
  const std::string bytes = study(e, 20'000).serialise();
  ASSERT_TRUE(StudyStatistics::parse(bytes, e));
  // The tails contain values far away.
  EXPECT_EQ(StudyStatistics::parse(bytes, e)->serialise(), bytes);
  for (std::size_t n = 0; n < bytes.size(); n += 1 + n / 50) {
    EXPECT_FALSE(StudyStatistics::parse(bytes.substr(0, n), e)) << n;
  }
  EXPECT_FALSE(StudyStatistics::parse(bytes + '\0', e));
  int accepted = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 1 + at / 200) {
    for (const char flip : {'\x01', '\x80'}) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] ^ flip);
      const auto parsed = StudyStatistics::parse(other, e);
      if (parsed) {  // a changed sum or edge can be another valid number
        ++accepted;
        parsed->overall();
        parsed->bins();
      } else {
        EXPECT_NE(parsed.error().message.find("statistics of a study"), std::string::npos);
      }
    }
  }
  EXPECT_GT(accepted, 0);
  const OneOutput other([](double u, auto) { return u; }, 3);
  const auto wrong = StudyStatistics::parse(bytes, other);
  ASSERT_FALSE(wrong);
  EXPECT_NE(
      wrong.error().message.find("1 outputs in 2 bins, but the study has 1 outputs in 3 bins"),
      std::string::npos);
}

TEST(StudyStatistics, MemoryDoesNotGrowWithTrials) {
  const auto experiment = make_simulation(simulation_1_defaults()).value();
  const std::size_t after_one = study(*experiment, 20'480).memory_bytes();
  EXPECT_EQ(study(*experiment, 1'024'000).memory_bytes(), after_one);
  EXPECT_LT(after_one, 4'000'000u);
}

TEST(StudyStatistics, BlocksAreMultiplesOfTheBins) {
  for (const std::size_t bins : {1u, 6u, 20u, 37u, 200u}) {
    const OneOutput e([](double u, auto) { return u; }, bins);
    EXPECT_EQ(block_trials(e) % (bins * kCellTrials), 0u);
    EXPECT_GE(block_trials(e), 10'000u);
  }
}

// The scale follows the magic number, the version and three counts. It consists of the lower edge
// of the first bin and the width of a bin. The width must be positive, and the end of 8192 bins
// must be finite.
TEST(StudyStatistics, RejectsAScaleThatIsNotFinite) {
  const OneOutput e([](double u, auto) { return u; });
  const std::string bytes = study(e, 1000).serialise();
  const auto is_read = [&](std::size_t which, double value) {
    std::string other = bytes;
    std::memcpy(other.data() + 8 + 4 + 3 * 8 + which * 8, &value, 8);
    return StudyStatistics::parse(other, e).has_value();
  };
  EXPECT_TRUE(is_read(0, -3));
  EXPECT_TRUE(is_read(1, 0.5));
  EXPECT_TRUE(is_read(1, 2e304));
  EXPECT_FALSE(is_read(1, 2.3e304));  // 8192 bins would have the width 1.88e308
  for (const double none : {0.0, -1.0, HUGE_VAL, std::nan("")}) EXPECT_FALSE(is_read(1, none));
  for (const double none : {-HUGE_VAL, HUGE_VAL, std::nan("")}) EXPECT_FALSE(is_read(0, none));
}

}  // namespace
}  // namespace mdof::algo
