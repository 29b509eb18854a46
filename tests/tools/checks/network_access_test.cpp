// The packaged service may reach network devices only if a drop-in allows their addresses. Checks
// the drop-in, and the messages that name the command for it.
#include "tools/mdof/checks/network_access.h"
#include "daemon/words/error_text.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>

#include "drivers/io/connect_remedy.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

class NetworkAccess : public testing::Test {
 protected:
  NetworkAccess()
      : machine{fs::path(testing::TempDir()) / ("network_access-" + std::to_string(::getpid()))} {
    fs::remove_all(machine.root);
    fs::create_directories(units());
  }
  ~NetworkAccess() override { fs::remove_all(machine.root); }

  fs::path units() const { return machine.root / "etc/systemd/system"; }
  void install() { std::ofstream(units() / "mdofd.service") << "[Service]\n"; }
  // Checks a configuration with one network device at each address, and returns the findings.
  std::string found(const std::vector<std::string>& addresses) const {
    daemon::Config config;
    auto& axis = config.axes.emplace_back();
    for (const auto& address : addresses) {
      auto& device = axis.devices.emplace_back();
      device.name = "at " + address;
      device.identity = [address] { return "tcp " + address + ":502 unit 1"; };
    }
    axis.devices.emplace_back();  // this device is on USB
    std::string all;
    for (const auto& d : check_network(machine, config))
      all += std::string(to_string(d.level)) + " " + d.what + " | " + d.remedy + "\n";
    return all;
  }

  Machine machine;
};

TEST_F(NetworkAccess, WritesADropInForSystemd) {
  const auto file = allow_address(units(), network_address("192.168.0.0/24").value());
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(*file, units() / "mdofd.service.d/network-192.168.0.0-24.conf");
  std::stringstream text;
  text << std::ifstream(*file).rdbuf();
  EXPECT_NE(text.str().find("\n[Service]\nIPAddressAllow=192.168.0.0/24\n"), std::string::npos);
  EXPECT_TRUE(allow_address(units(), "192.168.0.0/24"));  // the same address again
}

TEST_F(NetworkAccess, RefusesInvalidAddresses) {
  for (const char* good : {"10.0.0.7", "fe80::1", "fd00::/8", "192.168.0.0/24"})
    EXPECT_TRUE(network_address(good)) << good;
  for (const char* bad :
       {"", "t7.local", "192.168.0", "192.168.0.256", "10.0.0.7/33", "10.0.0.7/", "10.0.0.7/x",
        "10.0.0.7\nUser=root", "10.0.0.7 any", "10.0.0.7:502", "fe80::/129", "any"}) {
    const auto refused = network_address(bad);
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
    EXPECT_NE(refused.error().message.find("192.168.0.0/24"), std::string::npos);
  }
  EXPECT_FALSE(network_address("0.0.0.0/0"));
  EXPECT_FALSE(network_address("::/0"));
}

TEST_F(NetworkAccess, WithoutPermissionTheErrorNamesTheCommand) {
  const fs::path file = machine.root / "file";
  std::ofstream(file) << "no folder";
  const auto refused = allow_address(file, "10.0.0.7");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::io);
  EXPECT_NE(refused.error().message.find("sudo mdof setup network 10.0.0.7"), std::string::npos)
      << refused.error().message;
}

TEST_F(NetworkAccess, DoctorNamesUnreachableDevices) {
  EXPECT_EQ(found({"192.168.0.7"}), "");  // the service is not installed, so nothing is reported
  install();
  EXPECT_EQ(found({"127.0.0.1", "[::1]"}), "");
  const std::string reported = found({"192.168.0.7", "192.168.1.9"});
  EXPECT_NE(
      reported.find(
          "WRONG network: the service mdofd has no permission to connect to 192.168.0.7 (device at "
          "192.168.0.7)"),
      std::string::npos)
      << reported;
  EXPECT_NE(reported.find("sudo mdof setup network 192.168.0.7 && sudo systemctl daemon-reload"),
            std::string::npos);
  ASSERT_TRUE(allow_address(units(), "192.168.0.0/24"));
  const std::string left = found({"192.168.0.7", "192.168.1.9"});
  EXPECT_EQ(left.find("192.168.0.7"), std::string::npos) << left;
  EXPECT_NE(left.find("192.168.1.9"), std::string::npos) << left;
  ASSERT_TRUE(allow_address(units(), "192.168.1.9"));
  EXPECT_EQ(found({"192.168.0.7", "192.168.1.9"}), "");
}

TEST_F(NetworkAccess, ConnectErrorsNameTheSetupCommand) {
  const drivers::Endpoint to{"amplifier.lan", 502};  // mdof setup network accepts no name
  const auto names_setup_command = [&](int error, bool service) {
    const std::string text = words::text(drivers::connect_error(to, "192.168.0.7", error, service));
    EXPECT_EQ(text.find("amplifier.lan:502: "), 0u) << text;
    return text.find("mdof setup network 192.168.0.7") != std::string::npos;
  };
  EXPECT_TRUE(names_setup_command(EPERM, true));
  EXPECT_TRUE(names_setup_command(EPERM, false));
  // The kernel drops the packets, so the connection times out.
  EXPECT_TRUE(names_setup_command(ETIMEDOUT, true));
  EXPECT_FALSE(names_setup_command(ETIMEDOUT, false));
  EXPECT_FALSE(names_setup_command(ECONNREFUSED, true));
}

}  // namespace
}  // namespace mdof::tools
