#include "tools/mdof_simulate/kinds.h"

#include "drivers/registry.h"

namespace mdof::simulate {
namespace {

const drivers::SimulatedKind* find_kind(const std::string& name) {
  const drivers::DriverRow* row = drivers::find_driver(name);
  return row && row->simulated ? &*row->simulated : nullptr;
}

std::string known_kinds() {
  std::string known;
  for (const drivers::DriverRow& row : drivers::driver_rows())
    if (row.simulated) known += std::string(" ") + row.name;
  return known;
}

void check_inputs(TomlTable& table, const std::vector<std::string>& inputs, std::size_t most_inputs,
                  const Rig& rig) {
  if (inputs.size() > most_inputs)
    table.reject("inputs", "the list has more entries than the device has inputs (" +
                               std::to_string(most_inputs) + ")");
  for (const auto& input : inputs) {
    if (!input.empty() && input != kEncoderChannel && !rig.probe_index(input))
      table.reject("inputs",
                   "\"" + input + "\" is neither a probe of " + rig.source + " nor \"encoder\"");
  }
}

}  // namespace

Result<std::unique_ptr<drivers::SimulatedDevice>> make_device(
    const std::string& name, const Wiring& wiring, const std::vector<std::string>& inputs,
    TomlTable& table) {
  const drivers::SimulatedKind* kind = find_kind(name);
  if (!kind) {
    table.reject("kind", "\"" + name + "\" is not a known kind; known kinds:" + known_kinds());
    MDOF_CHECK(table.finish());
    return bad_input("unknown kind");
  }
  check_inputs(table, inputs, kind->most_inputs, wiring.rig);
  const drivers::SimulatedWiring::Machine machine =
      [&wiring](std::vector<drivers::SensedInput> sensed) {
        return senses(wiring.machine, std::move(sensed));
      };
  drivers::SimulatedWiring wired(wiring.rig, wiring.folder, machine, inputs, table);
  auto device = kind->make(wired);
  MDOF_CHECK(table.finish());
  return device;
}

}  // namespace mdof::simulate
