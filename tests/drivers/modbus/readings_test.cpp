#include "drivers/modbus/readings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>

#include "drivers/modbus/sentinels.h"
#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::modbus {
namespace {

Profile profile_from(const std::string& values) {
  auto profile = parse_profile("name = \"test\"\n" + values, "test.toml");
  EXPECT_TRUE(profile) << profile.error().message;
  return profile ? *profile : Profile{};
}

std::string value(const std::string& keys) {
  return "[[value]]\nname = \"v\"\naddress = 0\n" + keys;
}

// Makes a profile with one value, and reads this value from the registers in `hex`.
Reading reading(const std::string& keys, const std::string& hex, double um_per_count = 1) {
  const Profile profile = profile_from(value(keys));
  Readings readings(profile, {{profile.values[0], um_per_count}});
  const std::string words = bytes(hex);
  for (std::size_t i = 0; i < readings.registers(0).size(); ++i)
    readings.registers(0)[i] = word_at(words, 2 * i);
  return readings.read()[0];
}

TEST(ModbusReadings, ReadsEveryTypeInBothWordOrders) {
  EXPECT_EQ(reading("", "FFFE").value, 65534);
  EXPECT_EQ(reading("type = \"i16\"", "FFFE").value, -2);
  EXPECT_EQ(reading("type = \"u32\"", "00112233").value, 0x00112233);
  EXPECT_EQ(reading("type = \"u32\"\nwords = \"low-first\"", "22330011").value, 0x00112233);
  EXPECT_EQ(reading("type = \"u32\"", "FFFFFFFE").value, 4294967294.0);
  EXPECT_EQ(reading("type = \"i32\"", "FFFFFFFE").value, -2);
  EXPECT_EQ(reading("type = \"i32\"\nwords = \"low-first\"", "FFFEFFFF").value, -2);
  EXPECT_EQ(reading("type = \"f32\"", "C0200000").value, -2.5);
  EXPECT_EQ(reading("type = \"f32\"\nwords = \"low-first\"", "0000C020").value, -2.5);
}

TEST(ModbusReadings, AppliesScaleOffsetAndCountLength) {
  EXPECT_EQ(reading("scale = 0.5\noffset = -3\nunit = \"V\"", "0008").value, 1);
  EXPECT_EQ(reading("", "0008", -0.25).value, -2);
  EXPECT_EQ(reading("unit = \"V\"", "0008", -0.25).value, 8);
}

TEST(ModbusReadings, InvalidFloatIsMissing) {
  for (const char* hex : {"7FC00000", "7F800000", "FF800000"}) {
    const Reading r = reading("type = \"f32\"\nunit = \"V\"", hex);
    EXPECT_EQ(r.quality, Quality::missing);
    EXPECT_TRUE(std::isnan(r.value));
  }
}

TEST(ModbusReadings, WorstStatusBitSetsTheQuality) {
  const std::string statuses = R"([[status]]
address = 1
mask = 0x0003
makes = "suspect"
[[status]]
address = 1
mask = 0x0004
makes = "missing"
values = ["v"]
[[status]]
address = 1
mask = 0x0008
makes = "missing"
values = ["other"]
[[value]]
name = "other"
address = 2
)";
  const Profile profile = profile_from(value("over_range = [7]\n") + statuses);
  Readings readings(profile, {{profile.values[0], 1}});
  ASSERT_EQ(readings.blocks(), (std::vector<Block>{{{kReadHolding, 0}, 2}}));
  const auto quality = [&](std::uint16_t raw, std::uint16_t status) {
    readings.registers(0)[0] = raw;
    readings.registers(0)[1] = status;
    return readings.read()[0].quality;
  };
  EXPECT_EQ(quality(1, 0), Quality::good);
  EXPECT_EQ(quality(1, 2), Quality::suspect);
  EXPECT_EQ(quality(7, 2), Quality::over_range);
  EXPECT_EQ(quality(7, 6), Quality::missing);
  EXPECT_EQ(quality(1, 8), Quality::good);
}

TEST(ModbusReadings, RingContinuesOverItsEnds) {
  const Profile profile = profile_from(value("ring_bits = 11\n"));
  Readings readings(profile, {{profile.values[0], 1}});
  const auto count = [&](std::uint16_t raw) {
    readings.registers(0)[0] = raw;
    return readings.read()[0].value;
  };
  EXPECT_EQ(count(2), 2);
  EXPECT_EQ(count(2046), -2);
  EXPECT_EQ(count(3), 3);
  EXPECT_EQ(count(900), 900);
  EXPECT_EQ(count(1800), 1800);
  EXPECT_EQ(count(5), 2053);
}

