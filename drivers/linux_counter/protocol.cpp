#include "drivers/linux_counter/protocol.h"

#include "drivers/sysfs/attribute.h"

namespace mdof::drivers {

tl::unexpected<Error> needs_setting(const std::string& file, const std::string& why,
                                    const std::string& value) {
  return io_error(file + ": " + why + "; set the value with a udev rule that runs: echo " + value +
                  " > " + file);
}

std::optional<std::int64_t> CountUnwrap::operator()(std::uint64_t raw) {
  if (raw > ceiling_) return std::nullopt;
  // The difference is calculated modulo ceiling + 1, which may be 2^64.
  const std::uint64_t up = raw >= last_raw_ ? raw - last_raw_ : raw + (ceiling_ - last_raw_) + 1;
  const std::uint64_t down = up == 0 ? 0 : ceiling_ - up + 1;
  const std::uint64_t step = up <= ceiling_ / 2 ? up : ~down + 1;
  total_ = static_cast<std::int64_t>(static_cast<std::uint64_t>(total_) + step);
  last_raw_ = raw;
  return total_;
}

Result<std::uint64_t> check_count(const CountFiles& files, const std::string& path,
                                  const std::string& function, std::uint64_t ceiling) {
  if (files.enable && *files.enable == "0")
    return needs_setting(path + "/enable", "the count is paused", "1");
  if (!function.empty() && files.function && *files.function != function)
    return needs_setting(path + "/function", "is \"" + *files.function + "\"",
                         "\"" + function + "\"");
  if (!function.empty() && !files.function)
    return io_error(
        path + "/function: does not exist; remove the key \"function\" from the configuration");
  if (files.count_mode && *files.count_mode != "normal" && *files.count_mode != "modulo-n")
    return needs_setting(path + "/count_mode",
                         "\"" + *files.count_mode + "\" stops counting at a limit", "normal");
  if (files.floor && *files.floor != "0")
    return needs_setting(path + "/floor", "is " + *files.floor + ", but counts must begin at 0",
                         "0");
  if (!files.ceiling && ceiling == 0)
    return io_error(path +
                    "/ceiling: does not exist; set the key \"ceiling\" in the configuration to the "
                    "greatest count in the data sheet (65535 for 16 bits)");
  if (!files.ceiling) return ceiling;
  const auto value = parse_sysfs_integer(*files.ceiling);
  if (!value || *value == 0)
    return io_error(path + "/ceiling: \"" + *files.ceiling +
                    "\" is not a whole number above 0; configure the counter");
  return static_cast<std::uint64_t>(*value);
}

}  // namespace mdof::drivers
