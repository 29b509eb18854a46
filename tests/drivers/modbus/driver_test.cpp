// Profiles, driver and simulated device together, over real sockets and a pseudo terminal.
#include <fcntl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "drivers/io/byte_stream.h"
#include "drivers/modbus/simulated_modbus.h"
#include "drivers/registry.h"
#include "tests/drivers/served_device.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using Kind = SimulatedModbus::Faults::Kind;

Rig rig() {
  Rig rig;
  rig.source = "rig.toml";
  for (const char* id : {"A", "B"}) {
    Probe probe;
    probe.id = id;
    rig.probes.push_back(probe);
  }
  return rig;
}

Result<DriverSpec> configured(const std::string& toml) {
  MDOF_TRY(TomlTable table, TomlTable::parse(toml, "mdofd.toml"));
  return configure_driver("modbus", table, {"device", rig(), {}, "."});
}

std::unique_ptr<Driver> driver_of(const std::string& toml) {
  const auto spec = configured(toml);
  EXPECT_TRUE(spec) << spec.error().message;
  auto driver = spec->make();
  EXPECT_TRUE(driver);
  return std::move(*driver);
}

std::string toml_of(const std::string& profile, const std::string& address,
                    const std::string& channels, const std::string& more = "poll_ms = 2\n") {
  return "profile = \"" + profile + "\"\naddress = \"" + address + "\"\n" + more + channels;
}

std::string channel(const std::string& id, const std::string& input, const std::string& more = "") {
  return "[[channel]]\nid = \"" + id + "\"\ninput = \"" + input + "\"\n" + more;
}

modbus::Profile profile_of(const std::string& name) {
  auto profile = modbus::load_profile(name, ".");
  EXPECT_TRUE(profile) << profile.error().message;
  return *profile;
}

SampleBlock one_scan(Driver& driver, int reads = 20) {
  SampleBlock block;
  for (int i = 0; i < reads && block.scans() == 0; ++i) {
    const auto state = driver.read(block, milliseconds(500));
    EXPECT_TRUE(state) << state.error().message;
    if (!state) break;
  }
  EXPECT_EQ(block.scans(), 1u);
  return block;
}

const std::string kPosition = channel("encoder", "position");

TEST(ModbusDriver, ReadsVoltsOfAnAdamInOneBlock) {
  SimulatedModbus device([](std::size_t i, std::int64_t) { return i - 3.5; },
                         {profile_of("adam-6017"), {}});
  ServedDevice served(device);
  auto driver =
      driver_of(toml_of("adam-6017", served.address(), channel("A", "AI0") + channel("B", "AI7")));
  const auto opened = driver->open();
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(driver->info().channels, (std::vector<Channel>{{"A", Unit::volt}, {"B", Unit::volt}}));
  EXPECT_EQ(driver->info().rate_hz, 500);
  std::int64_t last_ns = 0;
  for (int i = 0; i < 5; ++i) {
    const SampleBlock block = one_scan(*driver);
    EXPECT_NEAR(block.value[0][0], -3.5, 20.0 / 65535);
    EXPECT_NEAR(block.value[1][0], 3.5, 20.0 / 65535);
    EXPECT_EQ(block.quality_at(0, 0), Quality::good);
    EXPECT_EQ(block.lost, 0u);
    EXPECT_GT(block.time_ns[0], last_ns);
    last_ns = block.time_ns[0];
  }
}

TEST(ModbusDriver, AdamAtTheEndsOfItsRangeIsOverRange) {
  SimulatedModbus::Faults faults;
  faults.words[{modbus::kReadHolding, 0}] = 0;
  faults.words[{modbus::kReadHolding, 1}] = 65535;
  SimulatedModbus device([](auto, auto) { return 1.0; }, {profile_of("adam-6017"), faults});
  ServedDevice served(device);
  auto driver =
      driver_of(toml_of("adam-6017", served.address(),
                        channel("A", "AI0") + channel("B", "AI1") + channel("encoder", "AI2")));
  ASSERT_TRUE(driver->open());
  const SampleBlock block = one_scan(*driver);
  EXPECT_EQ(block.quality_at(0, 0), Quality::over_range);
  EXPECT_EQ(block.quality_at(1, 0), Quality::over_range);
  EXPECT_EQ(block.quality_at(2, 0), Quality::good);
  EXPECT_DOUBLE_EQ(block.value[0][0], -10);
  EXPECT_DOUBLE_EQ(block.value[1][0], 10);
}

