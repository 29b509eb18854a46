#include "daemon/station/check_start.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/daemon/store/fixtures.h"

namespace mdof::daemon {
namespace {

namespace fs = std::filesystem;

class CheckStart : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("mdof_start_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string refusal(const std::string& text, const std::string& rig = "") {
    const std::string name = rig.empty() ? "rig_volts_X.toml" : rig;
    fs::copy_file(std::string(MDOF_TEST_DATA) + "/devices/" + name, folder_ / "rig_X.toml",
                  fs::copy_options::overwrite_existing);
    std::ofstream(folder_ / "mdofd.toml") << text;
    const auto config = load_config(folder_ / "mdofd.toml");
    if (!config) return config.error().message;
    const auto checked = check_start(*config);
    return checked ? "" : checked.error().message;
  }
  std::string in_folder(const char* name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

std::string t7(const std::string& name, const std::string& channels) {
  return "[[axis.device]]\ndriver = \"labjack_t7\"\nname = \"" + name +
         "\"\naddress = \"127.0.0.1:50200\"\nrate_hz = 100\nchannel = [" + channels + "]\n";
}
const std::string kEncoder = R"({ id = "encoder", input = "DIO0", um_per_count = 0.1 })";
const std::string kProbes = R"({ id = "A", input = "AIN0" }, { id = "B", input = "AIN1" },
  { id = "C", input = "AIN2" }, { id = "D", input = "AIN3" }, { id = "E", input = "AIN4" })";
const std::string kAxis = "[[axis]]\nrig = \"rig_X.toml\"\n";

TEST_F(CheckStart, MissingFoldersThatCanBeCreatedAreAccepted) {
  EXPECT_EQ(refusal("[store]\ndatabase = \"" + in_folder("a/b/mdof.db") + "\"\n[rpc]\nsocket = \"" +
                    in_folder("c/d/s") + "\"\n"),
            "");
  EXPECT_FALSE(fs::exists(folder_ / "a"));  // the check does not create the folder
}

TEST_F(CheckStart, NamesAnInvalidPathWithLineAndKey) {
  std::ofstream(folder_ / "file") << "x";
  const struct {
    std::string text, says;
  } cases[] = {
      {"[store]\ndatabase = \"" + in_folder("file/mdof.db") + "\"\n",
       "mdofd.toml:2: store.database: "},
      {"[store]\ndatabase = \"" + in_folder("") + "\"\n", "is a folder"},
      {"[store]\ndatabase = \"" + in_folder("mdof.db") + "\"\nrecordings = \"" + in_folder("file") +
           "\"\n",
       "mdofd.toml:3: store.recordings: "},
      {"[store]\ndatabase = \"" + in_folder("mdof.db") + "\"\n[rpc]\nsocket = \"" +
           in_folder("file") + "\"\n",
       "mdofd.toml:4: rpc.socket: "},
      {"[store]\ndatabase = \"" + in_folder("mdof.db") + "\"\n[rpc]\nsocket = \"/tmp/" +
           std::string(120, 'x') + "\"\n",
       "mdofd.toml:4: rpc.socket: the path has 125 bytes (limit 107)"},
  };
  for (const auto& c : cases)
    EXPECT_NE(refusal(c.text).find(c.says), std::string::npos) << refusal(c.text);
}

TEST_F(CheckStart, AFolderWithoutPermissionNamesTheGroup) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::create_directories(folder_ / "closed");
  ::chmod(in_folder("closed").c_str(), 0500);
  const std::string says =
      refusal("[store]\ndatabase = \"" + in_folder("closed/below/mdof.db") + "\"\n");
  EXPECT_NE(says.find("mdofd.toml:2: store.database: "), std::string::npos) << says;
  EXPECT_NE(says.find("group mdof"), std::string::npos) << says;
  EXPECT_EQ(says.find("root"), std::string::npos) << says;
}

// No owner of the folder can write to it, so "sudo install -o mdof" would not help.
TEST_F(CheckStart, AReadOnlyFileSystemIsNamed) {
  fs::create_directories(folder_ / "fixed");
  store::with_private_mounts(
      [&] { return store::mount_read_only(folder_ / "fixed"); },
      [&] {
        const std::string says =
            refusal("[store]\ndatabase = \"" + in_folder("fixed/below/mdof.db") + "\"\n");
        fprintf(stderr, "%s\n", says.c_str());
        return says.find("the file system is read-only") != std::string::npos &&
               says.find("sudo") == std::string::npos;
      });
}

TEST_F(CheckStart, FindsVoltsWithoutAScaleBeforeTheFirstSample) {
  const std::string store = "[store]\ndatabase = \"" + in_folder("mdof.db") + "\"\n";
  const std::string good = store + kAxis + t7("t7", kEncoder + ", " + kProbes);
  EXPECT_EQ(refusal(good), "");
  const std::string says = refusal(good, "rig_X.toml");
  EXPECT_NE(says.find("mdofd.toml:"), std::string::npos) << says;
  EXPECT_NE(says.find("channel"), std::string::npos) << says;
  EXPECT_NE(says.find("um_per_V"), std::string::npos) << says;
}

TEST_F(CheckStart, NamesTwoEntriesForOneDevice) {
  const std::string says = refusal("[store]\ndatabase = \"" + in_folder("mdof.db") + "\"\n" +
                                   kAxis + t7("one", kEncoder) + t7("two", kProbes));
  for (const char* part : {"\"one\"", "\"two\"", "127.0.0.1:50200", "mdofd.toml"})
    EXPECT_NE(says.find(part), std::string::npos) << says;
}

TEST_F(CheckStart, OthersMayEnterTheFolderOfTheSocket) {
  const mode_t before = ::umask(0077);
  ASSERT_TRUE(make_socket_folder(in_folder("run/mdof/s")));
  ::umask(before);
  for (const char* name : {"run", "run/mdof"}) {
    struct stat info {};
    ASSERT_EQ(::stat(in_folder(name).c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0755u);
  }
  std::ofstream(folder_ / "file") << "x";
  EXPECT_FALSE(make_socket_folder(in_folder("file/below/s")));
}

// If there is no configuration, mdofd prints an example. The example must be valid.
TEST_F(CheckStart, ThePrintedFirstConfigurationIsAccepted) {
  const std::string text = first_configuration("/etc/mdof/mdofd.toml");
  const auto config = text.find("# --- /etc/mdof/mdofd.toml"), rig = text.find("# --- rig_X.toml");
  ASSERT_NE(config, std::string::npos);
  ASSERT_NE(rig, std::string::npos);
  std::ofstream(folder_ / "mdofd.toml") << text.substr(config, rig - config);
  std::ofstream(folder_ / "rig_X.toml") << text.substr(rig);
  const auto loaded = load_config(folder_ / "mdofd.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->axes.size(), 1u);
}

}  // namespace
}  // namespace mdof::daemon
