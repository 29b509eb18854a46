// Reads mdofd.toml into one validated struct, before any device or file is opened.
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
  // Either one replay, or live devices. All live devices together provide all channels of the rig.
  std::vector<drivers::DriverSpec> devices;
  ChannelDelays delays = {};

  bool live() const { return devices.front().live; }
  bool recorded() const { return devices.front().recorded; }
  bool simulated() const;  // whether one device or more is simulated
};

// The keys of [rpc] that limit connections and permissions.
struct RpcAccess {
  std::size_t connections = 64, connections_of_user = 32;
  std::chrono::seconds idle{600};  // after this time without a request, mdofd closes a connection
                                   // without a subscription; 0: never
  std::optional<gid_t> cnc_group;  // mdofd reserves one connection for members of this group
  std::optional<gid_t> approve_group;  // only members of this group may activate a table
  std::string approvers;               // name of the group approve_group
};

struct Config {
  std::filesystem::path database, recordings;
  store::Durability durability = store::Durability::full;
  std::chrono::milliseconds commit_interval{50};
  std::string socket;
  // TCP port of the RPC on the loopback interface; off by default.
  std::optional<std::uint16_t> tcp_port;
  RpcAccess access;
  std::optional<HttpAccess> http;  // the web page; off by default
  PipelineOptions measure;
  bool gap_given = false;  // true: the file gives max_gap_s; false: mdofd calculates the longest
                           // permitted gap from the sampling rates
  Chain machine;           // the table [machine]; machine.known() is false if this table is missing
  std::vector<AxisConfig> axes;
  std::string text;  // the TOML text, for the provenance
  // For messages: the name of the file, and file, line and key of each path. These members are set
  // even if the file does not contain the keys.
  std::string source, database_key, recordings_key, socket_key;
};

// Reads [measure] of a configuration that mdofd has accepted before. Error: the text is not TOML.
Result<PipelineOptions> measure_options(const std::string& configuration);

// Each error states the file, the line and the key. The error for an unknown key also states the
// most similar known key.
Result<Config> load_config(const std::filesystem::path& file);

}  // namespace mdof::daemon
