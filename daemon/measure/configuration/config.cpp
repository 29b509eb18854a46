#include "daemon/measure/configuration/config.h"

#include <grp.h>
#include <sys/un.h>

#include <algorithm>
#include <set>

#include "daemon/measure/configuration/same_device.h"
#include "daemon/measure/configuration/slow_channels.h"
#include "daemon/measure/configuration/sources.h"
#include "daemon/measure/forward_model.h"
#include "daemon/measure/replay/replay.h"
#include "daemon/paths.h"
#include "drivers/calibration.h"
#include "drivers/registry.h"
#include "schema/base/files.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

Status read_store(TomlTable& root, Config& config) {
  config.database_key = config.source + ": default of store.database";
  config.recordings_key = config.source + ": default of store.recordings";
  auto table = root.table("store");
  if (table) {
    if (table->has("database")) config.database_key = table->where("database");
    if (table->has("recordings")) config.recordings_key = table->where("recordings");
    config.database = table->string("database", "");
    config.recordings = table->string("recordings", "");
    const std::string durability = table->string("durability", "full");
    if (durability == "normal") {
      config.durability = store::Durability::normal;
    } else if (durability != "full") {
      table->reject("durability",
                    "must be \"full\" (stored data survive a power cut) or \"normal\" (a power cut "
                    "can lose the newest data)");
    }
    const auto interval_ms = table->integer("commit_interval_ms", 50);
    if (interval_ms < 1 || interval_ms > 10000) {
      table->reject("commit_interval_ms", "must be from 1 to 10000");
    }
    config.commit_interval = std::chrono::milliseconds(interval_ms);
  }
  if (config.database.empty()) {
    MDOF_TRY(config.database, default_database());
  }
  if (config.recordings.empty()) config.recordings = config.database.parent_path() / "recordings";
  return {};
}

// The id of the group that the key names. The group must exist on this computer.
std::optional<gid_t> group_of(TomlTable& table, const char* key) {
  if (!table.has(key)) return std::nullopt;
  const std::string name = table.string(key);
  const struct group* entry = ::getgrnam(name.c_str());
  if (entry != nullptr) return entry->gr_gid;
  table.reject(key, "this computer has no group \"" + name +
                        "\"; create this group (sudo groupadd " + name + ") or give another group");
  return std::nullopt;
}

std::int64_t read_within(TomlTable& table, const char* key, std::int64_t fallback,
                         std::int64_t least, std::int64_t most) {
  const std::int64_t x = table.integer(key, fallback);
  if (x >= least && x <= most) return x;
  table.reject(key, "must be from " + std::to_string(least) + " to " + std::to_string(most));
  return fallback;
}

void read_access(TomlTable& table, RpcAccess& access) {
  constexpr std::int64_t kMostConnections = 1024, kDay_s = 86400;
  const auto count = [&](const char* key, std::size_t fallback, std::int64_t least) {
    return static_cast<std::size_t>(
        read_within(table, key, static_cast<std::int64_t>(fallback), least, kMostConnections));
  };
  access.connections = count("connections", access.connections, 2);
  access.connections_of_user = count("connections_of_user", access.connections_of_user, 1);
  access.idle =
      std::chrono::seconds(read_within(table, "idle_timeout_s", access.idle.count(), 0, kDay_s));
  access.cnc_group = group_of(table, "cnc_group");
  access.approve_group = group_of(table, "approve_group");
  access.approvers = table.string("approve_group", "");
}

void read_rpc(TomlTable& root, Config& config) {
  config.socket = default_socket();
  config.socket_key = config.source + ": default of rpc.socket";
  auto table = root.table("rpc");
  if (!table) return;
  if (table->has("socket")) config.socket_key = table->where("socket");
  config.socket = table->string("socket", config.socket);
  constexpr std::size_t kLongest = sizeof(sockaddr_un::sun_path) - 1;
  if (config.socket.size() > kLongest)
    table->reject("socket", "the path has " + std::to_string(config.socket.size()) +
                                " bytes (limit " + std::to_string(kLongest) +
                                "); choose a shorter path");
  read_access(*table, config.access);
  if (!table->has("tcp_port")) return;
  const auto port = table->integer("tcp_port");
  if (port < 1 || port > 65535) table->reject("tcp_port", "must be from 1 to 65535");
  config.tcp_port = static_cast<std::uint16_t>(port);
}

