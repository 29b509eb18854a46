#include "drivers/linux_counter/configure.h"

#include "drivers/linux_counter/linux_counter.h"
#include "drivers/linux_counter/mark.h"

namespace mdof::drivers {

Result<DriverSpec> configure_linux_counter(TomlTable& table, const DriverContext& context) {
  LinuxCounterOptions options;
  options.sysfs_root = table.string("sysfs_root", options.sysfs_root);
  options.device = table.string("device", options.device);
  options.chip = table.string("chip", options.chip);
  options.function = table.string("function", options.function);
  const std::int64_t ceiling = table.integer("ceiling", 0);
  if (ceiling < 0) table.reject("ceiling", "must be the greatest count, such as 65535");
  options.ceiling = static_cast<std::uint64_t>(ceiling);
  options.rate_hz = table.number("rate_hz", options.rate_hz);
  if (!(options.rate_hz >= 0.1 && options.rate_hz <= 5000))
    table.reject("rate_hz", "must be from 0.1 to 5000");
  MDOF_TRY(options.channels, read_channels(table, context.rig, [&](TomlTable& channel) {
             if (channel.has("index_mm") && options.chip != kQuad8)
               channel.reject("index_mm",
                              "needs chip = \"104-quad-8\", because only this counter driver of "
                              "the Linux kernel is known to set the count at a reference mark",
                              Remedy::count_without_mark);
           }));
  MDOF_CHECK(table.finish());
  for (const auto& channel : options.channels) MDOF_CHECK(check_um_per_count(channel));
  DriverSpec spec;
  spec.channels = ids_of(options.channels);
  spec.encoder = encoder_origin(options.channels, true);
  spec.make = [name = context.name, options]() -> Result<std::unique_ptr<Driver>> {
    return make_linux_counter(name, options);
  };
  return spec;
}

}  // namespace mdof::drivers
