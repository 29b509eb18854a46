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
  std::string id;     // id of a probe in the rig, or "encoder"
  std::string input;  // name of the input at the device: "AIN0", "1", "encoder2"
  // length of a count of a counting encoder; negative if the count decreases when the position
  // increases; 0: not given
  double um_per_count = 0;
  std::string where;  // "mdofd.toml:12: axis.device.channel.input", for messages
  std::optional<double> offset_mm = std::nullopt;  // encoder only: added to the measured position
  // Encoder only: position of the axis at the reference mark.
  std::optional<double> index_mm = std::nullopt;
  std::string index_where = {};
  // empty: the channel belongs to the main axis; otherwise it belongs to this further axis.
  std::optional<Axis> further = std::nullopt;
};

// Reads the `channel` tables of a device. `more` reads the keys that only this driver has in each
// channel table, and may reject them. Errors: the device has no channel; an id is neither a probe
// of the rig (the message names the most similar id) nor "encoder"; an id or an input occurs twice.
using ChannelKeys = std::function<void(TomlTable& channel)>;
Result<std::vector<ChannelInput>> read_channels(TomlTable& device, const Rig& rig,
                                                const ChannelKeys& more = {});

// A further axis whose probes or encoder are connected to the device of another axis.
struct FurtherAxis {
  Rig rig;
  TomlTable table;  // contains the `channel` tables of the axis: [[axis.device.channel]]
};
// Name of a channel of a further axis among the channels of the device: "encoder_Y".
std::string further_id(const std::string& id, Axis axis);
// Appends the channels of the further axes to `channels`, under the names that further_id()
// returns. Errors as in read_channels().
Status read_further_channels(std::vector<FurtherAxis> axes, const ChannelKeys& more,
                             std::vector<ChannelInput>& channels);

// The channels of a device that belong to one axis: name at the device -> name in the rig of this
// axis. Empty: all channels of the device belong to the axis and keep their names.
using ChannelPart = std::map<std::string, std::string>;
std::vector<Channel> channels_for_axis(std::vector<Channel> channels, const ChannelPart& part);

// Ids of the channels, for DriverSpec::channels.
std::vector<std::string> ids_of(const std::vector<ChannelInput>& channels);

// Whether the encoder `id` is connected to one of the inputs `counters`. Only an encoder at a
// counter can lose its datum; an encoder with a voltage output cannot.
bool is_at_counter(const std::vector<ChannelInput>& channels,
                   const std::vector<std::string>& counters,
                   const std::string& id = kEncoderChannel);
// Origin of the encoder `id`. `counts`: true if the encoders of this driver count from the position
// at which they were switched on.
EncoderOrigin encoder_origin(const std::vector<ChannelInput>& channels, bool counts,
                             const std::string& id = kEncoderChannel);
// Origins of the encoders of further axes, by the name of the channel.
std::map<std::string, EncoderOrigin> further_encoders(const std::vector<ChannelInput>& channels,
                                                      const std::vector<FurtherAxis>& axes,
                                                      const std::vector<std::string>& counters);

// Returns the error that the device has no such input. The message lists the inputs of the device.
tl::unexpected<Error> no_such_input(const ChannelInput& channel,
                                    const std::vector<std::string>& inputs);
// For a device whose readings increase with the gap. Error: the rig does not state `reads` of a
// connected probe. The default, "displacement", would change the sign of all errors.
Status check_reads_stated(const std::vector<ChannelInput>& channels, const Rig& rig);
// Error: um_per_count is 0, but a counting encoder needs it.
Status check_um_per_count(const ChannelInput& channel);

}  // namespace mdof::drivers
