// Several axes that use one device: the key `same_as`.
#include "daemon/measure/configuration/same_device.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace mdof::daemon {
namespace {

const std::string kData = MDOF_TEST_DATA;
const std::string kX =
    "[[axis]]\nrig = \"rig_X.toml\"\n[axis.device]\ndriver = \"labjack_t7\"\nname = \"t7\"\n"
    "address = \"10.0.0.9\"\nrate_hz = 1000\nchannel = [\n"
    "{ id = \"A\", input = \"AIN0\", delay_us = 200 }, { id = \"B\", input = \"AIN2\" },\n"
    "{ id = \"C\", input = \"AIN4\" }, { id = \"D\", input = \"AIN6\" },\n"
    "{ id = \"E\", input = \"AIN8\" },\n"
    "{ id = \"encoder\", input = \"DIO0\", um_per_count = 0.5, delay_us = 30 }]\n";

std::string axis_y(const std::string& device) {
  return "[[axis]]\nrig = \"rig_Y.toml\"\n[axis.device]\n" + device;
}
const std::string kSame = "same_as = \"t7\"\n";
const std::string kEncoderY =
    "channel = [{ id = \"encoder\", input = \"DIO2\", um_per_count = -0.25, offset_mm = 7 }]\n";

class SameDevice : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("mdof_same_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    for (const char axis : {'X', 'Y'}) {
      std::ifstream in(kData + "/five-probe/rig_" + axis + ".toml");
      std::string rig((std::istreambuf_iterator<char>(in)), {}), volts;
      for (std::size_t at = 0, end; at < rig.size(); at = end + 1) {
        end = rig.find('\n', at);
        const std::string line = rig.substr(at, end - at);
        volts += line + "\n" + (line.starts_with("range_um") ? "um_per_V = 10\n" : "");
        if (end == std::string::npos) break;
      }
      std::ofstream(folder_ / (std::string("rig_") + axis + ".toml")) << volts;
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  Result<Config> load(const std::string& axes) {
    std::ofstream(folder_ / "mdofd.toml") << "[store]\ndatabase = \"x.db\"\n" << axes;
    return load_config(folder_ / "mdofd.toml");
  }
  std::string refusal(const std::string& axes) {
    const auto config = load(axes);
    return config ? "accepted" : config.error().message;
  }
  std::filesystem::path folder_;
};

TEST_F(SameDevice, EachAxisHasItsOwnEncoderAndTheSharedProbes) {
  const auto config = load(kX + axis_y(kSame + kEncoderY));
  ASSERT_TRUE(config) << config.error().message;
  const auto& x = config->axes[0].devices.at(0);
  const auto& y = config->axes[1].devices.at(0);
  using Part = std::map<std::string, std::string>;
  EXPECT_EQ(
      x.part,
      (Part{{"A", "A"}, {"B", "B"}, {"C", "C"}, {"D", "D"}, {"E", "E"}, {"encoder", "encoder"}}));
  EXPECT_EQ(
      y.part,
      (Part{{"A", "A"}, {"B", "B"}, {"C", "C"}, {"D", "D"}, {"E", "E"}, {"encoder_Y", "encoder"}}));
  EXPECT_EQ(x.channels, (std::vector<std::string>{"A", "B", "C", "D", "E", "encoder"}));
  EXPECT_EQ(y.channels, (std::vector<std::string>{"encoder", "A", "B", "C", "D", "E"}));
  EXPECT_FALSE(x.is_declared_elsewhere);
  EXPECT_TRUE(y.is_declared_elsewhere);
  EXPECT_TRUE(x.encoder.counts && y.encoder.counts);
  EXPECT_EQ(x.encoder.offset_mm, std::nullopt);
  EXPECT_EQ(y.encoder.offset_mm, 7.0);
  EXPECT_EQ(config->axes[1].delays,
            (ChannelDelays{{"A", 200e-6}}));  // the delay of X's encoder does not apply to Y
  std::vector<std::string> read;
  for (const auto& channel : y.make().value()->info().channels) read.push_back(channel.id);
  EXPECT_EQ(read, (std::vector<std::string>{"A", "B", "C", "D", "E", "encoder", "encoder_Y"}));
}

// Y has its own fixture, whose probes use other inputs. A third axis uses the device too.
TEST_F(SameDevice, AnAxisMayHaveItsOwnProbes) {
  std::string own = kSame + "channel = [{ id = \"encoder\", input = \"DIO2\", um_per_count = 1 }";
  int ain = 9;
  for (const char* id : {"A", "B", "C", "D", "E"})
    own += std::string(", { id = \"") + id + "\", input = \"AIN" + std::to_string(ain++) + "\" }";
  std::string x = kX;
  x.replace(x.find("AIN8"), 4, "AIN7");
  const auto config = load(x + axis_y(own + "]\n"));
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->axes[1].devices[0].part.size(), 6u);
  EXPECT_TRUE(config->axes[1].devices[0].part.contains("A_Y"));
  EXPECT_FALSE(config->axes[1].devices[0].part.contains("A"));
}

