#include "tools/mdof_simulate/plan.h"

#include "daemon/measure/forward_model.h"
#include "drivers/simulator/options.h"
#include "schema/base/files.h"
#include "schema/base/toml/toml_reader.h"
#include "tools/mdof_simulate/kinds.h"

namespace mdof::simulate {
namespace {

Result<Served> read_device(TomlTable& table, const Wiring& wiring) {
  Served served;
  served.name = table.string("name");
  const std::string kind = table.string("kind");
  for (const double port : table.numbers("ports", std::vector<double>{})) {
    if (!(port >= 0 && port <= 65535)) table.reject("ports", "must be from 0 to 65535");
    served.tcp_ports.push_back(static_cast<int>(port));
  }
  served.clock_ppm = table.number("clock_ppm", 0);
  served.jitter_ms = table.number("jitter_ms", 0);
  served.seed = table.integer("seed", 1);
  const auto inputs = table.strings("inputs");
  const std::string bus = table.string("bus", "usb");
  served.uhid = bus == "uhid";
  if (!served.uhid && bus != "usb") table.reject("bus", "must be \"usb\" or \"uhid\"");
  MDOF_TRY(served.device, make_device(kind, wiring, inputs, table));
  return served;
}

// Error: the plan contains a key that has an effect only in the driver `simulator`. In
// mdof-simulate the machine moves without end, and each device has its own rate and faults.
void refuse_keys_of_driver(TomlTable& machine) {
  for (const char* key : {"repeats", "loop", "rate_hz", "packet_ms", "pace", "gap", "disconnect"})
    if (machine.has(key))
      machine.reject(key,
                     "has no effect in mdof-simulate, because this key belongs to the driver "
                     "simulator; remove this key");
}

}  // namespace

Result<std::vector<Served>> load_plan(const std::filesystem::path& file) {
  MDOF_TRY(const std::string text, read_text_file(file));
  MDOF_TRY(auto root, TomlTable::parse(text, file.string()));
  Wiring wiring;
  wiring.folder = std::filesystem::absolute(file).parent_path();
  const std::string rig = root.string("rig");
  if (!rig.empty()) {
    MDOF_TRY(wiring.rig, load_rig(wiring.folder / rig));
  }
  drivers::SimulatorOptions options;
  if (auto machine = root.table("machine")) {
    refuse_keys_of_driver(*machine);
    MDOF_CHECK(drivers::read_options(*machine, options));
  }
  MDOF_CHECK(drivers::fit_to_rig(options, wiring.rig));
  MDOF_TRY(auto forward, daemon::forward_model(wiring.rig));
  wiring.machine = std::make_shared<SensedMachine>(wiring.rig, options, std::move(forward));
  std::vector<Served> devices;
  for (auto& table : root.tables("device")) {
    MDOF_TRY(Served served, read_device(table, wiring));
    devices.push_back(std::move(served));
  }
  if (devices.empty())
    root.reject("device", "missing [[device]] table; add [[device]] with \"name\" and \"kind\"");
  MDOF_CHECK(root.finish());
  return devices;
}

}  // namespace mdof::simulate
