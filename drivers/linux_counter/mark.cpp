#include "drivers/linux_counter/mark.h"

#include "drivers/linux_counter/protocol.h"
#include "drivers/sysfs/attribute.h"

namespace mdof::drivers {
namespace {

constexpr std::uint64_t kCeiling = 0xFFFFFF;  // LS7267_CNTR_MAX of 104-quad-8.c
constexpr int kFirstIndexSignal = 16;         // index signal of count0 in quad8_signals

}  // namespace

Status check_quad8(const std::string& folder, const std::string& count, std::uint64_t ceiling) {
  const std::string path = folder + "/" + count;
  if (ceiling != kCeiling)
    return io_error(path + "/ceiling: is " + std::to_string(ceiling) + ", not " +
                    std::to_string(kCeiling) +
                    ", so the count at the reference mark is unknown; set count_mode to "
                    "\"normal\"; if the ceiling stays 33554431 (25 bits instead of 24), the kernel "
                    "is too old: install a newer kernel");
  const std::string number = count.substr(std::string("count").size());
  const auto n = parse_sysfs_integer(number);
  if (!n || *n < 0 || *n > 7) return io_error(path + ": is not a count of a " + kQuad8);
  const std::string signal = folder + "/signal" + std::to_string(kFirstIndexSignal + *n);
  MDOF_TRY(const auto mode, read_sysfs(signal + "/synchronous_mode"));
  if (mode.value_or("") == "synchronous") return {};
  return needs_setting(
      signal + "/synchronous_mode",
      "is \"" + mode.value_or("") +
          "\", so the reference mark would be as wide as the index pulse, not one count wide",
      "synchronous");
}

Status Quad8Mark::enable(bool on) const {
  return write_sysfs(path_ + "/preset_enable", on ? "1" : "0");
}

// preset_enable is 0 while the count is read and the preset is written. Otherwise the counter could
// load the old preset.
Status Quad8Mark::arm() {
  MDOF_CHECK(enable(false));
  MDOF_TRY(const std::int64_t count, read_());
  return arm_at(count);
}

Status Quad8Mark::arm_at(std::int64_t count) {
  MDOF_CHECK(write_sysfs(path_ + "/preset", std::to_string(mark_.arm(count))));
  return enable(true);
}

Result<Quad8Mark::State> Quad8Mark::take(std::int64_t count) {
  const State now = mark_.take(count);
  if (now == State::unexplained)
    return io_error(path_ + "/count: " + std::to_string(count) +
                    " cannot result from a motion or from the reference mark; check the cable of "
                    "the encoder");
  if (now == State::passed && !off_) {
    MDOF_CHECK(enable(false));
    off_ = true;
  }
  if (now != State::awaited || !mark_.far_from_armed(count)) return now;
  MDOF_CHECK(enable(false));
  MDOF_TRY(const std::int64_t still, read_());
  if (mark_.take(still) == State::awaited) MDOF_CHECK(arm_at(still));
  return now;
}

}  // namespace mdof::drivers
