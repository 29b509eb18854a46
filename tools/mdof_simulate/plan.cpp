#include "tools/mdof_simulate/plan.h"

#include "daemon/forward_model.h"
#include "drivers/capancdt/device.h"
#include "drivers/labjack_t7/device.h"
#include "drivers/pokeys57u/device.h"
#include "drivers/simulator/options.h"
#include "schema/files.h"
#include "schema/toml_reader.h"
#include "tools/mdof_simulate/sensed.h"

namespace mdof::simulate {
namespace {

struct Wiring {
  Rig rig;
  std::shared_ptr<SensedMachine> machine;
};

// One of them.
struct Made {
  std::unique_ptr<drivers::SimulatedDevice> device;
  std::unique_ptr<drivers::usb::SimulatedUsb> usb;
};
using Device = Result<Made>;

double um_per_count(TomlTable& table) {
  const double um = table.number("um_per_count", 0.05);
  if (um == 0) table.reject("um_per_count", "must not be zero");
  return um;
}

// µm as they are; a range that the controller tells.
Device make_capancdt(const Wiring& wiring, const std::vector<std::string>& inputs, TomlTable&) {
  namespace family = drivers::capancdt;
  family::DeviceOptions options;
  options.inputs.assign(inputs.size(), {});
  std::vector<Input> wires;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    wires.push_back({inputs[i], 1, 0});
    const auto probe = wiring.rig.probe_index(inputs[i]);
    options.inputs[i].present = probe.has_value();
    if (probe) options.inputs[i].range_um = wiring.rig.probes[*probe].range_m * 1e6;
  }
  return Made{std::make_unique<family::SimulatedCapancdt>(std::move(options),
                                                          senses(wiring.machine, std::move(wires))),
              {}};
}

// Volts of the amplifiers, and counts of the encoder on DIO0 and DIO1.
Device make_labjack_t7(const Wiring& wiring, const std::vector<std::string>& inputs,
                       TomlTable& table) {
  namespace family = drivers::labjack_t7;
  std::vector<Input> wires(family::Device::kCounterInput + 1);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto probe = wiring.rig.probe_index(inputs[i]);
    if (!probe) continue;
    const auto um_per_V = wiring.rig.probes[*probe].calibration.um_per_V;
    if (!um_per_V) {
      table.reject("inputs", "probe \"" + inputs[i] + "\" of " + wiring.rig.source +
                                 " needs um_per_V to be seen as volts");
      break;
    }
    wires[i] = {inputs[i], 1 / *um_per_V, 0};
  }
  wires[family::Device::kCounterInput] = {kEncoderChannel, 1 / um_per_count(table), 0};
  return Made{std::make_unique<family::Device>(senses(wiring.machine, std::move(wires)),
                                               family::Device::Options{}),
              {}};
}

// Counts: of the machine's encoder at the first input, where none is given.
Device make_pokeys57u(const Wiring& wiring, const std::vector<std::string>& inputs,
                      TomlTable& table) {
  namespace family = drivers::pokeys57u;
  family::Device::Options options;
  options.serial = static_cast<std::uint32_t>(table.integer("serial", options.serial));
  std::vector<Input> wires;
  const double per_um = 1 / um_per_count(table);
  for (const std::string& input : inputs) wires.push_back({input, per_um, 0});
  if (inputs.empty()) wires.push_back({kEncoderChannel, per_um, 0});
  return Made{{},
              std::make_unique<family::Device>(senses(wiring.machine, std::move(wires)), options)};
}

struct Kind {
  const char* name;
  std::size_t most_inputs;
  Device (*make)(const Wiring&, const std::vector<std::string>&, TomlTable&);
};
// A new simulated device: one row.
constexpr Kind kKinds[] = {
    {"capancdt", 32, make_capancdt},
    {"labjack_t7", 14, make_labjack_t7},
    {"pokeys57u", drivers::pokeys57u::kEncoders, make_pokeys57u},
};

const Kind* find_kind(const std::string& name) {
  for (const Kind& kind : kKinds)
    if (name == kind.name) return &kind;
  return nullptr;
}

Status check_inputs(TomlTable& table, const std::vector<std::string>& inputs, const Kind& kind,
                    const Rig& rig) {
  if (inputs.size() > kind.most_inputs)
    table.reject("inputs", "has more than " + std::to_string(kind.most_inputs) + " inputs");
  for (const auto& input : inputs) {
    if (!input.empty() && input != kEncoderChannel && !rig.probe_index(input))
      table.reject("inputs", "\"" + input + "\" is no probe of " + rig.source);
  }
  return {};
}

Result<Served> read_device(TomlTable& table, const Wiring& wiring) {
  Served served;
  served.name = table.string("name");
  const std::string name = table.string("kind");
  const Kind* kind = find_kind(name);
  if (!kind) {
    std::string known;
    for (const Kind& k : kKinds) known += std::string(" ") + k.name;
    table.reject("kind", "\"" + name + "\" is none; known are:" + known);
    MDOF_CHECK(table.finish());
    return bad_input("unknown kind");
  }
  for (const double port : table.numbers("ports", std::vector<double>{})) {
    if (!(port >= 0 && port <= 65535)) table.reject("ports", "must be from 0 to 65535");
    served.tcp_ports.push_back(static_cast<int>(port));
  }
  served.clock_ppm = table.number("clock_ppm", 0);
  served.jitter_ms = table.number("jitter_ms", 0);
  served.seed = table.integer("seed", 1);
  const auto inputs = table.strings("inputs");
  MDOF_CHECK(check_inputs(table, inputs, *kind, wiring.rig));
  const std::string bus = table.string("bus", "usb");
  served.uhid = bus == "uhid";
  if (!served.uhid && bus != "usb") table.reject("bus", "must be \"usb\" or \"uhid\"");
  MDOF_TRY(Made made, kind->make(wiring, inputs, table));
  served.device = std::move(made.device);
  served.usb = std::move(made.usb);
  return served;
}

}  // namespace

Result<std::vector<Served>> load_plan(const std::filesystem::path& file) {
  MDOF_TRY(const std::string text, read_text_file(file));
  MDOF_TRY(auto root, TomlTable::parse(text, file.string()));
  Wiring wiring;
  const std::string rig = root.string("rig");
  if (!rig.empty()) {
    MDOF_TRY(wiring.rig, load_rig(std::filesystem::absolute(file).parent_path() / rig));
  }
  drivers::SimulatorOptions options;
  if (auto machine = root.table("machine")) MDOF_CHECK(drivers::read_options(*machine, options));
  MDOF_CHECK(drivers::fit_to_rig(options, wiring.rig));
  MDOF_TRY(auto forward, daemon::forward_model(wiring.rig));
  wiring.machine = std::make_shared<SensedMachine>(wiring.rig, options, std::move(forward));
  std::vector<Served> devices;
  for (auto& table : root.tables("device")) {
    MDOF_TRY(Served served, read_device(table, wiring));
    devices.push_back(std::move(served));
  }
  if (devices.empty()) root.reject("device", "is missing; add [[device]] with name and kind");
  MDOF_CHECK(root.finish());
  return devices;
}

}  // namespace mdof::simulate