TEST_F(SameDevice, TheEncoderMayComeFromAnotherDevice) {
  const std::string devices =
      "[[axis]]\nrig = \"rig_Y.toml\"\n[[axis.device]]\nsame_as = \"t7\"\n"
      "[[axis.device]]\ndriver = \"linux_counter\"\n"
      "channel = [{ id = \"encoder\", input = \"count0\", um_per_count = 0.05 }]\n";
  const auto config = load(kX + devices);
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->axes[1].devices[0].part.size(), 5u);
  EXPECT_FALSE(config->axes[1].devices[0].encoder.counts);
}

TEST_F(SameDevice, NamesEachMistakeWithLineAndRemedy) {
  const std::string counter =
      "[[axis]]\nrig = \"rig_X.toml\"\n[[axis.device]]\ndriver = \"linux_counter\"\nname = \"c\"\n"
      "channel = [{ id = \"encoder\", input = \"count0\", um_per_count = 1 }]\n"
      "[[axis.device]]\ndriver = \"labjack_t7\"\nname = \"t7\"\naddress = \"10.0.0.9\"\n"
      "channel = [{ id = \"A\", input = \"AIN0\" }, { id = \"B\", input = \"AIN1\" },\n"
      "{ id = \"C\", input = \"AIN2\" }, { id = \"D\", input = \"AIN3\" },\n"
      "{ id = \"E\", input = \"AIN4\" }]\n";
  const std::string simulated =
      "[[axis]]\nrig = \"rig_X.toml\"\n[axis.device]\ndriver = \"simulator\"\nname = \"sim\"\n";
  const auto encoder = [](const std::string& input) {
    return "channel = [{ id = \"encoder\", input = \"" + input + "\", um_per_count = 1 }]\n";
  };
  const struct {
    std::string text, says;
  } cases[] = {
      {kX + axis_y("same_as = \"t8\"\n" + kEncoderY),
       "mdofd.toml:18: axis[2].device.same_as: no earlier [[axis]] of this file has a device named "
       "\"t8\"; devices of earlier axes: t7"},
      {axis_y(kSame + kEncoderY) + kX, "a device named \"t7\"; devices of earlier axes: none"},
      {kX + axis_y(kSame), "no device provides channel \"encoder\""},
      {kX + axis_y(kSame + encoder("DIO0")), "input \"DIO0\" is already used by \"encoder\""},
      {kX + axis_y(kSame + encoder("DIO4")), "mdofd.toml:19: axis[2].device.channel"},
      {kX + axis_y(kSame + "rate_hz = 5\n" + kEncoderY), "rate_hz: unknown key"},
      {kX + axis_y(kSame + "channel = [{ id = \"encodr\", input = \"DIO2\" }]\n"),
       "is neither a probe of"},
      {kX + axis_y(kSame + "channel = [{ id = \"encoder\", input = \"DIO2\" }]\n"),
       "needs um_per_count"},
      {simulated + axis_y("same_as = \"sim\"\n"), "(simulator) cannot serve two axes"},
      {counter + axis_y("same_as = \"c\"\n" + encoder("count1")),
       "a device with driver linux_counter can share only its probes with a second axis"},
      {counter + axis_y("same_as = \"c\"\n"), "\"c\" provides no probe of"},
  };
  for (const auto& c : cases)
    EXPECT_NE(refusal(c.text).find(c.says), std::string::npos) << c.says << "\n" << refusal(c.text);
}

}  // namespace
}  // namespace mdof::daemon
