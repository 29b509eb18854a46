#include "drivers/channels.h"

#include <algorithm>
#include <cmath>

namespace mdof::drivers {
namespace {

constexpr double kMostOffset_mm = 1e6;  // a kilometre of slide

Status check_id(const ChannelInput& channel, const std::vector<ChannelInput>& before,
                const Rig& rig) {
  std::vector<std::string> known = {kEncoderChannel};
  for (const Probe& probe : rig.probes) known.push_back(probe.id);
  if (std::find(known.begin(), known.end(), channel.id) == known.end()) {
    const std::string nearest = nearest_of(channel.id, known);
    return bad_input(channel.where + ": \"" + channel.id + "\" is no probe of " + rig.source +
                     " and not \"" + kEncoderChannel + "\"" +
                     (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  }
  for (const auto& other : before) {
    if (other.id == channel.id)
      return bad_input(channel.where + ": a second input for \"" + channel.id + "\"");
    if (other.input == channel.input)
      return bad_input(channel.where + ": input \"" + channel.input + "\" is \"" + other.id +
                       "\" already");
  }
  return {};
}

void read_offset(TomlTable& table, ChannelInput& channel) {
  if (!table.has("offset_mm")) return;
  channel.offset_mm = table.number("offset_mm", 0);
  if (channel.id != kEncoderChannel)
    table.reject("offset_mm", "is of the encoder; what a probe is off by is offset_um in the rig");
  if (!(std::abs(*channel.offset_mm) <= kMostOffset_mm))
    table.reject("offset_mm", "must be a position of the axis in mm");
}

}  // namespace

Result<std::vector<ChannelInput>> read_channels(TomlTable& device, const Rig& rig,
                                                const ChannelKeys& more) {
  std::vector<ChannelInput> channels;
  for (TomlTable& table : device.tables("channel")) {
    ChannelInput channel;
    channel.where = table.where("id");
    channel.id = table.string("id");
    channel.input = table.string("input");
    channel.um_per_count = table.number("um_per_count", 0);
    if (!std::isfinite(channel.um_per_count)) table.reject("um_per_count", "must be finite");
    read_offset(table, channel);
    if (more) more(table);
    MDOF_CHECK(check_id(channel, channels, rig));
    channels.push_back(std::move(channel));
  }
  if (channels.empty()) {
    device.reject("channel", "is missing; add [[axis.device.channel]] with id and input");
    MDOF_CHECK(device.finish());
  }
  return channels;
}

std::vector<std::string> ids_of(const std::vector<ChannelInput>& channels) {
  std::vector<std::string> ids;
  for (const auto& channel : channels) ids.push_back(channel.id);
  return ids;
}

bool counts_at(const std::vector<ChannelInput>& channels,
               const std::vector<std::string>& counters) {
  return std::any_of(channels.begin(), channels.end(), [&](const ChannelInput& channel) {
    return channel.id == kEncoderChannel &&
           std::find(counters.begin(), counters.end(), channel.input) != counters.end();
  });
}

EncoderOrigin encoder_origin(const std::vector<ChannelInput>& channels, bool counts) {
  for (const auto& channel : channels)
    if (channel.id == kEncoderChannel) return {counts, channel.offset_mm};
  return {};
}

tl::unexpected<Error> no_such_input(const ChannelInput& channel,
                                    const std::vector<std::string>& inputs) {
  std::string known;
  for (const auto& input : inputs) known += (known.empty() ? "" : ", ") + input;
  return bad_input(channel.where + ": the device has no input \"" + channel.input + "\"; it has " +
                   known);
}

Status check_um_per_count(const ChannelInput& channel) {
  if (channel.um_per_count != 0) return {};
  return bad_input(channel.where +
                   ": a counting encoder needs um_per_count, negative where it "
                   "counts down as d grows");
}

}  // namespace mdof::drivers