// Returns whether [measure] has the key max_gap_s.
bool read_measure(TomlTable& root, PipelineOptions& m) {
  auto table = root.table("measure");
  if (!table) return false;
  const std::string model = table->string("model", to_string(m.model));
  if (!model_from(model, m.model)) {
    table->reject("model", "must be \"simplified\", \"exact\" or \"rigid\"");
  }
  const auto positive = [&](const char* key, double fallback) {
    const double x = table->number(key, fallback);
    if (x < 0) table->reject(key, "must not be negative");
    return x;
  };
  m.dwell.tolerance_m = from_um(positive("tolerance_um", to_um(m.dwell.tolerance_m)));
  m.dwell.settle_s = positive("settle_s", m.dwell.settle_s);
  m.dwell.min_length_s = positive("min_length_s", m.dwell.min_length_s);
  m.dwell.approach_m = from_um(positive("approach_um", to_um(m.dwell.approach_m)));
  m.dwell.max_speed_m_s = from_mm(positive("max_speed_mm_s", to_mm(m.dwell.max_speed_m_s)));
  if (!(m.dwell.max_speed_m_s > 0)) table->reject("max_speed_mm_s", "must be more than 0");
  m.align.lag_bound_s = positive("lag_bound_s", m.align.lag_bound_s);
  m.align.max_gap_s = positive("max_gap_s", m.align.max_gap_s);
  m.stale_s = positive("stale_s", m.stale_s);
  return table->has("max_gap_s");
}

// Error: the model cannot solve the rig. With this check, mdofd reports the error at its start, and
// not at the first run.
Result<Rig> read_rig(TomlTable& table, const std::filesystem::path& base, Model model) {
  const std::string name = table.string("rig");
  if (name.empty()) return Rig{};  // the table contains the error for the missing key
  MDOF_TRY(Rig rig, load_rig(base / name));
  MDOF_TRY(const auto solver, algo::Solver::create(rig, model));
  return rig;
}

// Tables of the devices: [axis.device] if the axis has one device, [[axis.device]] if it has
// several devices.
std::vector<TomlTable> device_tables(TomlTable& axis) {
  if (axis.is_array("device")) return axis.tables("device");
  std::vector<TomlTable> one;
  if (auto table = axis.table("device")) one.push_back(std::move(*table));
  return one;
}

// Sets device.simulated if the log is simulated. Error: the log is for another axis than the rig.
Status check_log(drivers::DriverSpec& device, const Rig& rig) {
  MDOF_TRY(ReplayLog log, ReplayLog::open(device.source_path));
  MDOF_CHECK(check_axis(device.source_path, log.comments(), rig));
  device.simulated = log.driver().info().simulated;
  return {};
}

// Checks that the rig can convert the units of the channels to lengths. Volts need a scale in the
// rig, for example. A unit that is unknown before the device is opened is not checked.
Status check_units(const TomlTable& table, const drivers::DriverSpec& device, const Rig& rig) {
  if (!device.live || device.simulated) return {};
  MDOF_TRY(const auto driver, device.make());
  if (auto fits = drivers::Calibrator(rig).check(
          drivers::channels_for_axis(driver->info().channels, device.part));
      !fits)
    return in_context(table.where("channel"), std::move(fits.error()));
  return {};
}

Result<drivers::DriverSpec> read_device(TomlTable& table, const std::filesystem::path& base,
                                        const AxisConfig& axis, double settle_s,
                                        std::vector<AxisTables>& later) {
  const std::string driver = table.string("driver");
  const std::string number = axis.devices.empty() ? "" : std::to_string(axis.devices.size() + 1);
  drivers::DriverContext context;
  context.name = table.string("name", driver + "-" + letter(axis.rig.axis) + number);
  context.rig = axis.rig;
  context.base_path = base.string();
  context.settle_s = settle_s;
  context.further = further_axes(context.name, later);
  MDOF_TRY(context.forward, forward_model(axis.rig));
  MDOF_TRY(auto device, drivers::configure_driver(driver, table, context));
  MDOF_CHECK(restrict_to_first_axis(device, context.further));
  if (!device.recorded) MDOF_CHECK(check_log(device, axis.rig));
  MDOF_CHECK(check_units(table, device, axis.rig));
  return device;
}

// If readings are interpolated, the sampling rate of each device must be high enough.
Status check_rates(const TomlTable& table, const AxisConfig& axis, const Config& config) {
  const auto options = with_delays(config.measure, axis.rig, axis.delays);
  if (axis.devices.size() < 2 && options.align.delay_s.empty()) return {};
  for (const auto& device : axis.devices) {
    MDOF_TRY(const auto driver, device.make());
    if (auto works = check_rate(driver->info(), config.measure.align, config.gap_given); !works)
      return in_context(table.where("device"), std::move(works.error()));
  }
  return {};
}

// Exactly one device of an axis must provide each channel of the rig. A replay or a simulated
// device must be the only device of the axis.
Status check_together(TomlTable& table, const AxisConfig& axis) {
  std::vector<ChannelSource> sources;
  for (const auto& device : axis.devices) {
    if (axis.devices.size() > 1 && (!device.live || device.simulated)) {
      table.reject("device", "\"" + device.name +
                                 "\" provides all channels, so no other device is " +
                                 "allowed on this axis; remove the other devices of the axis");
      return {};
    }
    sources.push_back({device.name, device.channels});
  }
  const auto reject = [&](const Status& checked) {
    if (!checked) table.reject("device", checked.error().message);
  };
  reject(check_no_channel_twice(axis.rig, sources));
  const auto unknown = [](const auto& device) { return device.channels.empty(); };
  if (std::any_of(axis.devices.begin(), axis.devices.end(), unknown)) return {};
  reject(check_all_channels(axis.rig, sources));
  return {};
}

