#include "drivers/channels.h"

#include <gtest/gtest.h>

#include "drivers/counter/unwrap.h"
#include "drivers/registry.h"

namespace mdof::drivers {
namespace {

Rig rig_of(std::initializer_list<const char*> ids) {
  Rig rig;
  rig.source = "rig.toml";
  for (const char* id : ids) {
    rig.probes.emplace_back();
    rig.probes.back().id = id;
  }
  return rig;
}

Result<std::vector<ChannelInput>> read(const std::string& toml) {
  auto table = TomlTable::parse(toml, "mdofd.toml");
  EXPECT_TRUE(table);
  MDOF_TRY(auto channels, read_channels(*table, rig_of({"A", "left"})));
  MDOF_CHECK(table->finish());
  return channels;
}

std::string refusal(const std::string& toml) {
  const auto channels = read(toml);
  return channels ? "accepted" : channels.error().message;
}

TEST(Channels, ReadsChannelsInOrder) {
  const auto channels = read(
      "[[channel]]\nid = \"encoder\"\ninput = \"DIO0\"\num_per_count = -0.02\n"
      "[[channel]]\nid = \"A\"\ninput = \"AIN3\"\n");
  ASSERT_TRUE(channels) << channels.error().message;
  ASSERT_EQ(channels->size(), 2u);
  EXPECT_EQ((*channels)[0].id, "encoder");
  EXPECT_EQ((*channels)[0].um_per_count, -0.02);
  EXPECT_TRUE(check_um_per_count((*channels)[0]));
  EXPECT_EQ((*channels)[1].input, "AIN3");
  EXPECT_FALSE(check_um_per_count((*channels)[1]));
}

TEST(Channels, ReportsEachError) {
  const std::string a = "[[channel]]\nid = \"A\"\ninput = \"1\"\n";
  const struct {
    std::string toml, says;
  } cases[] = {
      {"", "add [[axis.device.channel]]"},
      {"[[channel]]\nid = \"lefft\"\ninput = \"1\"\n", "did you mean \"left\""},
      {"[[channel]]\nid = \"lefft\"\ninput = \"1\"\n", "mdofd.toml:2"},
      {a + a, "channel \"A\" has a second input"},
      {a + "[[channel]]\nid = \"left\"\ninput = \"1\"\n", "is already used by \"A\""},
      {"[channel]\nid = \"A\"\n", "[[channel]]"},
      {a + "index_mm = 3\n", "mdofd.toml:4: channel[1].index_mm: applies to the encoder only"},
  };
  for (const auto& c : cases)
    EXPECT_NE(refusal(c.toml).find(c.says), std::string::npos) << refusal(c.toml);
}

TEST(Channels, EncoderWithoutOffsetMayHaveAMark) {
  const std::string encoder = "[[channel]]\nid = \"encoder\"\ninput = \"count\"\n";
  const auto channels = read(encoder + "index_mm = -12.5\n");
  ASSERT_TRUE(channels) << channels.error().message;
  const EncoderOrigin origin = encoder_origin(*channels, true);
  EXPECT_EQ(origin.index_mm, -12.5);
  EXPECT_EQ(origin.index_where, "mdofd.toml:4: channel[1].index_mm");
  EXPECT_EQ(encoder_origin(read(encoder).value(), true).index_mm, std::nullopt);
}

std::string index_refusal(const std::string& driver, const std::string& keys) {
  auto table = TomlTable::parse(keys + "id = \"encoder\"\nindex_mm = 12.5\n", "mdofd.toml");
  EXPECT_TRUE(table) << table.error().message;
  DriverContext context;
  context.name = "daq";
  context.rig = rig_of({"A"});
  const auto spec = configure_driver(driver, *table, context);
  return spec ? "accepted" : spec.error().message + "; " + to_string(spec.error().remedy);
}

TEST(IndexSupport, DriversWithoutMarkStateReasonAndRemedy) {
  const std::string counter = "um_per_count = 0.05\n", channel = "[[channel]]\n";
  const std::string host = "address = \"127.0.0.1\"\n";
  const struct {
    const char* driver;
    std::string keys;
    const char* says;
  } cases[] = {
      {"labjack_t7", host + channel + counter + "input = \"DIO0\"\n",
       "near 0, mdof cannot distinguish the reset from a motion"},
      {"labjack_u6",
       channel + "id = \"A\"\ninput = \"AIN0\"\n" + channel + counter + "input = \"FIO0\"\n",
       "near 0, mdof cannot distinguish the reset from a motion"},
      {"pokeys57u", channel + counter + "input = \"ultrafast\"\n", "PoKeysLibEncoders.c"},
      {"modbus", host + "profile = \"pokeys57e\"\n" + channel + counter + "input = \"encoder1\"\n",
       "a Modbus device does not report"},
      {"mcc_usb1608fs_plus", channel + "input = \"CH0\"\n", "has no counter"},
      {"qsb", "port = \"/dev/ttyUSB0\"\n" + channel + counter + "input = \"count\"\n", "accepted"},
  };
  for (const auto& c : cases) {
    const std::string message = index_refusal(c.driver, c.keys);
    EXPECT_NE(message.find(c.says), std::string::npos) << c.driver << ": " << message;
    if (message == "accepted") continue;
    EXPECT_NE(message.find("].index_mm: "), std::string::npos) << message;
    EXPECT_NE(message.find("; count_without_mark"), std::string::npos) << message;
  }
}

TEST(Channels, ChannelsOfFurtherAxesHaveTheirOwnNames) {
  auto table = TomlTable::parse("[[channel]]\nid = \"A\"\ninput = \"1\"\n", "mdofd.toml");
  auto of_y = TomlTable::parse(
      "[[channel]]\nid = \"encoder\"\ninput = \"DIO2\"\num_per_count = 1\noffset_mm = 3\n"
      "[[channel]]\nid = \"A\"\ninput = \"2\"\n",
      "mdofd.toml");
  Rig y = rig_of({"A"});
  y.axis = Axis::y;
  auto channels = read_channels(*table, rig_of({"A"})).value();
  const std::vector<FurtherAxis> further = {{y, *of_y}};
  ASSERT_TRUE(read_further_channels(further, {}, channels));
  EXPECT_EQ(ids_of(channels), (std::vector<std::string>{"A", "encoder_Y", "A_Y"}));
  EXPECT_EQ(channels[0].further, std::nullopt);
  EXPECT_EQ(channels[1].further, Axis::y);
  const auto encoders = further_encoders(channels, further, {"DIO2"});
  EXPECT_TRUE(encoders.at("encoder_Y").counts);
  EXPECT_EQ(encoders.at("encoder_Y").offset_mm, 3.0);
  EXPECT_FALSE(further_encoders(channels, further, {"DIO0"}).at("encoder_Y").counts);
}

TEST(Channels, UnknownInputErrorListsTheInputs) {
  ChannelInput channel;
  channel.input = "AIN77";
  channel.where = "mdofd.toml:3: channel.input";
  const std::string says = no_such_input(channel, {"AIN0", "AIN1"}).value().message;
  EXPECT_NE(says.find("mdofd.toml:3"), std::string::npos);
  EXPECT_NE(says.find("the inputs of the device are AIN0, AIN1"), std::string::npos);
}

TEST(Unwrap, FollowsACounterOverBothEnds) {
  Unwrap count(16);
  EXPECT_EQ(count(65'530), 65'530);
  EXPECT_EQ(count(4), 65'540);
  EXPECT_EQ(count(65'500), 65'500);
  Unwrap down(32, true);
  EXPECT_EQ(down(0xFFFFFFFF), -1);
  EXPECT_EQ(down(1), 1);
  EXPECT_EQ(down(0x7FFFFFFF), 0x7FFFFFFF);
  EXPECT_EQ(down(0x80000001), 0x80000001LL);
  down.reset();
  EXPECT_EQ(down(0x80000001), -0x7FFFFFFFLL);
}

}  // namespace
}  // namespace mdof::drivers