// A LabJack T7 and a PoKeys57E have opposite orders of words.
TEST(ModbusReadings, EncodesValuesInBothWordOrders) {
  const auto words = [](const std::string& keys, double raw) {
    return encode(profile_from(value(keys)).values[0], raw);
  };
  using Words = std::vector<std::uint16_t>;
  EXPECT_EQ(words("", 0xFFFE), (Words{0xFFFE}));
  EXPECT_EQ(words("type = \"i16\"", -2), (Words{0xFFFE}));
  EXPECT_EQ(words("type = \"u32\"", 0x89ABCDEF), (Words{0x89AB, 0xCDEF}));
  EXPECT_EQ(words("type = \"u32\"\nwords = \"low-first\"", 0x89ABCDEF), (Words{0xCDEF, 0x89AB}));
  EXPECT_EQ(words("type = \"i32\"", -2), (Words{0xFFFF, 0xFFFE}));
  EXPECT_EQ(words("type = \"f32\"", -2.5), (Words{0xC020, 0}));
}

TEST(ModbusReadings, ReadsAdjacentRegistersTogether) {
  const auto at = [](int address, int count = 1, Function function = kReadHolding) {
    return Span{{function, address}, count};
  };
  const auto block = [](int address, int count, Function function = kReadHolding) {
    return Block{{function, address}, count};
  };
  EXPECT_EQ(plan_reads({at(2), at(0), at(1), at(1)}, 0), (std::vector<Block>{block(0, 3)}));
  EXPECT_EQ(plan_reads({at(0), at(2)}, 0), (std::vector<Block>{block(0, 1), block(2, 1)}));
  EXPECT_EQ(plan_reads({at(0), at(2)}, 1), (std::vector<Block>{block(0, 3)}));
  EXPECT_EQ(plan_reads({at(0, 2), at(1, 2, kReadInput)}, 9),
            (std::vector<Block>{block(0, 2), block(1, 2, kReadInput)}));
  EXPECT_EQ(plan_reads({at(0, 124), at(124, 2)}, 0),
            (std::vector<Block>{block(0, 124), block(124, 2)}));
  EXPECT_EQ(plan_reads({}, 0), std::vector<Block>{});
}

TEST(ModbusProfiles, BuiltInProfilesAreValidAndNeedOneRead) {
  ASSERT_EQ(built_in_profiles().size(), 3u);
  for (const auto& [name, text] : built_in_profiles()) {
    const auto profile = load_profile(name, "");
    ASSERT_TRUE(profile) << profile.error().message;
    std::vector<Readings::Use> uses;
    for (const Value& v : profile->values) uses.push_back({v, 1});
    EXPECT_EQ(Readings(*profile, uses).blocks().size(), 1u) << name;
  }
  const auto smax = load_profile("lika-smax", "");
  const Readings readings(*smax, {{smax->values[0], 100}});
  const auto& [from, count] = readings.blocks()[0];
  EXPECT_EQ(wrap(Framing::rtu, {0, 1, read_request(from.function, from.address, count)}),
            bytes("01 04 00 00 00 07 B1 C8"));
  const auto adam = load_profile("adam-6017", "");
  EXPECT_EQ(adam->values.size(), 8u);
  EXPECT_EQ(adam->values[7].name, "AI7");
  EXPECT_EQ(adam->values[7].at.address, 7);
  EXPECT_EQ(adam->values[7].check->at.address, 207);
  EXPECT_EQ(load_profile("pokeys57e", "")->values[24].at.address, 748);
}

