#include "drivers/linux_iio/linux_iio.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "schema/base/number/number_text.h"

namespace mdof::drivers {
namespace {

// Duration of the I²C transfers and of the wake-up for each reading.
constexpr double kOverhead_s = 0.004;

std::string folder_of(const LinuxIioOptions& options) {
  return options.sysfs_root + "/bus/iio/devices/" + options.device;
}

// Accepts only AD7745 and AD7746, because the unit of a capacitance depends on the kernel's driver.
Result<std::string> check_chip(const std::string& folder) {
  MDOF_TRY(const auto chip, read_sysfs(folder + "/name"));
  if (!chip)
    return io_error(folder + ": " + sysfs_error(ENODEV) +
                    "; to list the devices, run: grep . /sys/bus/iio/devices/*/name");
  if (*chip != "ad7745" && *chip != "ad7746")
    return io_error(folder + "/name: is \"" + *chip +
                    "\", but must be \"ad7745\" or \"ad7746\"; Linux assigns device numbers in the "
                    "order of detection; correct the key \"device\"");
  MDOF_TRY(const auto scale, read_sysfs(folder + "/in_capacitance_scale"));
  const double pF = std::strtod(scale.value_or("").c_str(), nullptr);
  if (!(std::abs(pF / kAd7746_pF_per_count - 1) < 0.002))
    return io_error(folder + "/in_capacitance_scale: \"" + scale.value_or("") +
                    "\", but this driver expects 0.000000488 pF; the kernel driver has "
                    "changed; inform the authors of mdof");
  return *chip;
}

Status set_sampling(const LinuxIioOptions& options, const std::string& folder) {
  const std::string file = folder + "/in_capacitance_sampling_frequency";
  MDOF_TRY(auto hz, read_sysfs(file));
  const std::string wanted = std::to_string(options.sampling_hz);
  if (options.sampling_hz != 0 && hz != wanted) {
    MDOF_CHECK(write_sysfs(file, wanted));
    MDOF_TRY(hz, read_sysfs(file));
    if (hz != wanted)
      return io_error(file + ": is still " + hz.value_or("") + " after " + wanted + " was written");
  }
  const auto value = parse_sysfs_integer(hz.value_or(""));
  if (!value || *value <= 0)
    return io_error(file + ": \"" + hz.value_or("") + "\" is not a sampling rate in Hz");
  const double scan_s = static_cast<double>(options.channels.size()) *
                        (1 / static_cast<double>(*value) + kOverhead_s);
  if (options.rate_hz * scan_s <= 1) return {};
  return bad_input(file + ": a scan of " + std::to_string(options.channels.size()) +
                   " channels at " + std::to_string(*value) + " Hz takes " + plain_number(scan_s) +
                   " s, which is too long for rate_hz = " + plain_number(options.rate_hz) +
                   "; lower rate_hz or raise sampling_hz");
}

// Returns the counts that the converter's internal capacitors (CAPDAC) subtract. Each of the two
// inputs of the converter has one capacitor.
Result<std::int64_t> read_capdac(const std::string& folder, const std::string& input) {
  const std::string own = input.substr(0, input.find('-'));
  const std::string other = own == "capacitance0" ? "-capacitance2" : "-capacitance3";
  std::int64_t subtracted = 0;
  MDOF_TRY(const auto plus, read_sysfs(folder + "/in_" + own + "_offset"));
  if (plus) subtracted += parse_sysfs_integer(*plus).value_or(0);
  MDOF_TRY(const auto minus, read_sysfs(folder + "/in_" + own + other + "_zeropoint"));
  if (minus) subtracted -= parse_sysfs_integer(*minus).value_or(0);
  return subtracted;
}

Result<SysfsInput> open_input(const LinuxIioOptions& options, std::size_t i) {
  const ChannelInput& channel = options.channels[i];
  const std::string folder = folder_of(options);
  MDOF_TRY(SysfsAttribute opened,
           SysfsAttribute::open(folder + "/in_" + channel.input + "_raw", options.read));
  MDOF_TRY(const std::int64_t subtracted, read_capdac(folder, channel.input));
  auto file = std::make_shared<SysfsAttribute>(std::move(opened));
  SysfsInput input;
  input.channel = {channel.id, Unit::um};
  input.read = [file, subtracted, law = options.laws[i]]() -> Result<SysfsReading> {
    MDOF_TRY(const std::int64_t raw, file->read_integer());
    if (raw < kAd7746LeastRaw || raw > kAd7746MostRaw)
      return io_error(file->path() + ": " + std::to_string(raw) +
                      " has more than 24 bits, so this is not a reading of an AD7746");
    return ad7746_gap_um(law, raw, subtracted);
  };
  return input;
}

Result<SysfsDevice> open_iio(const LinuxIioOptions& options) {
  const std::string folder = folder_of(options);
  MDOF_TRY(const std::string chip, check_chip(folder));
  MDOF_CHECK(set_sampling(options, folder));
  SysfsDevice device;
  device.description = "capacitance converter " + chip + " at " + folder;
  for (std::size_t i = 0; i < options.channels.size(); ++i) {
    MDOF_TRY(SysfsInput input, open_input(options, i));
    device.inputs.push_back(std::move(input));
  }
  return device;
}

}  // namespace

const std::vector<std::string>& ad7746_inputs() {
  static const std::vector<std::string> inputs = {
      "capacitance0", "capacitance1", "capacitance0-capacitance2", "capacitance1-capacitance3"};
  return inputs;
}

const std::vector<std::int64_t>& ad7746_sampling_hz() {
  static const std::vector<std::int64_t> rates = {91, 84, 50, 26, 16, 13, 11, 9};
  return rates;
}

std::unique_ptr<SysfsPoller> make_linux_iio(const std::string& name,
                                            const LinuxIioOptions& options) {
  return std::make_unique<SysfsPoller>(name, "linux_iio", options.rate_hz, 0,
                                       [options] { return open_iio(options); });
}

}  // namespace mdof::drivers
