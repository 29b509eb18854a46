#include "tools/mdof/text/device_table.h"

#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;

std::string count(const element& device, const char* key) {
  return std::to_string(integer(device, key).value_or(0));
}

// Converts "2026-11-22T14:02:11.123Z" to "2026-11-22 14:02:11 UTC".
std::string readable_utc(std::string utc) {
  if (utc.size() < 19) return utc;
  utc[10] = ' ';
  return utc.substr(0, 19) + " UTC";
}

std::vector<std::string> row_of(const element& device) {
  element clock;
  const bool known = !device["clock"].get(clock) && clock.is_object();
  return {text(device, "axis"),
          text(device, "device"),
          text(device, "driver"),
          text(device, "state"),
          fixed(number(device, "rate_hz"), 1),
          count(device, "scans"),
          count(device, "scans_lost"),
          count(device, "reopened"),
          known ? fixed(number(clock, "drift_ppm"), 1) : "-",
          known ? fixed(number(clock, "jitter_ms"), 3) : "-"};
}

// The present faults of a device; if there are none, its last fault.
std::string remarks(const element& device, std::size_t columns) {
  std::string lines;
  for (const auto& line : texts(device, "trouble")) lines += wrapped(line, columns, 2) + "\n";
  const std::string recovered = text(device, "last_error");
  if (lines.empty() && !recovered.empty())
    lines = wrapped("device \"" + text(device, "device") + "\": recovered at " +
                        readable_utc(text(device, "mended_utc")) + "; last error: " + recovered,
                    columns, 2) +
            "\n";
  return lines;
}

}  // namespace

std::string device_table(std::string_view device_list, std::size_t columns) {
  simdjson::dom::parser parser;
  array devices;
  if (parser.parse(simdjson::padded_string(device_list))["devices"].get_array().get(devices))
    return std::string(device_list) + "\n";
  TextTable table({"axis", "device", "driver", "state", "rate/Hz", "scans", "lost", "reopened",
                   "drift/ppm", "jitter/ms"},
                  2);
  std::string below;
  for (const element device : devices) {
    table.add(row_of(device));
    below += remarks(device, columns);
  }
  return table.text(columns) + (below.empty() ? "" : "\n" + below);
}

}  // namespace mdof::tools
