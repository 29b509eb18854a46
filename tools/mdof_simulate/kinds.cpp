#include "tools/mdof_simulate/kinds.h"

#include "drivers/capancdt/device.h"
#include "drivers/csv_stream/device.h"
#include "drivers/labjack_t7/device.h"
#include "drivers/labjack_u6/device.h"
#include "drivers/mcc_usb1608fs_plus/device.h"
#include "drivers/modbus/device.h"
#include "drivers/pokeys57u/device.h"
#include "drivers/qsb/device.h"
#include "tools/mdof_simulate/sensed_tree.h"

namespace mdof::simulate {
namespace {

using Device = Result<Made>;
using Inputs = std::vector<std::string>;

template <class Simulated>
Made made(std::unique_ptr<Simulated> simulated) {
  if constexpr (std::is_base_of_v<drivers::usb::SimulatedUsb, Simulated>) {
    return {nullptr, std::move(simulated)};
  } else {
    return {std::move(simulated), nullptr};
  }
}

// Channels of the rig as a device gives them.
class Wires {
 public:
  Wires(const Wiring& wiring, TomlTable& table) : wiring_(wiring), table_(table) {}

  Input um(const std::string& channel) const { return {channel, 1, 0}; }
  // Behind an amplifier, as the rig's calibration has it.
  Input volt(const std::string& channel) {
    const auto probe = wiring_.rig.probe_index(channel);
    if (!probe) return {};
    const auto um_per_V = wiring_.rig.probes[*probe].calibration.um_per_V;
    if (!um_per_V)
      table_.reject("inputs", "probe \"" + channel + "\" of " + wiring_.rig.source +
                                  " needs um_per_V to be seen as volts");
    return {channel, 1 / um_per_V.value_or(1), 0};
  }
  Input counts(const std::string& channel) {
    if (um_per_count_ == 0) um_per_count_ = table_.number("um_per_count", 0.05);
    if (um_per_count_ == 0) table_.reject("um_per_count", "must not be zero");
    return {channel, 1 / um_per_count_, 0};
  }
  drivers::Senses senses(std::vector<Input> inputs) const {
    return simulate::senses(wiring_.machine, std::move(inputs));
  }
  const Wiring& wiring() const { return wiring_; }
  TomlTable& table() { return table_; }