// The appendix of the SMAX manual has this reply with alarms and position.
TEST(ModbusProfiles, ReadsASmaxReplyOfTheManual) {
  const auto smax = load_profile("lika-smax", "");
  Readings readings(*smax, {{smax->values[0], 100}});
  const Frame asked{0, 1, read_request(kReadInput, 0, 7)};
  const auto answer = answer_to(asked, Framing::rtu,
                                bytes("01 04 0E 00 00 04 D2 00 00 00 00 01 00 01 01 00 01 6F BE"));
  ASSERT_TRUE(answer) << answer.error().message;
  for (std::size_t i = 0; i < 7; ++i) readings.registers(0)[i] = word_at(answer->registers, 2 * i);
  EXPECT_EQ(readings.read()[0].value, 123'400);
  EXPECT_EQ(readings.read()[0].quality, Quality::good);
}

TEST(ModbusProfiles, LoadsAProfileByItsPath) {
  const std::string path = testing::TempDir() + "mdof_modbus_profile_test.toml";
  std::ofstream(path) << "name = \"mine\"\nprotocol = \"rtu\"\n" << value("type = \"f32\"\n");
  const auto mine = load_profile(path, "/nowhere");
  ASSERT_TRUE(mine) << mine.error().message;
  EXPECT_EQ(mine->name, "mine");
  EXPECT_EQ(mine->framing, Framing::rtu);
  ASSERT_EQ(mine->values.size(), 1u);
  EXPECT_EQ(mine->values[0].type, Type::f32);
}

TEST(ModbusProfiles, ReportsErrorsWithLineAndKey) {
  const auto says = [](const std::string& text, const std::string& part) {
    const auto profile = parse_profile(text, "p.toml");
    ASSERT_FALSE(profile) << text;
    EXPECT_NE(profile.error().message.find(part), std::string::npos)
        << text << " → " << profile.error().message;
  };
  const std::string head = "name = \"x\"\n";
  says(head, "value: is missing");
  says(value(""), "name: is missing");
  says(head + "protocol = \"udp\"\n" + value(""),
       "p.toml:2: protocol: \"udp\" is not one of tcp, rtu");
  says(head + "join_gap = 126\n" + value(""), "p.toml:2: join_gap");
  says(head + "[[value]]\nname = \"v\"\n", "address: is missing");
  says(head + "[[value]]\nname = \"v\"\naddress = 65536\n", "address: must be from 0 to 65535");
  says(head + value("type = \"u64\"\n"), "p.toml:5: value[1].type: \"u64\" is not one of u16");
  says(head + value("words = \"middle\"\n"), "words");
  says(head + value("registers = \"coil\"\n"), "registers");
  says(head + value("scale = inf\n"), "scale: must be a finite number");
  says(head + value("scale = 0\n"), "scale: must not be 0");
  says(head + value("typ = \"u16\"\n"), "type");
  says(head + value("count = 3\n"), "name: must contain \"#\"");
  says(head + value("ring_bits = 17\n"),
       "ring_bits: must be at most 16 (the number of bits of the register)");
  says(head + value("type = \"f32\"\nring_bits = 8\n"), "ring_bits: applies to counters");
  says(head + value("") + value(""), "\"v\" is given twice");
  says(head + "[[value]]\nname = \"v\"\naddress = 65535\ntype = \"u32\"\n",
       "beyond register 65535");
  says(head + "[[value]]\nname = \"v#\"\naddress = 65530\ncount = 7\n", "beyond register 65535");
  EXPECT_TRUE(
      parse_profile(head + "[[value]]\nname = \"v#\"\naddress = 65530\ncount = 6\n", "p.toml"));
  says(head + value("") + "[[status]]\naddress = 1\n", "mask: must have at least one bit set");
  says(head + value("") + "[[status]]\naddress = 1\nmask = 1\nmakes = \"bad\"\n", "makes");
  says(head + value("") + "[[status]]\naddress = 1\nmask = 1\nvalues = [\"w\"]\n",
       "the profile has no value \"w\"");
}

TEST(ModbusSentinels, SentinelLengthIsUnusedAndNotPending) {
  Sentinels sentinels;
  const Shape three{kReadInput, 3}, two{kReadInput, 2}, one{kReadInput, 1}, four{kReadInput, 4};
  EXPECT_TRUE(sentinels.add_regular(three));
  EXPECT_EQ(sentinels.pick(three), two);
  EXPECT_EQ(sentinels.pick(three), two);  // the same length until the reply to this sentinel
  sentinels.proved();
  // The reply to the sentinel has arrived, so no request is pending.
  EXPECT_EQ(sentinels.pick(three), two);
  sentinels.failed();
  sentinels.proved();  // this may be the late reply to the first sentinel
  EXPECT_EQ(sentinels.pick(three), one);
  sentinels.proved();
  EXPECT_EQ(sentinels.pick(three), two);
  sentinels.failed();
  // A sentinel of this length is pending, so the line must be tested first.
  EXPECT_FALSE(sentinels.add_regular(two));
  EXPECT_EQ(sentinels.pick(two), one);
  sentinels.proved();
  EXPECT_TRUE(sentinels.add_regular(two));
  EXPECT_TRUE(sentinels.add_regular(one));
  EXPECT_EQ(sentinels.pick(three), four);
}

TEST(ModbusSentinels, SentinelForOneRegisterReadsMore) {
  Sentinels sentinels;
  sentinels.add_regular({kReadHolding, 1});
  EXPECT_EQ(sentinels.pick({kReadHolding, 1}), (Shape{kReadHolding, 2}));
  Sentinels full;
  for (int count = 1; count <= kMostRegisters; ++count) full.add_regular({kReadHolding, count});
  EXPECT_EQ(full.pick({kReadHolding, 5}).count, 0);
}

}  // namespace
}  // namespace mdof::drivers::modbus
