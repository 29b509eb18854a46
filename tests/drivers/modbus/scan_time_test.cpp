// The time of a scan that needs several requests.
#include <gtest/gtest.h>

#include <atomic>

#include "drivers/clock/monotonic.h"
#include "drivers/modbus/simulated_modbus.h"
#include "drivers/registry.h"
#include "tests/drivers/served_device.h"

namespace mdof::drivers {
namespace {

// AI0, AI2 and AI4 need a request each, and each reply takes 100 ms.
TEST(ModbusScan, HasTheTimeOfItsLastRequest) {
  std::atomic<std::int64_t> last_request_ns = 0;
  SimulatedModbus device(
      [&](std::size_t, std::int64_t) {
        last_request_ns = monotonic_ns();
        return 1.0;
      },
      {modbus::load_profile("adam-6017", ".").value(), {.delay_ms = 100}});
  ServedDevice served(device);
  std::string toml =
      "profile = \"adam-6017\"\naddress = \"" + served.address() + "\"\npoll_ms = 2\n";
  Rig rig;
  rig.source = "rig.toml";
  for (const auto& [id, input] : {std::pair("A", "AI0"), {"B", "AI2"}, {"C", "AI4"}}) {
    toml += "[[channel]]\nid = \"" + std::string(id) + "\"\ninput = \"" + input + "\"\n";
    Probe probe;
    probe.id = id;
    rig.probes.push_back(probe);
  }
  TomlTable table = TomlTable::parse(toml, "mdofd.toml").value();
  const auto spec = configure_driver("modbus", table, {"device", rig, {}, "."});
  ASSERT_TRUE(spec) << spec.error().message;
  const auto driver = spec->make().value();
  ASSERT_TRUE(driver->open());
  SampleBlock block;
  for (int i = 0; i < 20 && block.scans() == 0; ++i)
    ASSERT_TRUE(driver->read(block, std::chrono::milliseconds(500)));
  EXPECT_GE(block.time_ns.at(0), last_request_ns);
  EXPECT_LE(block.time_ns.at(0), monotonic_ns());
}

}  // namespace
}  // namespace mdof::drivers