TEST(ModbusDriver, RefusesOtherRangesAndDevicesAtOpening) {
  SimulatedModbus::Faults faults;
  faults.words[{modbus::kReadHolding, 203}] = 0x0142;
  SimulatedModbus device([](auto, auto) { return 1.0; }, {profile_of("adam-6017"), faults});
  ServedDevice served(device);
  auto other = driver_of(toml_of("adam-6017", served.address(), channel("A", "AI2")));
  EXPECT_TRUE(other->open());
  auto driver = driver_of(toml_of("adam-6017", served.address(), channel("A", "AI3")));
  const auto opened = driver->open();
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("the input is not set to +-10 V (register 203 is 0x0142, "
                                        "but the profile requires 0x0143)"),
            std::string::npos)
      << opened.error().message;

  faults.words = {{{modbus::kReadHolding, 210}, 0x6018}};
  SimulatedModbus stranger([](auto, auto) { return 1.0; }, {profile_of("adam-6017"), faults});
  ServedDevice served_too(stranger);
  auto wrong = driver_of(toml_of("adam-6017", served_too.address(), channel("A", "AI2")));
  const auto refused = wrong->open();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("not an ADAM-6017"), std::string::npos);
}

TEST(ModbusDriver, ReadsASlowAdamWithinTheTimeoutOnly) {
  SimulatedModbus::Faults faults;
  faults.delay_ms = 30;
  SimulatedModbus device([](auto, auto) { return 1.0; }, {profile_of("adam-6017"), faults});
  ServedDevice served(device);
  auto patient = driver_of(toml_of("adam-6017", served.address(), channel("A", "AI0")));
  ASSERT_TRUE(patient->open());
  EXPECT_NEAR(one_scan(*patient).value[0][0], 1, 1e-3);
  auto hasty = driver_of(
      toml_of("adam-6017", served.address(), channel("A", "AI0"), "response_timeout_ms = 3\n"));
  const auto opened = hasty->open();
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("no complete reply within 3 ms"), std::string::npos)
      << opened.error().message;
}

TEST(ModbusDriver, BrokenConnectionIsAnErrorUntilReopened) {
  SimulatedModbus::Faults faults{Kind::hang_up, 6};
  SimulatedModbus device([](auto, auto) { return 5.0; }, {profile_of("pokeys57e"), faults});
  ServedDevice served(device);
  auto driver = driver_of(toml_of("pokeys57e", served.address(),
                                  channel("encoder", "encoder1", "um_per_count = 0.5\n")));
  SampleBlock block;
  int errors = 0, scans = 0;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(driver->open());
    for (int k = 0; k < 10; ++k) {
      const auto state = driver->read(block, milliseconds(500));
      if (!state) {
        EXPECT_NE(state.error().message.find("device \"device\" (PoKeys57E at 127.0.0.1"),
                  std::string::npos);
        ++errors;
        break;
      }
      scans += static_cast<int>(block.scans());
    }
    // Reads fail until the driver is opened again.
    EXPECT_FALSE(driver->read(block, milliseconds(1)));
  }
  EXPECT_EQ(errors, 3);
  EXPECT_GT(scans, 6);
}

