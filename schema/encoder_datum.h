// The relation between the positions of an encoder and the machine.
#pragma once

#include <cstdint>
#include <string>

#include "schema/axis.h"
#include "schema/notice/notice.h"

namespace mdof {

// The offset that is added to the positions that a device reads, and how the offset was found.
// Recorded samples already include the offset.
struct EncoderDatum {
  enum class Kind {
    absolute,    // the device measures absolute positions
    none,        // the device counts from the unknown position at which it was switched on
    configured,  // offset_mm of the channel in the configuration
    set,         // a user has set the position of the axis (encoder.set)
    // The axis has passed the reference mark of the encoder, whose position is index_mm of its
    // channel.
    index,
  };
  Kind kind = Kind::absolute;
  double offset_m = 0;
  std::string device;  // device of the encoder; empty for `absolute`
  // Kind::set: time and user of the setting. Kind::index: `utc` is the time at which the mark was
  // passed.
  std::string utc, by;
  bool operator==(const EncoderDatum&) const = default;
};
const char* to_string(EncoderDatum::Kind kind);
bool datum_kind_from(const std::string& name, EncoderDatum::Kind& kind);

// The notice `datum_missing` if the positions are unknown (Kind::none); otherwise no notice.
Notices datum_notices(const EncoderDatum& datum);
// Text for people: "reference mark at 12.5 mm, passed on 2026-11-23T07:00:00Z". "" for
// Kind::absolute, and for Kind::none, for which datum_notices() returns a notice.
std::string datum_text(const EncoderDatum& datum);

// A position that was set with encoder.set, as stored in the database.
struct DatumSetting {
  std::int64_t id = 0;  // 0: not stored yet
  Axis axis = Axis::x;
  std::string device;     // device of the encoder
  double before_m = 0;    // position of the axis before the setting
  double position_m = 0;  // position of the axis after the setting
  double offset_m = 0;    // offset that is added to the readings of the device after the setting
  std::string utc;
  bool operator==(const DatumSetting&) const = default;
};
// Text for people: "X set to 12.5 mm; the position before was 0.031 mm".
std::string setting_text(const DatumSetting& setting);

}  // namespace mdof