 private:
  const Wiring& wiring_;
  TomlTable& table_;
  double um_per_count_ = 0;
};

// µm as they are; a range that the controller tells.
Device make_capancdt(Wires& wires, const Inputs& inputs) {
  namespace family = drivers::capancdt;
  family::DeviceOptions options;
  options.inputs.assign(inputs.size(), {});
  std::vector<Input> sensed;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    sensed.push_back(wires.um(inputs[i]));
    const auto& rig = wires.wiring().rig;
    const auto probe = rig.probe_index(inputs[i]);
    options.inputs[i].present = probe.has_value();
    if (probe) options.inputs[i].range_um = rig.probes[*probe].range_m * 1e6;
  }
  return made(std::make_unique<family::SimulatedCapancdt>(std::move(options),
                                                          wires.senses(std::move(sensed))));
}

// "time_s,encoder_mm,A_um,..." at rate_hz.
Device make_csv_stream(Wires& wires, const Inputs& inputs) {
  std::vector<std::string> columns;
  std::vector<Input> sensed;
  for (const std::string& input : inputs) {
    const bool encoder = input == kEncoderChannel;
    columns.push_back(input + (encoder ? "_mm" : "_um"));
    sensed.push_back({input, encoder ? 1e-3 : 1, 0});
  }
  const double rate_hz = wires.table().number("rate_hz", 1000);
  if (!(rate_hz > 0 && rate_hz <= 1e5)) wires.table().reject("rate_hz", "must be up to 100000");
  const bool with_time = wires.table().boolean("with_time", true);
  return made(std::make_unique<drivers::CsvStreamDevice>(std::move(columns), rate_hz, with_time,
                                                         wires.senses(std::move(sensed))));
}

// Volts of the amplifiers, and counts of the encoder on DIO0 and DIO1.
Device make_labjack_t7(Wires& wires, const Inputs& inputs) {
  namespace family = drivers::labjack_t7;
  std::vector<Input> sensed(family::Device::kCounterInput + 1);
  for (std::size_t i = 0; i < inputs.size(); ++i) sensed[i] = wires.volt(inputs[i]);
  sensed[family::Device::kCounterInput] = wires.counts(kEncoderChannel);
  return made(
      std::make_unique<family::Device>(wires.senses(std::move(sensed)), family::Device::Options{}));
}

// The same of a U6: AIN0 ..., and timers 0 and 1.
Device make_labjack_u6(Wires& wires, const Inputs& inputs) {
  namespace family = drivers::labjack_u6;
  std::vector<Input> sensed(family::Device::kCounterInput + 1);
  for (std::size_t i = 0; i < inputs.size(); ++i) sensed[i] = wires.volt(inputs[i]);
  sensed[family::Device::kCounterInput] = wires.counts(kEncoderChannel);
  return made(std::make_unique<family::Device>(wires.senses(std::move(sensed)), family::Faults{}));
}

// Volts at eight inputs.
Device make_mcc_usb1608fs_plus(Wires& wires, const Inputs& inputs) {
  namespace family = drivers::mcc_usb1608fs_plus;
  std::vector<Input> sensed;
  for (const std::string& input : inputs) sensed.push_back(wires.volt(input));
  return made(std::make_unique<family::Device>(wires.senses(std::move(sensed)), family::Faults{}));
}

// Counts: of the machine's encoder at the first input, where none is given.
Device make_pokeys57u(Wires& wires, const Inputs& inputs) {
  namespace family = drivers::pokeys57u;
  family::Device::Options options;
  options.serial = static_cast<std::uint32_t>(wires.table().integer("serial", options.serial));
  std::vector<Input> sensed;
  for (const std::string& input : inputs) sensed.push_back(wires.counts(input));
  if (inputs.empty()) sensed.push_back(wires.counts(kEncoderChannel));
  return made(std::make_unique<family::Device>(wires.senses(std::move(sensed)), options));
}

// The values of a profile in its order, each in its unit.
Device make_modbus(Wires& wires, const Inputs& inputs) {
  MDOF_TRY(auto profile,
           drivers::modbus::load_profile(wires.table().string("profile"), wires.wiring().folder));
  if (inputs.size() > profile.values.size())
    wires.table().reject("inputs", "are more than the " + std::to_string(profile.values.size()) +
                                       " values of the profile");
  std::vector<Input> sensed;
  for (std::size_t i = 0; i < std::min(inputs.size(), profile.values.size()); ++i) {
    const Unit unit = profile.values[i].unit;
    sensed.push_back(unit == Unit::volt ? wires.volt(inputs[i])
                     : unit == Unit::um ? wires.um(inputs[i])
                                        : wires.counts(inputs[i]));
  }
  return made(
      std::make_unique<drivers::ModbusDevice>(std::move(profile), wires.senses(std::move(sensed))));
}

Device make_qsb(Wires& wires, const Inputs& inputs) {
  return made(std::make_unique<drivers::QsbDevice>(
      wires.senses({wires.counts(inputs.empty() ? kEncoderChannel : inputs[0])})));
}

Device make_linux_counter(Wires& wires, const Inputs& inputs) {
  const auto folder = wires.wiring().folder / wires.table().string("sysfs_root");
  const Input counts = wires.counts(inputs.empty() ? kEncoderChannel : inputs[0]);
  MDOF_TRY(auto counter, SensedCounter::make(folder, wires.senses({counts})));
  return made(std::move(counter));
}

// Gaps in µm before electrodes of area_mm2.
Device make_linux_iio(Wires& wires, const Inputs& inputs) {
  const auto folder = wires.wiring().folder / wires.table().string("sysfs_root");
  const double area_mm2 = wires.table().number("area_mm2");
  std::vector<Input> sensed;
  for (const std::string& input : inputs) sensed.push_back(wires.um(input));
  MDOF_TRY(auto converter,
           SensedConverter::make(folder, area_mm2, inputs.size(), wires.senses(std::move(sensed))));
  return made(std::move(converter));
}

struct Kind {
  const char* name;
  std::size_t most_inputs;
  Device (*make)(Wires&, const Inputs&);
};
// A new simulated device: one row.
constexpr Kind kKinds[] = {
    {"capancdt", 32, make_capancdt},
    {"csv_stream", 64, make_csv_stream},
    {"labjack_t7", 14, make_labjack_t7},
    {"labjack_u6", drivers::labjack_u6::kAins, make_labjack_u6},
    {"linux_counter", 1, make_linux_counter},
    {"linux_iio", 2, make_linux_iio},
    {"mcc_usb1608fs_plus", drivers::mcc_usb1608fs_plus::kInputs, make_mcc_usb1608fs_plus},
    {"modbus", 64, make_modbus},
    {"pokeys57u", drivers::pokeys57u::kEncoders, make_pokeys57u},
    {"qsb", 1, make_qsb},
};

const Kind* find_kind(const std::string& name) {
  for (const Kind& kind : kKinds)
    if (name == kind.name) return &kind;
  return nullptr;
}

void check_inputs(TomlTable& table, const Inputs& inputs, const Kind& kind, const Rig& rig) {
  if (inputs.size() > kind.most_inputs)
    table.reject("inputs", "are more than " + std::to_string(kind.most_inputs));
  for (const auto& input : inputs) {
    if (!input.empty() && input != kEncoderChannel && !rig.probe_index(input))
      table.reject("inputs",
                   "\"" + input + "\" is neither a probe of " + rig.source + " nor \"encoder\"");
  }
}

}  // namespace

Device make_device(const std::string& name, const Wiring& wiring, const Inputs& inputs,
                   TomlTable& table) {
  const Kind* kind = find_kind(name);
  if (!kind) {
    std::string known;
    for (const Kind& k : kKinds) known += std::string(" ") + k.name;
    table.reject("kind", "\"" + name + "\" is none; known are:" + known);
    MDOF_CHECK(table.finish());
    return bad_input("unknown kind");
  }
  check_inputs(table, inputs, *kind, wiring.rig);
  Wires wires(wiring, table);
  auto device = kind->make(wires, inputs);
  MDOF_CHECK(table.finish());
  return device;
}

}  // namespace mdof::simulate
