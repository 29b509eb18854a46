#include "daemon/measure/configuration/config.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace mdof::daemon {
namespace {

const std::string kData = MDOF_TEST_DATA;

class ConfigFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("mdof_config_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    for (const char* axis : {"X", "Y"}) {
      const std::string rig = std::string("rig_") + axis + ".toml";
      std::filesystem::copy_file(kData + "/five-probe/" + rig, folder_ / rig,
                                 std::filesystem::copy_options::overwrite_existing);
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Result<Config> load(const std::string& text) {
    std::ofstream(folder_ / "mdofd.toml") << "[store]\ndatabase = \"x.db\"\n" << text;
    return load_config(folder_ / "mdofd.toml");
  }
  std::string refusal(const std::string& text) {
    const auto config = load(text);
    return config ? "accepted" : config.error().message;
  }

  std::filesystem::path folder_;
};

const std::string kAxis = "[[axis]]\nrig = \"rig_X.toml\"\n[axis.device]\ndriver = \"simulator\"\n";

TEST_F(ConfigFile, ReadsAValidFile) {
  const auto config = load("[measure]\nmodel = \"exact\"\nsettle_s = 0.2\n" + kAxis);
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->axes.size(), 1u);
  EXPECT_EQ(config->measure.model, Model::exact);
  EXPECT_EQ(config->measure.dwell.settle_s, 0.2);
  EXPECT_TRUE(config->axes[0].simulated());
}

TEST_F(ConfigFile, ReadsTheAccessRules) {
  const auto config = load("[rpc]\nidle_timeout_s = 7\ncnc_group = \"root\"\n" + kAxis);
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->access.idle.count(), 7);
  EXPECT_EQ(config->access.cnc_group, gid_t{0});
  EXPECT_EQ(config->access.connections_of_user, 32u);
}

TEST_F(ConfigFile, NamesEachMistakeWithLineAndRemedy) {
  const struct {
    std::string text, says;
  } cases[] = {
      {"[stroe]\ndatabase = \"y\"\n", "did you mean \"store\""},
      {"[measure]\nmodle = \"exact\"\n", "did you mean \"model\""},
      {"[measure]\nmodel = \"exakt\"\n", "mdofd.toml:4: measure.model: must be"},
      {"[measure]\nsettle_s = -1\n", "must not be negative"},
      {"[measure]\nmax_speed_mm_s = 0\n", "must be more than 0"},
      {"[rpc]\ntcp_port = 70000\n", "from 1 to 65535"},
      {"[rpc]\nconnections = 1\n", "from 2 to 1024"},
      {"[rpc]\nconnections_of_user = 0\n", "from 1 to 1024"},
      {"[rpc]\nidle_timeout_s = -1\n", "from 0 to 86400"},
      {"[rpc]\ncnc_group = \"no such\"\n", "this computer has no group \"no such\""},
      {"[http]\nlisten = \"0.0.0.0:8080\"\n", "mdofd.toml:4: http.listen"},
      {"[http]\nlisten = \"127.0.0.1\"\n", "http.listen"},
      {"[http]\nhosts = [\"http://mill\"]\n", "http.hosts"},
      {"[http]\nlissten = \"127.0.0.1:1\"\n", "did you mean \"listen\""},
      {"[rpc\n", "mdofd.toml:3: not valid TOML"},
      {kAxis + "rate_hz = \"fast\"\n", "rate_hz"},
      {kAxis + "rate_hzz = 5\n", "did you mean \"rate_hz\""},
      {kAxis + kAxis, "a second rig for axis X"},
      {"[[axis]]\nrig = \"rig_X.toml\"\n", "add [axis.device]"},
      {"[[axis]]\nrig = \"nowhere.toml\"\n[axis.device]\ndriver = \"simulator\"\n",
       "nowhere.toml: cannot be read"},
      {"[[axis]]\nrig = \"rig_X.toml\"\n[axis.device]\ndriver = \"simulatr\"\n",
       "replay simulator"},
      {"[[axis]]\nrig = \"rig_X.toml\"\n[axis.device]\ndriver = \"replay\"\nfile = \"no.csv\"\n",
       "no.csv"},
  };
  for (const auto& c : cases) {
    EXPECT_NE(refusal(c.text).find(c.says), std::string::npos) << refusal(c.text);
  }
}

TEST_F(ConfigFile, RejectsAReplayOfAnotherAxis) {
  const std::string says =
      refusal("[[axis]]\nrig = \"rig_Y.toml\"\n[axis.device]\ndriver = \"replay\"\nfile = \"" +
              kData + "/five-probe/log_X.csv.gz\"\n");
  EXPECT_NE(says.find("axis"), std::string::npos) << says;
  EXPECT_NE(says.find("log_X"), std::string::npos) << says;
}

