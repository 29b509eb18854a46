#include "drivers/qsb/protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "drivers/qsb/tick_length.h"

namespace mdof::drivers {
namespace {

TEST(QsbProtocol, EncodesAndReadsTheVersionReplyOfTheManual) {
  const QsbReply reply{'r', qsb::kVersion, 0x00001201, 16};
  const std::string line = "r 14 00001201 00000010 !\r\n";
  EXPECT_EQ(line.size(), 26u);
  EXPECT_EQ(qsb_line(reply, 0x0F), line);
  EXPECT_EQ(parse_qsb_line(line.substr(0, 24)), reply);
  const QsbIdentity identity = qsb_identity(reply.data);
  EXPECT_EQ(identity.serial, "00001");
  EXPECT_EQ(identity.model, "QSB-S");
  EXPECT_EQ(identity.firmware, 1);
}

TEST(QsbProtocol, EncodesCommands) {
  EXPECT_EQ(qsb_command('R', qsb::kVersion), "R14\r\n");
  EXPECT_EQ(qsb_command('W', qsb::kEor, 0x0F), "W150000000F\r\n");
  EXPECT_EQ(qsb_command('S', qsb::kCount), "S0E\r\n");
}

TEST(QsbProtocol, ReadsRepliesOfOtherFormats) {
  const QsbReply reply{'s', qsb::kCount, 0xFFFFFFFE, 7};
  EXPECT_EQ(qsb_line(reply, 0x0B), "s 0E FFFFFFFE !\r\n");
  EXPECT_EQ(qsb_line(reply, 0x01), "s0EFFFFFFFE!\n");
  EXPECT_EQ(parse_qsb_line("s 0E FFFFFFFE !"),
            (QsbReply{'s', qsb::kCount, 0xFFFFFFFE, std::nullopt}));
  EXPECT_EQ(parse_qsb_line("e 04 00000080 00000001 !")->type, 'e');
  EXPECT_EQ(parse_qsb_line("x 63 00000000 00000001 !")->type, 'x');
}

TEST(QsbProtocol, RefusesTruncatedOrJoinedLines) {
  const std::string line = "s 0E 00000123 00000010 !";
  ASSERT_TRUE(parse_qsb_line(line));
  for (std::size_t n = 0; n < line.size(); ++n) {
    EXPECT_FALSE(parse_qsb_line(line.substr(0, n))) << n;
    EXPECT_FALSE(parse_qsb_line(line.substr(n + 1))) << n;
    EXPECT_FALSE(parse_qsb_line(line.substr(0, n + 1) + line)) << n;
    std::string bent = line;
    bent[n] = '?';
    EXPECT_FALSE(parse_qsb_line(bent)) << n;
  }
  EXPECT_FALSE(parse_qsb_line("s 0E -0000123 00000010 !"));
  EXPECT_FALSE(parse_qsb_line("s 0E 0x000123 00000010 !"));
}

TEST(QsbProtocol, RecognisesABannerThatIsNoReply) {
  EXPECT_TRUE(is_qsb_banner("QSB-D  0E!"));
  EXPECT_TRUE(is_qsb_banner("s 0E 0000QSB-D  0E!"));
  EXPECT_FALSE(is_qsb_banner("s 0E 00000123 00000010 !"));
  EXPECT_FALSE(parse_qsb_line("QSB-D  0E!"));
}

double estimated_tick_ns(double nominal_ns, double true_ns, double seconds) {
  TickLength tick(nominal_ns);
  std::minstd_rand random(7);
  for (std::int64_t ticks = 100; static_cast<double>(ticks - 100) * true_ns < seconds * 1e9;
       ++ticks) {
    const double delay_ns = 0.2e6 + static_cast<double>(random() % 4'000'000);
    tick.add(ticks, std::llround(static_cast<double>(ticks) * true_ns + delay_ns));
  }
  return tick.ns();
}

TEST(TickLength, KeepsTheLengthIfDelaysExplainTheDifference) {
  for (const double ppm : {-100.0, 0.0, 100.0})
    EXPECT_EQ(estimated_tick_ns(1e6, 1e6 * (1 + ppm * 1e-6), 70), 1e6) << ppm;
}

// Three true tick lengths: from the roll-over time in the manual; 1/256 s; a length near 1/512 s.
TEST(TickLength, LearnsAnotherLength) {
  for (const double true_ns : {94.5 * 86400e9 / 4294967296.0, 1e9 / 256, 1e9 / 512 * 1.004}) {
    EXPECT_NEAR(estimated_tick_ns(qsb::kTick_ns, true_ns, 0.7) / true_ns, 1, 0.02) << true_ns;
    EXPECT_NEAR(estimated_tick_ns(qsb::kTick_ns, true_ns, 70) / true_ns, 1, 7e-4) << true_ns;
  }
}

// The first lines were delayed and arrived together after 0.2 s. The tick length must not change.
TEST(TickLength, DelayAtTheBeginningDoesNotChangeTheLength) {
  TickLength tick(1e6);
  for (std::int64_t ticks = 0; ticks < 2000; ++ticks)
    tick.add(ticks, std::max<std::int64_t>(ticks * 1'000'000, 200'000'000));
  EXPECT_EQ(tick.ns(), 1e6);
}

// The lines from 0.12 s to 0.36 s arrived 9 ms late. The length must be measured from the first
// line to the lines near 0.5 s.
TEST(TickLength, MeasuresWithTheLastQuarterOfASpan) {
  constexpr std::int64_t kTrue_ns = 3'906'250;  // 1/256 s
  TickLength tick(qsb::kTick_ns);
  for (std::int64_t ticks = 0; ticks * kTrue_ns < 600'000'000; ++ticks) {
    const std::int64_t at_ns = ticks * kTrue_ns;
    const bool late = at_ns > 120'000'000 && at_ns < 360'000'000;
    tick.add(ticks, at_ns + (late ? 9'000'000 : 0));
  }
  EXPECT_NEAR(tick.ns() / static_cast<double>(kTrue_ns), 1, 1e-3);
}

// The true tick length is 1050 ns. The first packet arrives without delay. The next packets are 8
// ms late and must not be used as the packets with the smallest delay.
TEST(QsbTickLength, UsesTheQuickestPacket) {
  TickLength tick(1000);
  for (int ms = 0; ms <= 600; ++ms) {
    const std::int64_t ticks = 1'000'000 + std::llround(ms * 1e6 / 1050);
    const int late_ms = ms > 0 && ms < 200 ? 8 : 0;
    tick.add(ticks, (ms + late_ms) * std::int64_t{1'000'000});
  }
  EXPECT_NEAR(tick.ns(), 1050, 1);
}

}  // namespace
}  // namespace mdof::drivers
