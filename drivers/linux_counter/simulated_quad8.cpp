#include "drivers/linux_counter/simulated_quad8.h"

#include <algorithm>

#include "drivers/linux_counter/mark.h"
#include "drivers/linux_counter/simulated_linux_counter.h"
#include "drivers/sysfs/attribute.h"

namespace mdof::drivers {
namespace {

constexpr std::int64_t kTop = 0xFFFFFF;

}  // namespace

Result<SimulatedQuad8> SimulatedQuad8::make(const std::filesystem::path& sysfs_root,
                                            std::int64_t mark) {
  MDOF_TRY(SimulatedTree tree, make_counter_tree(sysfs_root, kTop));
  MDOF_CHECK(tree.set("name", kQuad8));
  MDOF_CHECK(tree.set("count0/preset", "0"));
  MDOF_CHECK(tree.set("count0/preset_enable", "0"));
  MDOF_CHECK(tree.set("signal16/synchronous_mode", "synchronous"));
  const auto path = sysfs_root / "bus/counter/devices/counter0/count0";
  return SimulatedQuad8(std::move(tree), path.string(), mark);
}

Result<std::int64_t> SimulatedQuad8::value(const std::string& file) const {
  MDOF_TRY(const auto text, read_sysfs(path_ + "/" + file));
  const auto number = parse_sysfs_integer(text.value_or(""));
  if (!number) return io_error(path_ + "/" + file + ": is not a number");
  return *number;
}

Status SimulatedQuad8::move_to(std::int64_t position) {
  const auto [low, high] = std::minmax({position_, position});
  position_ = position;
  MDOF_TRY(const std::int64_t loads, value("preset_enable"));
  if (loads == 1 && low <= mark_ && mark_ <= high) {
    MDOF_TRY(const std::int64_t preset, value("preset"));
    zero_ = mark_ - preset;
  }
  return show();
}

Status SimulatedQuad8::lose_power() {
  zero_ = position_;
  MDOF_CHECK(tree_.set("count0/preset_enable", "0"));
  return show();
}

Status SimulatedQuad8::show() const {
  return tree_.set("count0/count", std::to_string((position_ - zero_) & kTop));
}

}  // namespace mdof::drivers
