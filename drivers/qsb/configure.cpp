#include "drivers/qsb/configure.h"

#include "drivers/io/device_lock.h"
#include "drivers/qsb/qsb.h"

namespace mdof::drivers {
namespace {

void read_place(TomlTable& table, QsbOptions& options) {
  if (!table.has("address")) {
    options.port = table.string("port");
    return;
  }
  if (table.has("port"))
    table.reject("port", "contradicts the key \"address\"; give only one of the two keys");
  const auto address = parse_endpoint(table.string("address"), 0);
  address ? void(options.address = *address) : table.reject("address", address.error().message);
}

void read_counting(TomlTable& table, QsbOptions& options) {
  const std::string counting = table.string("counting", "x4");
  options.counting = counting == "x1" ? 1 : counting == "x2" ? 2 : 3;
  if (options.counting == 3 && counting != "x4")
    table.reject("counting", "must be \"x1\", \"x2\" or \"x4\"");
}

}  // namespace

Result<DriverSpec> configure_qsb(TomlTable& table, const DriverContext& context) {
  QsbOptions options;
  read_place(table, options);
  read_counting(table, options);
  const std::int64_t baud = table.integer("baud", options.line.baud);
  if (baud < 1200 || baud > 921'600)
    table.reject("baud", "must be a baud rate from 1200 to 921600");
  options.line.baud = static_cast<int>(baud);
  options.line.rts = table.boolean("rts", true);
  const std::int64_t interval = table.integer("interval", 1);
  if (interval < 1 || interval > 512) table.reject("interval", "must be from 1 to 512 ticks");
  options.interval = static_cast<std::uint32_t>(interval);
  options.serial = table.string("serial", "");
  MDOF_TRY(const auto channels, read_channels(table, context.rig, [&](TomlTable& channel) {
             options.index_inverted = channel.boolean("index_inverted", false);
             if (options.index_inverted && !channel.has("index_mm"))
               channel.reject("index_inverted",
                              "needs a reference mark, but index_mm is missing; add "
                              "index_mm or remove index_inverted");
           }));
  MDOF_CHECK(table.finish());
  for (const auto& channel : channels) {
    if (channel.input != "count") return no_such_input(channel, {"count"});
    MDOF_CHECK(check_um_per_count(channel));
  }
  options.channel = channels[0];
  DriverSpec spec;
  spec.channels = {options.channel.id};
  spec.encoder = encoder_origin(channels, true);
  spec.identity = [at = options.address, port = options.port] {
    return at ? identity_of(*at) : identity_of_path(port);
  };
  spec.make = make_of<Qsb>(context.name, options);
  return spec;
}

}  // namespace mdof::drivers
