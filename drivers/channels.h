// Assigns inputs of a device to channels of the rig: [[axis.device.channel]].
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"
#include "schema/sample.h"

namespace mdof::drivers {

struct ChannelInput {
  std::string id;           // a probe of the rig, or "encoder"
  std::string input;        // name of the input at the device: "AIN0", "1", "encoder2"
  double um_per_count = 0;  // signed, of a counting encoder; 0: not given
  std::string where;        // "mdofd.toml:12: axis.device.channel.input", for messages
  std::optional<double> offset_mm = std::nullopt;  // encoder only: added to its position
  std::optional<double> index_mm = std::nullopt;   // encoder only: position of its mark
  std::string index_where = {};
  std::optional<Axis> further = std::nullopt;  // set for a channel of this further axis
};

// Reads the `channel` tables of a device. Errors: no channel; an id that is neither a probe of the
// rig (the message names the nearest) nor "encoder"; an id or an input that is given twice. `more`
// reads the keys of each channel's table that only this driver has, and may reject them.
using ChannelKeys = std::function<void(TomlTable& channel)>;
Result<std::vector<ChannelInput>> read_channels(TomlTable& device, const Rig& rig,
                                                const ChannelKeys& more = {});

// Another axis that uses channels of the same device, in addition to the channels that both axes
// use.
struct FurtherAxis {
  Rig rig;
  TomlTable table;  // contains the `channel` tables of the axis: [[axis.device.channel]]
};
// Name of a further axis' channel among the channels of the device: "encoder_Y".
std::string further_id(const std::string& id, Axis axis);
// Appends the channels of further axes to `channels`, with these names. Errors as in
// read_channels().
Status read_further_channels(std::vector<FurtherAxis> axes, const ChannelKeys& more,
                             std::vector<ChannelInput>& channels);

// The channels of a device that belong to one axis: name at the device -> name in the rig of the
// axis. Empty: all channels belong to the axis and keep their names.
using ChannelPart = std::map<std::string, std::string>;
std::vector<Channel> channels_for_axis(std::vector<Channel> channels, const ChannelPart& part);

// For DriverSpec::channels.
std::vector<std::string> ids_of(const std::vector<ChannelInput>& channels);

// Whether the encoder `id` is at one of the inputs `counters`. Only a counter can lose its datum;
// an encoder in volts cannot.
bool is_at_counter(const std::vector<ChannelInput>& channels,
                   const std::vector<std::string>& counters,
                   const std::string& id = kEncoderChannel);
// Origin of the encoder `id`. `counts`: encoders of this driver count from the position at which
// they were switched on.
EncoderOrigin encoder_origin(const std::vector<ChannelInput>& channels, bool counts,
                             const std::string& id = kEncoderChannel);
// Origins of the encoders of further axes, by channel.
std::map<std::string, EncoderOrigin> further_encoders(const std::vector<ChannelInput>& channels,
                                                      const std::vector<FurtherAxis>& axes,
                                                      const std::vector<std::string>& counters);

// Error: the device has no such input. The message lists the inputs of the device.
tl::unexpected<Error> no_such_input(const ChannelInput& channel,
                                    const std::vector<std::string>& inputs);
// Error if um_per_count is 0; a counting encoder needs it.
Status check_um_per_count(const ChannelInput& channel);

}  // namespace mdof::drivers
