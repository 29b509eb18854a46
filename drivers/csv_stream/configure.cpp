#include "drivers/csv_stream/configure.h"

#include <cmath>
#include <filesystem>

#include "drivers/calibration.h"
#include "drivers/csv_stream/csv_stream.h"
#include "drivers/io/device_lock.h"
#include "drivers/io/serial_settings.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;

milliseconds read_seconds(TomlTable& table, const char* key, milliseconds fallback, double most) {
  const double s = table.number(key, static_cast<double>(fallback.count()) / 1000);
  if (!(s >= 0.1 && s <= most)) {
    table.reject(key, "must be from 0.1 to " + std::to_string(std::lround(most)));
    return fallback;
  }
  return milliseconds(std::llround(s * 1000));
}

void read_source(TomlTable& table, const std::string& base_path, CsvStreamOptions& options) {
  const std::string source = table.string("source");
  if (source.starts_with("fifo:") && source.size() > 5) {
    options.fifo = (std::filesystem::path(base_path) / source.substr(5)).string();
  } else if (source.starts_with("tcp://")) {
    const auto server = parse_endpoint(source.substr(6), 0);
    server ? void(options.server = *server) : table.reject("source", server.error().message);
  } else if (source.starts_with("serial:/")) {
    options.port = source.substr(7);
    read_serial_settings(table, options.line);
  } else {
    table.reject("source",
                 "must be \"tcp://HOST:PORT\", \"fifo:PATH\" or \"serial:/dev/...\"; to start a "
                 "program, set command = [\"python3\", \"my_probe.py\"] instead of source");
  }
}

void read_header(TomlTable& table, CsvStreamOptions& options) {
  options.header = table.string("header", "");
  if (options.header.empty()) return;
  const auto header = parse_csv_header(options.header + "\n", CsvKind::stream, "header");
  if (!header) return table.reject("header", header.error().message);
  if (const auto fits = options.check_units(header->channels); !fits)
    table.reject("header", fits.error().message);
}

CsvStreamOptions read_options(TomlTable& table, const DriverContext& context) {
  CsvStreamOptions options;
  options.folder = context.base_path;
  options.expected = {kEncoderChannel};
  for (const Probe& probe : context.rig.probes) options.expected.push_back(probe.id);
  if (table.has("command")) {
    options.command = table.strings("command");
    if (options.command.empty() || options.command[0].empty())
      table.reject("command", "must contain a program, such as [\"python3\", \"my_probe.py\"]");
    if (table.has("source"))
      table.reject("source", "contradicts the key \"command\"; give only one of the two keys");
  } else {
    read_source(table, context.base_path, options);
  }
  options.check_units = [rig = Calibrator(context.rig)](const std::vector<Channel>& channels) {
    return rig.check(channels);
  };
  read_header(table, options);
  // The maximum is 5 s, because the watchdog would report a longer wait as a hung thread.
  options.start = read_seconds(table, "start_s", options.start, 5);
  options.silence = read_seconds(table, "silence_s", options.silence, 3600);
  options.absolute = table.boolean("absolute", false);
  const std::int64_t bad_lines = table.integer("bad_lines", 100);
  if (bad_lines < 0 || bad_lines > 10'000) table.reject("bad_lines", "must be from 0 to 10000");
  options.bad_lines = static_cast<std::size_t>(bad_lines);
  return options;
}

// The program may open a device. Therefore two drivers must not start the same program.
std::string identity(const CsvStreamOptions& options) {
  if (options.server) return identity_of(*options.server);
  if (!options.fifo.empty()) return identity_of_path(options.fifo);
  if (!options.port.empty()) return identity_of_path(options.port);
  std::string text = "program in " + identity_of_path(options.folder) + ":";
  for (const std::string& word : options.command) text += " " + word;
  return text;
}

}  // namespace

Result<DriverSpec> configure_csv_stream(TomlTable& table, const DriverContext& context) {
  const CsvStreamOptions options = read_options(table, context);
  MDOF_CHECK(table.finish());
  DriverSpec spec;
  spec.identity = [options] { return identity(options); };
  spec.make = make_of<CsvStream>(context.name, options);
  spec.source_info = [](const Driver& driver) {
    return SourceInfo{{}, static_cast<const CsvStream&>(driver).notices()};
  };
  return spec;
}

}  // namespace mdof::drivers