TEST_F(ConfigFile, AReplayedSimulationIsMarkedSimulated) {
  std::ofstream(folder_ / "made.csv") << "# simulated by a test\ntime_s,encoder_mm,A_um\n0,0,0\n";
  const auto config = load(
      "[[axis]]\nrig = \"rig_X.toml\"\n[axis.device]\ndriver = \"replay\"\nfile = \"made.csv\"\n");
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_TRUE(config->axes[0].simulated());
}

TEST_F(ConfigFile, RejectsARigThatCannotDetermineAllErrors) {
  std::ifstream in(folder_ / "rig_X.toml");
  std::string rig((std::istreambuf_iterator<char>(in)), {});
  rig = rig.substr(0, rig.rfind("[[probe]]"));
  std::ofstream(folder_ / "four.toml") << rig;
  const std::string says =
      refusal("[[axis]]\nrig = \"four.toml\"\n[axis.device]\ndriver = \"simulator\"\n");
  EXPECT_NE(says.find("four.toml"), std::string::npos) << says;
  EXPECT_NE(says.find("ECX"), std::string::npos) << says;
}

TEST_F(ConfigFile, ChannelsOfAnyDriverMayHaveADelay) {
  const std::string delayed = kAxis + "channel = [{ id = \"B\", delay_us = 3800 }]\n";
  const auto config = load(delayed);
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->axes[0].delays, (ChannelDelays{{"B", 0.0038}}));
  EXPECT_NE(refusal("[measure]\nsettle_s = 0.003\n" + delayed)
                .find("mdofd.toml:9: axis[1].device.channel[1].delay_us: a delay of 0.0038 s "
                      "is longer than settle_s"),
            std::string::npos)
      << refusal("[measure]\nsettle_s = 0.003\n" + delayed);
  EXPECT_NE(refusal(kAxis + "channel = [{ id = \"B\", input = \"1\" }]\n").find("unknown key"),
            std::string::npos);
  // A channel with a delay needs interpolated scans. Therefore max_gap_s is checked even if there
  // is only one device.
  const std::string gap = "[measure]\nmax_gap_s = 0.05\n", slow = "rate_hz = 10\n";
  EXPECT_EQ(refusal(gap + kAxis + slow), "accepted");
  EXPECT_NE(refusal(gap + delayed + slow).find("max_gap_s = 0.05"), std::string::npos);
}

// An AD7746 samples its probes slowly, and a second device counts the encoder. The default
// max_gap_s is accepted. A max_gap_s shorter than the sampling interval of the probes is rejected.
TEST_F(ConfigFile, RejectsAMaxGapBelowTheSamplingInterval) {
  std::ifstream file(folder_ / "rig_X.toml");
  std::string rig((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::string probe = "[[probe]]\n", reads = "reads = \"gap\"\n";
  for (auto at = rig.find(probe); at != std::string::npos; at = rig.find(probe, at + 1))
    rig.insert(at + probe.size(), reads);
  std::ofstream(folder_ / "rig_gaps.toml") << rig;
  std::string axis = "[[axis]]\nrig = \"rig_gaps.toml\"\n";
  const auto iio = [&](const std::string& name, const std::string& first, const char* second) {
    axis += "[[axis.device]]\ndriver = \"linux_iio\"\nname = \"" + name + "\"\ndevice = \"" + name +
            "\"\nrate_hz = 10\nchannel = [{ id = \"" + first +
            "\", input = \"capacitance0\", area_mm2 = 5 }";
    if (*second)
      axis += std::string(", { id = \"") + second + "\", input = \"capacitance1\", area_mm2 = 5 }";
    axis += "]\n";
  };
  iio("ad1", "A", "B");
  iio("ad2", "C", "D");
  iio("ad3", "E", "");
  axis +=
      "[[axis.device]]\ndriver = \"linux_counter\"\nname = \"counter\"\nrate_hz = 1000\n"
      "channel = [{ id = \"encoder\", input = \"count0\", um_per_count = 0.05 }]\n";
  EXPECT_EQ(refusal(axis), "accepted");
  EXPECT_NE(refusal("[measure]\nmax_gap_s = 0.05\n" + axis).find("max_gap_s = 0.05"),
            std::string::npos);
  EXPECT_EQ(refusal("[measure]\nmax_gap_s = 0.3\n" + axis), "accepted");
  EXPECT_NE(refusal("[measure]\nlag_bound_s = 0.1\n" + axis).find("lag_bound_s"),
            std::string::npos);
}

}  // namespace
}  // namespace mdof::daemon