TEST(ModbusDriver, UnwrapsThe32BitCountsOfAPoKeys) {
  std::atomic<double> counts = -2;
  SimulatedModbus device([&](std::size_t i, auto) { return i == 2 ? counts.load() : 7; },
                         {profile_of("pokeys57e"), {}});
  ServedDevice served(device);
  auto driver = driver_of(toml_of("pokeys57e", served.address(),
                                  channel("encoder", "encoder3", "um_per_count = -0.5\n")));
  ASSERT_TRUE(driver->open());
  EXPECT_EQ(one_scan(*driver).value[0][0], 1.0);
  counts = 70'000;
  EXPECT_EQ(one_scan(*driver).value[0][0], -35'000.0);
  counts = 2'147'483'000.0;
  one_scan(*driver);
  counts = 2'147'484'000.0;  // the device's count is negative now
  EXPECT_EQ(one_scan(*driver).value[0][0], -1'073'742'000.0);
}

// After the driver is opened again, it cannot know whether the device kept its power. An absolute
// scale does not need this check.
TEST(ModbusDriver, CountIsSuspectAfterAReopenUntilTrusted) {
  SimulatedModbus device([](auto, auto) { return 5.0; }, {profile_of("pokeys57e"), {}});
  ServedDevice served(device);
  auto driver = driver_of(toml_of("pokeys57e", served.address(),
                                  channel("encoder", "encoder1", "um_per_count = 0.5\n")));
  ASSERT_TRUE(driver->open());
  EXPECT_EQ(one_scan(*driver).quality_at(0, 0), Quality::good);
  EXPECT_EQ(driver->info().datum_lost, "");
  ASSERT_TRUE(driver->open());
  EXPECT_EQ(one_scan(*driver).quality_at(0, 0), Quality::suspect);
  EXPECT_NE(driver->info().datum_lost.find("was disconnected"), std::string::npos);
  EXPECT_EQ(driver->info().datum_remedy, Remedy::set_encoder);
  driver->trust_count();
  EXPECT_EQ(one_scan(*driver).quality_at(0, 0), Quality::good);
  EXPECT_EQ(driver->info().datum_lost, "");
}

struct Smax {
  explicit Smax(SimulatedModbus::Faults faults = {}, const std::string& more = "")
      : device([this](auto, auto) { return position.load(); },
               {profile_of("lika-smax"), std::move(faults)}),
        served(device),
        driver(driver_of(toml_of("lika-smax", served.address(), kPosition,
                                 "poll_ms = 2\nresponse_timeout_ms = 40\n" + more))) {}
  std::atomic<double> position = 1234;
  SimulatedModbus device;
  ServedDevice served;
  std::unique_ptr<Driver> driver;
};

TEST(ModbusDriver, ReadsMicrometresOfASmax) {
  Smax smax;
  const auto opened = smax.driver->open();
  ASSERT_TRUE(opened) << opened.error().message;
  const SampleBlock block = one_scan(*smax.driver);
  EXPECT_EQ(block.value[0][0], 123'400.0);
  EXPECT_EQ(block.quality_at(0, 0), Quality::good);
}

TEST(ModbusDriver, SmaxPositionMayBeNegative) {
  Smax smax({}, "ring_bits = 11\n");
  smax.position = 1;
  ASSERT_TRUE(smax.driver->open());
  EXPECT_EQ(one_scan(*smax.driver).value[0][0], 100.0);
  // At -3 counts a ring of 11 bits shows 2045. The simulated ring has 13 bits and shows 8189.
  smax.position = -3;
  EXPECT_EQ(one_scan(*smax.driver).value[0][0], -300.0);
}

// Calculated by hand: at -5 counts (-500 um) the ring of 13 bits shows 8187.
TEST(ModbusDriver, SmaxReopenedBelowZeroKeepsItsPosition) {
  Smax smax;
  smax.position = 5;
  ASSERT_TRUE(smax.driver->open());
  EXPECT_EQ(one_scan(*smax.driver).value[0][0], 500.0);
  smax.position = -5;
  EXPECT_EQ(one_scan(*smax.driver).value[0][0], -500.0);
  ASSERT_TRUE(smax.driver->open());
  EXPECT_EQ(one_scan(*smax.driver).value[0][0], -500.0);
  smax.position = -7;  // the axis moves while the driver is closed
  ASSERT_TRUE(smax.driver->open());
  EXPECT_EQ(one_scan(*smax.driver).value[0][0], -700.0);
}

TEST(ModbusDriver, SmaxAlarmsSetTheQuality) {
  struct Case {
    int address;
    std::uint16_t word;
    Quality quality;
  };
  for (const auto& [address, word, quality] :
       {Case{0, 0x0001, Quality::suspect}, Case{0, 0x0800, Quality::suspect},
        Case{0, 0x0004, Quality::missing}, Case{0, 0x0009, Quality::missing},
        Case{6, 0x0100, Quality::suspect}, Case{6, 0x0001, Quality::good}}) {
    SimulatedModbus::Faults faults;
    faults.words[{modbus::kReadInput, address}] = word;
    Smax smax(faults);
    ASSERT_TRUE(smax.driver->open());
    const SampleBlock block = one_scan(*smax.driver);
    EXPECT_EQ(block.quality_at(0, 0), quality) << address << " " << word;
    EXPECT_EQ(std::isnan(block.value[0][0]), quality == Quality::missing);
  }
}

TEST(ModbusDriver, NoisyRtuLineOnlyLosesScans) {
  for (const Kind kind : {Kind::bad_crc, Kind::silence, Kind::exception, Kind::foreign_traffic}) {
    Smax smax({kind, 7});
    ASSERT_TRUE(smax.driver->open());
    std::uint64_t lost = 0;
    for (int i = 0; i < 12; ++i) {
      const SampleBlock block = one_scan(*smax.driver);
      ASSERT_EQ(block.value[0][0], 123'400.0);
      lost += block.lost;
    }
    EXPECT_GT(lost, 0u) << static_cast<int>(kind);
  }
}

TEST(ModbusDriver, DeadRtuLineIsAnErrorAtOpening) {
  Smax smax({Kind::silence, 1}, "unit = 9\n");
  const auto opened = smax.driver->open();
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("unit 9: input registers 0-6: no complete reply within"),
            std::string::npos)
      << opened.error().message;
}

TEST(ModbusDriver, ReadReturnsInTimeBetweenPolls) {
  Smax smax({}, "");
  auto driver = driver_of(toml_of("lika-smax", smax.served.address(), kPosition,
                                  "poll_ms = 5000\nresponse_timeout_ms = 40\n"));
  ASSERT_TRUE(driver->open());
  SampleBlock block = one_scan(*driver);
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(driver->read(block, milliseconds(10)));
  EXPECT_EQ(block.scans(), 0u);
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(2000));
}

// The driver uses the slave side of a pseudo terminal, the device uses the other side. Then the
// adapter is unplugged. Each attempt to read now fails immediately, but the attempts must not load
// the CPU.
TEST(ModbusDriver, ReadsASmaxOnASerialLineUntilUnplugged) {
  auto plugged = std::make_unique<ByteStream>(::posix_openpt(O_RDWR | O_NOCTTY), "pty");
  ByteStream& master = *plugged;
  ASSERT_EQ(::grantpt(master.fd()), 0);
  ASSERT_EQ(::unlockpt(master.fd()), 0);
  std::array<char, 128> path{};
  ASSERT_EQ(::ptsname_r(master.fd(), path.data(), path.size()), 0);
  SimulatedModbus device([](auto, auto) { return 77.0; }, {profile_of("lika-smax"), {}});
  device.opened(0, 1, 0);
  std::atomic<bool> stop = false;
  std::thread serving([&] {
    std::array<char, 64> bytes;
    for (std::int64_t t_ns = 0; !stop; t_ns += 1'000'000) {
      const auto n = master.read(bytes, milliseconds(1));
      const auto reply = device.exchange(0, 1, {bytes.data(), n ? *n : 0}, t_ns);
      if (!reply.empty()) (void)master.write(reply, milliseconds(100));
    }
  });
  auto driver = driver_of("profile = \"lika-smax\"\nport = \"" + std::string(path.data()) +
                          "\"\nbaud = 115200\nparity = \"none\"\npoll_ms = 1\n" + kPosition);
  const auto opened = driver->open();
  EXPECT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened ? one_scan(*driver).value[0][0] : 0, 7'700.0);
  stop = true;
  serving.join();
  plugged.reset();
  SampleBlock block;
  const auto until = std::chrono::steady_clock::now() + milliseconds(600);
  const std::clock_t begin = std::clock();
  while (std::chrono::steady_clock::now() < until) (void)driver->read(block, milliseconds(100));
  EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 0.15);
}

std::string refusal(const std::string& toml) {
  const auto spec = configured(toml);
  return spec ? "accepted" : spec.error().message;
}

TEST(ModbusConfiguration, ReportsErrorsWithTheirKey) {
  const std::string smax = "profile = \"lika-smax\"\nport = \"/dev/ttyUSB0\"\n";
  EXPECT_EQ(refusal(smax + kPosition), "accepted");
  const auto says = [&](const std::string& toml, const std::string& part) {
    const std::string message = refusal(toml);
    EXPECT_NE(message.find(part), std::string::npos) << toml << " → " << message;
  };
  says(kPosition, "profile: is missing");
  says("profile = \"lika-smx\"\n" + kPosition, "did you mean \"lika-smax\"?");
  says("profile = \"mine.toml\"\n" + kPosition, "mine.toml: cannot be read: No such file");
  says("profile = \"lika-smax\"\n" + kPosition, "mdofd.toml:1: port: give either \"port\"");
  says(smax + "address = \"box\"\n" + kPosition, "mdofd.toml:2: port: give either \"port\"");
  says("profile = \"adam-6017\"\n" + channel("A", "AI0"), "address: is missing");
  says("profile = \"adam-6017\"\naddress = \"a:b\"\n" + channel("A", "AI0"), "is not an address");
  says(smax + "baud = 0\n" + kPosition, "mdofd.toml:3: baud");
  says(smax + "parity = \"mark\"\n" + kPosition,
       "mdofd.toml:3: parity: must be \"none\", \"even\" or \"odd\"");
  says(smax + "stop_bits = 3\n" + kPosition, "mdofd.toml:3: stop_bits");
  says(smax + "unit = 250\n" + kPosition, "mdofd.toml:3: unit");
  says(smax + "poll_ms = 0\n" + kPosition, "mdofd.toml:3: poll_ms");
  says(smax + "response_timeout_ms = nan\n" + kPosition, "response_timeout_ms");
  says(smax + "ring_bits = 17\n" + kPosition, "mdofd.toml:3: ring_bits");
  says(smax + "pol_ms = 5\n" + kPosition, "poll_ms");
  says(smax + channel("encoder", "positon"),
       "the device has no input \"positon\"; the inputs of the device are position");
  says("profile = \"pokeys57e\"\naddress = \"box\"\n" + channel("encoder", "encoder1"),
       "a counting encoder needs um_per_count");
  says("profile = \"adam-6017\"\naddress = \"box\"\n" + channel("A", "AI0", "um_per_count = 1\n"),
       "um_per_count applies to counts, but the value \"AI0\" is in V");
  says("profile = \"adam-6017\"\naddress = \"box\"\nring_bits = 3\n" + channel("A", "AI0"),
       "profile Advantech ADAM-6017 has no value with ring_bits");
}

}  // namespace
}  // namespace mdof::drivers
