// mdofd.toml: one validated struct before anything is opened.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemon/http_access.h"
#include "daemon/measure/delays.h"
#include "daemon/measure/pipeline.h"
#include "daemon/store/store.h"
#include "drivers/driver_spec.h"
#include "schema/base/result.h"

namespace mdof::daemon {

struct AxisConfig {
  Rig rig;
  // Live ones that together give the rig's channels, or one replay.
  std::vector<drivers::DriverSpec> devices;
  ChannelDelays delays = {};

  bool live() const { return devices.front().live; }
  bool recorded() const { return devices.front().recorded; }
  bool simulated() const;  // any of them is
};

// The keys of [rpc] that say who may connect.
struct RpcAccess {
  std::size_t connections = 64, connections_of_user = 32;
  std::chrono::seconds idle{600};      // without a subscription; 0: for ever
  std::optional<gid_t> cnc_group;      // one connection is kept for its members
  std::optional<gid_t> approve_group;  // whose members alone may activate a table
  std::string approvers;               // its name
};

struct Config {
  std::filesystem::path database, recordings;
  store::Durability durability = store::Durability::full;
  std::chrono::milliseconds commit_interval{50};
  std::string socket;
  std::optional<std::uint16_t> tcp_port;  // loopback; off unless configured
  RpcAccess access;
  std::optional<HttpAccess> http;  // the web page; off unless configured
  PipelineOptions measure;
  bool gap_given = false;  // measure.align.max_gap_s; else it follows the devices' rates
  Chain machine;           // [machine]; may be not known
  std::vector<AxisConfig> axes;
  std::string text;  // the TOML itself: provenance
  // For messages: the file, and where in it the paths are, or would be.
  std::string source, database_key, recordings_key, socket_key;
};

// [measure] of a configuration that mdofd has accepted. Error: it is no TOML.
Result<PipelineOptions> measure_options(const std::string& configuration);

// Errors name file, line and key; unknown keys the nearest known one.
Result<Config> load_config(const std::filesystem::path& file);

}  // namespace mdof::daemon
