// Where an encoder's positions are counted from: known, or not.
#pragma once

#include <cstdint>
#include <string>

#include "schema/axis.h"
#include "schema/notice/notice.h"

namespace mdof {

// What was added to the positions that a device showed, and by whose word. Recorded samples have it
// in them already.
struct EncoderDatum {
  enum class Kind {
    absolute,    // the device knows its positions by itself
    none,        // it counts from where it was switched on, wherever that was
    configured,  // offset_mm of its channel in the configuration
    set,         // somebody said where the axis stood: encoder.set
    index,       // the axis went over the encoder's reference mark: index_mm of its channel
  };
  Kind kind = Kind::absolute;
  double offset_m = 0;
  std::string device;   // whose encoder it is; empty where it is absolute
  std::string utc, by;  // of one that was set; `utc`: when the mark was passed, too
  bool operator==(const EncoderDatum&) const = default;
};
const char* to_string(EncoderDatum::Kind kind);
bool datum_kind_from(const std::string& name, EncoderDatum::Kind& kind);

// What a reader of positions should know: `datum_missing`, or none where they are known.
Notices datum_notices(const EncoderDatum& datum);
// For people: "index at 12.5 mm, passed on 2026-11-23T07:00:00Z"; "" of Kind::none, which has its
// notice, and of Kind::absolute.
std::string datum_text(const EncoderDatum& datum);

// What encoder.set said of an axis once, as it is stored.
struct DatumSetting {
  std::int64_t id = 0;  // given when it is stored
  Axis axis = Axis::x;
  std::string device;     // whose encoder it is
  double before_m = 0;    // where it stood by what held until then
  double position_m = 0;  // where it stands
  double offset_m = 0;    // added to what the device shows from then on
  std::string utc;
  bool operator==(const DatumSetting&) const = default;
};
// For people: "X stands at 12.5 mm; until then it was at 0.031 mm".
std::string setting_text(const DatumSetting& setting);

}  // namespace mdof
