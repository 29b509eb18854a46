// Where an encoder's positions are counted from: known, or not.
#pragma once

#include <string>

namespace mdof {

// What was added to the positions that a device showed, and by whose word. Recorded samples have it
// in them already.
struct EncoderDatum {
  enum class Kind {
    absolute,    // the device knows its positions by itself
    none,        // it counts from where it was switched on, wherever that was
    configured,  // offset_mm of its channel in the configuration
    set,         // somebody said where the axis stood: encoder.set
  };
  Kind kind = Kind::absolute;
  double offset_m = 0;
  std::string device;   // whose encoder it is; empty where it is absolute
  std::string utc, by;  // of one that was set
  bool operator==(const EncoderDatum&) const = default;
};
const char* to_string(EncoderDatum::Kind kind);
bool datum_kind_from(const std::string& name, EncoderDatum::Kind& kind);

// For people, of a run; "" where positions are known.
std::string datum_note(EncoderDatum::Kind kind, const std::string& device);

}  // namespace mdof