Status check_names(TomlTable& table, const AxisConfig& axis, const Config& config) {
  std::set<std::string> names;
  for (const auto& other : config.axes) {
    if (other.rig.axis == axis.rig.axis) {
      table.reject("rig", std::string("a second rig for axis ") + letter(axis.rig.axis) +
                              "; only one [[axis]] with one rig is allowed for each axis");
    }
    for (const auto& device : other.devices) names.insert(device.name);
  }
  for (const auto& device : axis.devices) {
    if (device.is_declared_elsewhere) continue;
    if (!names.insert(device.name).second)
      table.reject("device", "two devices have the name \"" + device.name +
                                 "\"; give each device a different name");
  }
  return {};
}

// Sets the machine of the rig to the machine of the configuration. If the rig states a machine,
// too, the two machines must be equal.
void set_machine(TomlTable& table, const Chain& machine, Rig& rig) {
  if (!machine.known()) return;
  const std::string axis(1, letter(rig.axis));
  const ChainAxis* in_chain = machine.find(axis[0]);
  if (rig.machine.known() && rig.machine != machine) {
    table.reject(
        "rig",
        rig.source +
            " and this file have different [machine] tables; keep only one of the two tables");
  } else if (!in_chain) {
    table.reject("rig", "the rig is for axis " + axis + ", but the chain of [machine], " +
                            machine.text + ", has no axis " + axis +
                            "; correct the rig or the chain");
  } else if (in_chain->against_command != rig.sides.against_encoder) {
    table.reject("rig", "the rig has travel = \"" + std::string(rig.sides.travel()) +
                            "\", but [machine] travel." + axis +
                            " states the opposite; correct the wrong value");
  } else {
    rig.machine = machine;
  }
}

Result<std::vector<AxisTables>> read_axes(TomlTable& root, const std::filesystem::path& base,
                                          Model model) {
  std::vector<AxisTables> axes;
  for (auto& table : root.tables("axis")) {
    MDOF_TRY(Rig rig, read_rig(table, base, model));
    auto devices = device_tables(table);
    axes.push_back({std::move(table), std::move(rig), std::move(devices)});
  }
  return axes;
}

// `later`: the axes that follow this axis in the configuration.
Status read_axis(AxisTables tables, const std::filesystem::path& base,
                 std::vector<AxisTables>& later, Config& config) {
  TomlTable& table = tables.table;
  const double settle_s = config.measure.dwell.settle_s;
  AxisConfig axis;
  axis.rig = std::move(tables.rig);
  for (auto& device : tables.devices) {
    if (is_same_as(device)) {
      MDOF_TRY(auto spec, read_same_as(device, config.axes, settle_s, axis));
      MDOF_CHECK(check_units(device, spec, axis.rig));
      axis.devices.push_back(std::move(spec));
      continue;
    }
    read_delays(device, axis.rig, settle_s, axis.delays);
    MDOF_TRY(auto spec, read_device(device, base, axis, settle_s, later));
    axis.devices.push_back(std::move(spec));
  }
  if (const auto settles = check_settling(with_delays(config.measure, axis.rig, axis.delays));
      !settles)
    return in_context(axis.rig.source, settles.error());
  set_machine(table, config.machine, axis.rig);
  if (axis.devices.empty()) {
    table.reject("device", "is missing; add [axis.device] with driver = \"...\"");
    return table.finish();
  }
  MDOF_CHECK(check_together(table, axis));
  MDOF_CHECK(check_names(table, axis, config));
  MDOF_CHECK(check_rates(table, axis, config));
  config.axes.push_back(std::move(axis));
  return {};
}

}  // namespace

bool AxisConfig::simulated() const {
  return std::any_of(devices.begin(), devices.end(), [](const auto& d) { return d.simulated; });
}

Result<PipelineOptions> measure_options(const std::string& configuration) {
  MDOF_TRY(auto root, TomlTable::parse(configuration, "mdofd.toml of the recording"));
  PipelineOptions options;
  read_measure(root, options);
  return options;
}

Result<Config> load_config(const std::filesystem::path& file) {
  MDOF_TRY(std::string text, read_text_file(file));
  MDOF_TRY(auto root, TomlTable::parse(text, file.string()));
  Config config;
  config.source = file.string();
  config.text = std::move(text);
  MDOF_CHECK(read_store(root, config));
  read_rpc(root, config);
  config.http = read_http(root, config.database.parent_path());
  config.gap_given = read_measure(root, config.measure);
  const auto base = std::filesystem::absolute(file).parent_path();
  config.machine = read_machine(root);
  MDOF_TRY(auto axes, read_axes(root, base, config.measure.model));
  while (!axes.empty()) {
    AxisTables next = std::move(axes.front());
    axes.erase(axes.begin());
    MDOF_CHECK(read_axis(std::move(next), base, axes, config));
  }
  MDOF_CHECK(root.finish());
  return config;
}

}  // namespace mdof::daemon
