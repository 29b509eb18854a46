#include "drivers/simulator/configure.h"

#include <memory>
#include <utility>

#include "drivers/simulator/simulator.h"

namespace mdof::drivers {

Result<DriverSpec> configure_simulator(TomlTable& table, const DriverContext& context) {
  SimulatorOptions options;
  MDOF_CHECK(read_options(table, options));
  DriverSpec spec;
  spec.live = options.real_time;
  spec.simulated = true;
  spec.make = [context, options]() -> Result<std::unique_ptr<Driver>> {
    MDOF_TRY(auto simulator, Simulator::make(context.name, context.rig, options, context.forward));
    return std::unique_ptr<Driver>(std::move(simulator));
  };
  // Finds errors of the options for this rig already at the start.
  MDOF_TRY(const auto tried, spec.make());
  return spec;
}

}  // namespace mdof::drivers
