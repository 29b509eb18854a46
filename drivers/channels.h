// Which input of a device is which channel of the rig: [[axis.device.channel]].
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
  std::string input;        // as the device calls it: "AIN0", "1", "encoder2"
  double um_per_count = 0;  // of an encoder that counts: signed; 0: not given
  std::string where;        // "mdofd.toml:12: axis.device.channel.input", for messages
  std::optional<double> offset_mm = std::nullopt;  // of the encoder: added to its position
  std::optional<double> index_mm = std::nullopt;   // of the encoder: where its mark is
  std::string index_where = {};
  std::optional<Axis> further = std::nullopt;  // of this further axis
};

// Reads `channel` of a device's table. Errors: none, an id that is no probe of the rig (with the
// nearest) nor "encoder", an id or an input given twice.
// `more` reads the keys that only this family has of each channel's table, and may reject.
using ChannelKeys = std::function<void(TomlTable& channel)>;
Result<std::vector<ChannelInput>> read_channels(TomlTable& device, const Rig& rig,
                                                const ChannelKeys& more = {});

// Another axis that takes channels of the same device, besides those that both have.
struct FurtherAxis {
  Rig rig;
  TomlTable table;  // its `channel`: [[axis.device.channel]]
};
// What a channel of it is called among those of the device: "encoder_Y".
std::string further_id(const std::string& id, Axis axis);
// Adds theirs to `channels`, under those names. Errors as of read_channels().
Status read_further_channels(std::vector<FurtherAxis> axes, const ChannelKeys& more,
                             std::vector<ChannelInput>& channels);

// The channels of a device that are for one of its axes, by what the device calls them, and what
// the rig of that axis does. Empty: all are, under their names.
using ChannelPart = std::map<std::string, std::string>;
std::vector<Channel> of_part(std::vector<Channel> channels, const ChannelPart& part);

// Of DriverSpec.
std::vector<std::string> ids_of(const std::vector<ChannelInput>& channels);

// Whether the encoder `id` is at one of these inputs, which count; volts at another have no
// beginning to lose.
bool counts_at(const std::vector<ChannelInput>& channels, const std::vector<std::string>& counters,
               const std::string& id = kEncoderChannel);
// Of the encoder `id` among them; `counts`: this family's encoders count from where they were
// switched on.
EncoderOrigin encoder_origin(const std::vector<ChannelInput>& channels, bool counts,
                             const std::string& id = kEncoderChannel);
// Of those of further axes, by channel.
std::map<std::string, EncoderOrigin> further_encoders(const std::vector<ChannelInput>& channels,
                                                      const std::vector<FurtherAxis>& axes,
                                                      const std::vector<std::string>& counters);

// The error that an input is unknown to the device, with those that it has.
tl::unexpected<Error> no_such_input(const ChannelInput& channel,
                                    const std::vector<std::string>& inputs);
// Needed of an encoder that counts.
Status check_um_per_count(const ChannelInput& channel);

}  // namespace mdof::drivers
