#include "drivers/linux_counter/linux_counter.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "drivers/linux_counter/mark.h"
#include "drivers/linux_counter/protocol.h"

namespace mdof::drivers {
namespace {

constexpr std::int64_t kSlow_ns = 2'000'000;  // a reading that takes longer was delayed

struct Count {
  SysfsAttribute file;
  CountUnwrap unwrap;
  double um_per_count;
  std::optional<Quad8Mark> mark = std::nullopt;
  IndexMark::State state = IndexMark::State::off;  // state of `mark`
};

Result<std::int64_t> counts_now(Count& count) {
  MDOF_TRY(const std::int64_t raw, count.file.read_integer());
  const auto counts = count.unwrap(static_cast<std::uint64_t>(raw));
  if (counts) return *counts;
  return io_error(count.file.path() + ": " + std::to_string(raw) +
                  " is greater than the ceiling (the greatest count); another program may have "
                  "changed the settings of the counter");
}

// The reading at which the state becomes `passed` has no position. Later readings have valid
// positions.
Result<SysfsReading> read_marked(Count& count, std::int64_t counts) {
  using State = IndexMark::State;
  const State before = count.state;
  MDOF_TRY(count.state, count.mark->take(counts));
  const bool passed = count.state == State::passed;
  if (count.state != State::awaited && before != State::passed)
    return SysfsReading{kNaN, Quality::missing, passed};
  if (passed) counts = count.mark->from_mark(counts);
  return SysfsReading{static_cast<double>(counts) * count.um_per_count, Quality::good};
}

Result<SysfsReading> read_count(Count& count) {
  MDOF_TRY(const std::int64_t counts, counts_now(count));
  if (count.mark) return read_marked(count, counts);
  return SysfsReading{static_cast<double>(counts) * count.um_per_count, Quality::good};
}

Status await_mark(const std::shared_ptr<Count>& count, const std::string& folder,
                  const std::string& input, std::uint64_t ceiling) {
  MDOF_CHECK(check_quad8(folder, input, ceiling));
  count->mark.emplace(folder + "/" + input, [c = count.get()] { return counts_now(*c); });
  count->state = IndexMark::State::awaited;
  return count->mark->arm();
}

Result<CountFiles> read_files(const std::string& path) {
  CountFiles files;
  MDOF_TRY(files.function, read_sysfs(path + "/function"));
  MDOF_TRY(files.count_mode, read_sysfs(path + "/count_mode"));
  MDOF_TRY(files.enable, read_sysfs(path + "/enable"));
  MDOF_TRY(files.ceiling, read_sysfs(path + "/ceiling"));
  MDOF_TRY(files.floor, read_sysfs(path + "/floor"));
  return files;
}

std::vector<std::string> counts_of(const std::string& folder) {
  std::vector<std::string> counts;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("count")) counts.push_back(name);
  }
  std::sort(counts.begin(), counts.end());
  return counts;
}

Result<SysfsInput> open_count(const LinuxCounterOptions& options, const std::string& folder,
                              const ChannelInput& channel) {
  const auto counts = counts_of(folder);
  if (std::find(counts.begin(), counts.end(), channel.input) == counts.end())
    return no_such_input(channel, counts);
  const std::string path = folder + "/" + channel.input;
  MDOF_TRY(const CountFiles files, read_files(path));
  MDOF_TRY(const std::uint64_t ceiling,
           check_count(files, path, options.function, options.ceiling));
  MDOF_TRY(SysfsAttribute file, SysfsAttribute::open(path + "/count", options.read));
  auto count =
      std::make_shared<Count>(Count{std::move(file), CountUnwrap(ceiling), channel.um_per_count});
  if (channel.index_mm) MDOF_CHECK(await_mark(count, folder, channel.input, ceiling));
  SysfsInput input;
  input.channel = {channel.id, Unit::um};
  input.read = [count] { return read_count(*count); };
  return input;
}

bool has_mark(const LinuxCounterOptions& options) {
  return std::any_of(options.channels.begin(), options.channels.end(),
                     [](const ChannelInput& channel) { return channel.index_mm.has_value(); });
}

Result<SysfsDevice> open_counter(const LinuxCounterOptions& options) {
  const std::string folder = options.sysfs_root + "/bus/counter/devices/" + options.device;
  MDOF_TRY(const auto chip, read_sysfs(folder + "/name"));
  std::error_code ec;
  if (!chip && !std::filesystem::exists(folder, ec))
    return io_error(folder + ": " + sysfs_error(ENODEV) + "; to list the counters, run: ls " +
                    options.sysfs_root + "/bus/counter/devices");
  if (!options.chip.empty() && chip.value_or("") != options.chip)
    return io_error(folder + "/name: is \"" + chip.value_or("") +
                    "\", but the configuration has chip = \"" + options.chip +
                    "\"; Linux assigns device numbers in the order of detection; correct the key "
                    "\"device\"");
  SysfsDevice device;
  device.datum_lost = "the device was disconnected, and may have stopped counting in the meantime";
  device.datum_remedy = has_mark(options) ? Remedy::pass_reference_mark : Remedy::set_encoder;
  device.description = "counter " + chip.value_or("without a name") + " at " + folder;
  for (const auto& channel : options.channels) {
    MDOF_TRY(SysfsInput input, open_count(options, folder, channel));
    device.inputs.push_back(std::move(input));
  }
  return device;
}

}  // namespace

std::unique_ptr<SysfsPoller> make_linux_counter(const std::string& name,
                                                const LinuxCounterOptions& options) {
  return std::make_unique<SysfsPoller>(name, "linux_counter", options.rate_hz, kSlow_ns,
                                       [options] { return open_counter(options); });
}

}  // namespace mdof::drivers
