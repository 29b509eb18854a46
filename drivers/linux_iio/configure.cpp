#include "drivers/linux_iio/configure.h"

#include <algorithm>

#include "drivers/linux_iio/linux_iio.h"

namespace mdof::drivers {
namespace {

void read_table(TomlTable& channel, GapLaw& law) {
  for (const auto& row : channel.matrix("gap_table")) {
    if (row.size() != 2 || (!law.table.empty() && !(row[0] > law.table.back()[0])))
      return channel.reject("gap_table", "must be rows [pF, um] in the order of increasing pF");
    law.table.push_back({row[0], row[1]});
  }
  if (law.table.size() < 2) channel.reject("gap_table", "must have at least two rows");
}

GapLaw read_law(TomlTable& channel) {
  GapLaw law;
  if (channel.has("gap_table")) {
    read_table(channel, law);
    for (const char* key : {"area_mm2", "stray_pF"})
      if (channel.has(key))
        channel.reject(key, "contradicts gap_table; give only one of the two keys");
    return law;
  }
  law.area_mm2 = channel.number("area_mm2");
  law.stray_pF = channel.number("stray_pF", 0);
  if (!(law.area_mm2 > 0 && law.area_mm2 < 1e6))
    channel.reject("area_mm2",
                   "must be the area of the electrode, greater than 0 and less than 1000000 mm2");
  return law;
}

}  // namespace

Result<DriverSpec> configure_linux_iio(TomlTable& table, const DriverContext& context) {
  LinuxIioOptions options;
  options.sysfs_root = table.string("sysfs_root", options.sysfs_root);
  options.device = table.string("device", options.device);
  options.rate_hz = table.number("rate_hz", options.rate_hz);
  if (!(options.rate_hz >= 0.01 && options.rate_hz <= 91))
    table.reject("rate_hz", "must be from 0.01 to 91");
  options.sampling_hz = table.integer("sampling_hz", 0);
  const auto& rates = ad7746_sampling_hz();
  if (table.has("sampling_hz") &&
      std::find(rates.begin(), rates.end(), options.sampling_hz) == rates.end())
    table.reject("sampling_hz", "must be one of 91, 84, 50, 26, 16, 13, 11 and 9");
  MDOF_TRY(options.channels, read_channels(table, context.rig, [&options](TomlTable& channel) {
             options.laws.push_back(read_law(channel));
           }));
  MDOF_CHECK(table.finish());
  MDOF_CHECK(check_reads_stated(options.channels, context.rig));
  for (const auto& channel : options.channels) {
    const auto& inputs = ad7746_inputs();
    if (std::find(inputs.begin(), inputs.end(), channel.input) == inputs.end())
      return no_such_input(channel, inputs);
  }
  DriverSpec spec;
  spec.channels = ids_of(options.channels);
  spec.encoder = encoder_origin(options.channels, false);
  spec.make = [name = context.name, options]() -> Result<std::unique_ptr<Driver>> {
    return make_linux_iio(name, options);
  };
  return spec;
}

}  // namespace mdof::drivers
