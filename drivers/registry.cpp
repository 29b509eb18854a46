#include "drivers/registry.h"

#include <filesystem>

#include "drivers/capancdt/configure.h"
#include "drivers/csv/csv_log.h"
#include "drivers/csv_stream/configure.h"
#include "drivers/labjack_t7/configure.h"
#include "drivers/labjack_u6/configure.h"
#include "drivers/linux_comedi/configure.h"
#include "drivers/linux_counter/configure.h"
#include "drivers/linux_iio/configure.h"
#include "drivers/locked_driver.h"
#include "drivers/mcc_usb1608fs_plus/configure.h"
#include "drivers/modbus/configure.h"
#include "drivers/pokeys57u/configure.h"
#include "drivers/qsb/configure.h"
#include "drivers/recording/recording_log.h"
#include "drivers/simulator/simulator.h"

namespace mdof::drivers {
namespace {

template <class Log>
SourceInfo info_of(const Driver& driver) {
  const auto& log = static_cast<const Log&>(driver);
  return {log.sha256(), log.warnings()};
}

Result<DriverSpec> configure_simulator(TomlTable& table, const DriverContext& context) {
  SimulatorOptions options;
  MDOF_CHECK(read_options(table, options));
  DriverSpec spec;
  spec.driver = "simulator";
  spec.name = context.name;
  spec.live = options.real_time;
  spec.simulated = true;
  spec.make = [context, options]() -> Result<std::unique_ptr<Driver>> {
    MDOF_TRY(auto simulator, Simulator::make(context.name, context.rig, options, context.forward));
    return std::unique_ptr<Driver>(std::move(simulator));
  };
  spec.source_info = [](const Driver&) { return SourceInfo{}; };
  MDOF_TRY(const auto tried, spec.make());  // what only shows against the rig, said at start-up
  return spec;
}

Result<DriverSpec> configure_replay(TomlTable& table, const DriverContext& context) {
  const std::string file = table.string("file");
  MDOF_CHECK(table.finish());
  const auto path = std::filesystem::path(context.base_path) / file;
  std::error_code ec;  // not even to be looked at: the same to the user
  if (!std::filesystem::is_regular_file(path, ec)) {
    return bad_input(table.where("file") + ": " + path.string() + " is no file that can be read");
  }
  return log_driver(context.name, path.string());
}

struct Row {
  const char* name;
  Result<DriverSpec> (*configure)(TomlTable&, const DriverContext&);
};
// A new driver: one row.
constexpr Row kDrivers[] = {
    {"capancdt", configure_capancdt},
    {"csv_stream", configure_csv_stream},
    {"labjack_t7", configure_labjack_t7},
    {"labjack_u6", configure_labjack_u6},
    {"linux_comedi", configure_linux_comedi},
    {"linux_counter", configure_linux_counter},
    {"linux_iio", configure_linux_iio},
    {"mcc_usb1608fs_plus", configure_mcc_usb1608fs_plus},
    {"modbus", configure_modbus},
    {"pokeys57u", configure_pokeys57u},
    {"qsb", configure_qsb},
    {"replay", configure_replay},
    {"simulator", configure_simulator},
};

}  // namespace

DriverSpec log_driver(const std::string& name, const std::string& path) {
  DriverSpec spec;
  spec.driver = "replay";
  spec.name = name;
  spec.live = false;
  spec.recorded = false;
  spec.source_path = std::filesystem::absolute(path).string();
  if (is_recording(path)) {
    spec.make = [name, path]() -> Result<std::unique_ptr<Driver>> {
      return std::make_unique<RecordingLog>(name, path);
    };
    spec.source_info = info_of<RecordingLog>;
  } else {
    spec.make = [path]() -> Result<std::unique_ptr<Driver>> {
      return std::make_unique<CsvLog>(path);
    };
    spec.source_info = info_of<CsvLog>;
  }
  return spec;
}

std::vector<std::string> known_drivers() {
  std::vector<std::string> names;
  for (const Row& row : kDrivers) names.emplace_back(row.name);
  return names;
}

Result<DriverSpec> configure_driver(const std::string& driver, TomlTable& table,
                                    const DriverContext& context) {
  std::string known;
  for (const Row& row : kDrivers) {
    if (driver == row.name) {
      MDOF_TRY(DriverSpec spec, row.configure(table, context));
      return locked(std::move(spec));
    }
    known += std::string(" ") + row.name;
  }
  table.reject("driver", "\"" + driver + "\" is no driver; known are:" + known);
  MDOF_CHECK(table.finish());
  return bad_input("unknown driver " + driver);
}

}  // namespace mdof::drivers
