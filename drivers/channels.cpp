#include "drivers/channels.h"

#include <algorithm>
#include <cmath>

namespace mdof::drivers {
namespace {

constexpr double kMostOffset_mm = 1e6;  // 1 km, longer than any machine axis

Status check_id(const ChannelInput& channel, const Rig& rig) {
  std::vector<std::string> known = {kEncoderChannel};
  for (const Probe& probe : rig.probes) known.push_back(probe.id);
  if (std::find(known.begin(), known.end(), channel.id) != known.end()) return {};
  const std::string nearest = nearest_candidate(channel.id, known);
  return bad_input(channel.where + ": \"" + channel.id + "\" is neither a probe of " + rig.source +
                   " nor \"" + kEncoderChannel + "\"" +
                   (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

Status check_once(const ChannelInput& channel, const std::vector<ChannelInput>& before) {
  for (const auto& other : before) {
    if (other.id == channel.id)
      return bad_input(channel.where + ": channel \"" + channel.id +
                       "\" has a second input; give each channel one input");
    if (other.input == channel.input)
      return bad_input(channel.where + ": input \"" + channel.input + "\" is already used by \"" +
                       other.id + "\"; give each channel its own input");
  }
  return {};
}

void read_index(TomlTable& table, ChannelInput& channel) {
  if (!table.has("index_mm")) return;
  channel.index_mm = table.number("index_mm", 0);
  channel.index_where = table.where("index_mm");
  if (channel.id != kEncoderChannel)
    table.reject(
        "index_mm",
        "applies to the encoder only (index_mm is the axis position at the reference mark); remove "
        "index_mm from this channel");
  if (table.has("offset_mm"))
    table.reject("index_mm",
                 "contradicts offset_mm, because positions are counted from the reference mark; "
                 "give only one of the two keys");
  if (!(std::abs(*channel.index_mm) <= kMostOffset_mm))
    table.reject("index_mm", "must be a position of the axis, from -1000000 to 1000000 mm");
}

void read_offset(TomlTable& table, ChannelInput& channel) {
  if (!table.has("offset_mm")) return;
  channel.offset_mm = table.number("offset_mm", 0);
  if (channel.id != kEncoderChannel)
    table.reject("offset_mm",
                 "applies to the encoder only; give the offset of a probe as offset_um in the rig");
  if (!(std::abs(*channel.offset_mm) <= kMostOffset_mm))
    table.reject("offset_mm", "must be a position of the axis, from -1000000 to 1000000 mm");
}

Result<ChannelInput> read_channel(TomlTable& table, const Rig& rig, const ChannelKeys& more) {
  ChannelInput channel;
  channel.where = table.where("id");
  channel.id = table.string("id");
  channel.input = table.string("input");
  channel.um_per_count = table.number("um_per_count", 0);
  if (!std::isfinite(channel.um_per_count)) table.reject("um_per_count", "must be a finite number");
  read_offset(table, channel);
  read_index(table, channel);
  if (more) more(table);
  MDOF_CHECK(check_id(channel, rig));
  return channel;
}

}  // namespace

Result<std::vector<ChannelInput>> read_channels(TomlTable& device, const Rig& rig,
                                                const ChannelKeys& more) {
  std::vector<ChannelInput> channels;
  for (TomlTable& table : device.tables("channel")) {
    MDOF_TRY(ChannelInput channel, read_channel(table, rig, more));
    MDOF_CHECK(check_once(channel, channels));
    channels.push_back(std::move(channel));
  }
  if (channels.empty()) {
    device.reject("channel", "is missing; add [[axis.device.channel]] with id and input");
    MDOF_CHECK(device.finish());
  }
  return channels;
}

std::string further_id(const std::string& id, Axis axis) {
  return id + "_" + letter(axis);
}

Status read_further_channels(std::vector<FurtherAxis> axes, const ChannelKeys& more,
                             std::vector<ChannelInput>& channels) {
  for (FurtherAxis& axis : axes) {
    for (TomlTable& table : axis.table.tables("channel")) {
      MDOF_TRY(ChannelInput channel, read_channel(table, axis.rig, more));
      channel.id = further_id(channel.id, axis.rig.axis);
      channel.further = axis.rig.axis;
      MDOF_CHECK(check_once(channel, channels));
      channels.push_back(std::move(channel));
    }
  }
  return {};
}

std::vector<Channel> channels_for_axis(std::vector<Channel> channels, const ChannelPart& part) {
  if (part.empty()) return channels;
  std::erase_if(channels, [&](const Channel& c) { return !part.contains(c.id); });
  for (Channel& channel : channels) channel.id = part.at(channel.id);
  return channels;
}

std::vector<std::string> ids_of(const std::vector<ChannelInput>& channels) {
  std::vector<std::string> ids;
  for (const auto& channel : channels) ids.push_back(channel.id);
  return ids;
}

bool is_at_counter(const std::vector<ChannelInput>& channels,
                   const std::vector<std::string>& counters, const std::string& id) {
  return std::any_of(channels.begin(), channels.end(), [&](const ChannelInput& channel) {
    return channel.id == id &&
           std::find(counters.begin(), counters.end(), channel.input) != counters.end();
  });
}

EncoderOrigin encoder_origin(const std::vector<ChannelInput>& channels, bool counts,
                             const std::string& id) {
  for (const auto& channel : channels)
    if (channel.id == id) return {counts, channel.offset_mm, channel.index_mm, channel.index_where};
  return {};
}

std::map<std::string, EncoderOrigin> further_encoders(const std::vector<ChannelInput>& channels,
                                                      const std::vector<FurtherAxis>& axes,
                                                      const std::vector<std::string>& counters) {
  std::map<std::string, EncoderOrigin> encoders;
  for (const FurtherAxis& axis : axes) {
    const std::string id = further_id(kEncoderChannel, axis.rig.axis);
    encoders[id] = encoder_origin(channels, is_at_counter(channels, counters, id), id);
  }
  return encoders;
}

tl::unexpected<Error> no_such_input(const ChannelInput& channel,
                                    const std::vector<std::string>& inputs) {
  std::string known;
  for (const auto& input : inputs) known += (known.empty() ? "" : ", ") + input;
  return bad_input(channel.where + ": the device has no input \"" + channel.input +
                   "\"; the inputs of the device are " + known);
}

Status check_reads_stated(const std::vector<ChannelInput>& channels, const Rig& rig) {
  for (const ChannelInput& channel : channels) {
    const auto probe = rig.probe_index(channel.id);
    if (!probe || rig.probes[*probe].calibration.reads_stated) continue;
    return bad_input(channel.where + ": the readings of this device increase with the gap, and " +
                     rig.source + " does not state `reads` of probe \"" + channel.id +
                     "\"; add reads = \"gap\" to this probe (or reads = \"displacement\" if the "
                     "device converts the gap)");
  }
  return {};
}

Status check_um_per_count(const ChannelInput& channel) {
  if (channel.um_per_count != 0) return {};
  return bad_input(channel.where +
                   ": a counting encoder needs um_per_count, the motion per count in um (negative "
                   "if the count decreases when the axis position increases)");
}

}  // namespace mdof::drivers
