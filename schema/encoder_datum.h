// Origin of the positions of an encoder.
#pragma once

#include <cstdint>
#include <string>

#include "schema/axis.h"
#include "schema/notice/notice.h"

namespace mdof {

// The offset added to the positions that a device reads, and its origin. Recorded samples already
// include the offset.
struct EncoderDatum {
  enum class Kind {
    absolute,    // the device measures absolute positions
    none,        // positions count from where the device was switched on, which is unknown
    configured,  // offset_mm of the channel in the configuration
    set,         // a person set the position of the axis (encoder.set)
    index,       // the axis passed the reference mark of the encoder: index_mm of its channel
  };
  Kind kind = Kind::absolute;
  double offset_m = 0;
  std::string device;  // device of the encoder; empty for `absolute`
  // For `set`: when and by whom. `utc` also for `index`: when the mark was passed.
  std::string utc, by;
  bool operator==(const EncoderDatum&) const = default;
};
const char* to_string(EncoderDatum::Kind kind);
bool datum_kind_from(const std::string& name, EncoderDatum::Kind& kind);

// `datum_missing` if the positions are unknown (Kind::none), otherwise no notice.
Notices datum_notices(const EncoderDatum& datum);
// Text for people: "reference mark at 12.5 mm, passed on 2026-11-23T07:00:00Z"; "" for Kind::none,
// which has its notice, and for Kind::absolute.
std::string datum_text(const EncoderDatum& datum);

// A position set by encoder.set, as stored.
struct DatumSetting {
  std::int64_t id = 0;  // 0 until stored
  Axis axis = Axis::x;
  std::string device;     // device of the encoder
  double before_m = 0;    // position of the axis with the previous offset
  double position_m = 0;  // position of the axis as set
  double offset_m = 0;    // added to the readings of the device from now on
  std::string utc;
  bool operator==(const DatumSetting&) const = default;
};
// Text for people: "X set to 12.5 mm; the position before was 0.031 mm".
std::string setting_text(const DatumSetting& setting);

}  // namespace mdof
