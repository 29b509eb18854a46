#include "drivers/capancdt/replies.h"

#include <gtest/gtest.h>

namespace mdof::drivers::capancdt {
namespace {

std::string text_of(std::string_view command, std::string_view received) {
  const auto reply = find_reply(command, received);
  if (!reply) return "nothing";
  return (reply->refused ? "refused " : "") + reply->text;
}

TEST(CapancdtReplies, ReadsTheManualsExamples) {
  EXPECT_EQ(text_of("$STI1200", "$STI1200,960OK\r\n"), ",960");
  EXPECT_EQ(text_of("$STI?", "$STI?960OK\r\n"), "960");
  EXPECT_EQ(text_of("$TRG0", "$TRG0OK\r\n"), "");
  EXPECT_EQ(text_of("$CHS", "$CHS1,0,2,1OK\r\n"), "1,0,2,1");
  EXPECT_EQ(text_of("$GDP", "$GDP10001OK\r\n"), "10001");
  EXPECT_EQ(text_of("$VER", "$VERDT6200;V1.2a;8010079\r\n"), "DT6200;V1.2a;8010079");
  EXPECT_EQ(text_of("$VER", "$VERDT6200;V1.2aOK\r\n"), "DT6200;V1.2a");
}

TEST(CapancdtReplies, AcceptsEveryKindOfEcho) {
  EXPECT_EQ(text_of("$STI?", "$STI?\r$STI?960OK\r\n"), "960");
  EXPECT_EQ(text_of("$STI?", "$STI?\r\n$STI?960OK\r\n"), "960");
  EXPECT_EQ(text_of("$STI?", "$STI?$STI?960OK\r\n"), "960");
  EXPECT_EQ(text_of("$STI?", "$ST$STI?960OK\r\nI?\r"), "960");
  EXPECT_EQ(text_of("$VER", "$VER\r$VERDT6200;V1\r\n"), "DT6200;V1");
  EXPECT_EQ(text_of("$TRG0", "Welcome\r\nSerial: 5\r\n$TRG0\r$TRG0OK\r\n"), "");
}

TEST(CapancdtReplies, WaitsForACompleteReply) {
  const std::string whole = "$STI?\r$STI?960OK\r";
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_EQ(text_of("$STI?", whole.substr(0, n)), "nothing") << n;
  EXPECT_EQ(text_of("$STI?", whole), "960");
  EXPECT_EQ(text_of("$STI?", "$AVT?0OK\r\n"), "nothing");  // this is the reply to another command
  EXPECT_EQ(text_of("$VER", "$VER\r\n"), "nothing");
}

TEST(CapancdtReplies, ReadsRefusals) {
  EXPECT_EQ(text_of("$COI", "$COI\r$UNKNOWN COMMAND\r\n"), "refused $UNKNOWN COMMAND");
  EXPECT_EQ(text_of("$AVN9", "$AVN9$WRONG PARAMETER\r\n"), "refused $WRONG PARAMETER");
  EXPECT_EQ(text_of("$COI", "$UNKNOWN COMM"), "nothing");
}

TEST(CapancdtReplies, ReadsAWelcomeInAnyWords) {
  const Welcome welcome = parse_welcome("hello\r\nGeraet : DT6230 \r\nS/N:4711\r\nmore\r\nhal");
  EXPECT_EQ(welcome.lines, 4);
  EXPECT_EQ(welcome.name, "DT6230");
  EXPECT_EQ(welcome.serial, "4711");
  const Welcome other = parse_welcome("one\r\ntwo\r\n");
  EXPECT_EQ(other.lines, 2);
  EXPECT_EQ(other.name, "");
  EXPECT_EQ(parse_welcome("").lines, 0);
}

TEST(CapancdtReplies, FindsFields) {
  const std::string info = ":ANO2800,NAMCS2,SNO1001,OFS0,RNG2000,UNTum,DTY1";
  EXPECT_EQ(field(info, "ANO"), "2800");
  EXPECT_EQ(field(info, "SNO"), "1001");
  EXPECT_EQ(field(info, "DTY"), "1");
  EXPECT_EQ(field(info, "VER"), "");
  EXPECT_EQ(field("", "ANO"), "");
}

TEST(CapancdtReplies, ReadsRanges) {
  EXPECT_EQ(channel_range_um(":RNG2000,UNTum"), 2000.0);
  EXPECT_EQ(channel_range_um(":RNG500,UNT\xB5m"), 500.0);
  EXPECT_EQ(channel_range_um(":RNG500,UNT\xC2\xB5m"), 500.0);
  EXPECT_EQ(channel_range_um(":RNG500,UNT\xCE\xBCm"), 500.0);
  EXPECT_EQ(channel_range_um(":RNG0.5,UNTmm"), 500.0);
  EXPECT_EQ(channel_range_um(":RNG50,UNTnm"), 0.05);
  for (const char* none : {"", ":RNG2000", ":RNG,UNTum", ":RNGx,UNTum", ":RNG2000,UNTV",
                           ":RNG0,UNTum", ":RNG-1,UNTum", ":RNGinf,UNTum", ":RNGnan,UNTum"})
    EXPECT_EQ(channel_range_um(none), std::nullopt) << none;
}

TEST(CapancdtReplies, ReadsNumbersAndLists) {
  EXPECT_EQ(parse_integer("960"), 960);
  EXPECT_EQ(parse_integer(",960"), 960);
  for (const char* none : {"", ",", "9x", "99999999999", "1.5"})
    EXPECT_EQ(parse_integer(none), std::nullopt) << none;
  EXPECT_EQ(parse_channel_list("1,0,2,1"), (std::vector{1, 0, 2, 1}));
  EXPECT_EQ(parse_channel_list("1"), (std::vector{1}));
  for (const char* none : {"", "1,", ",1", "1,x", "-1"})
    EXPECT_EQ(parse_channel_list(none), std::nullopt) << none;
}

}  // namespace
}  // namespace mdof::drivers::capancdt
