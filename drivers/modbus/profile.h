// Profile of a Modbus device from a TOML file: its connection, its values and its status bits.
// drivers/README.md describes the format; the files in drivers/modbus/profiles are built in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/io/byte_stream.h"
#include "drivers/modbus/protocol.h"
#include "schema/base/result.h"
#include "schema/sample.h"

namespace mdof::drivers::modbus {

enum class Type { u16, i16, u32, i32, f32 };
inline int registers_of(Type type) {
  return type == Type::u16 || type == Type::i16 ? 1 : 2;
}

struct Register {
  Function function = kReadHolding;  // kReadHolding, kReadInput
  int address = 0;                   // address on the wire: 0 is 40001 or 30001 of manuals
  bool operator==(const Register&) const = default;
};

// A register that must have this value; otherwise the device is not the intended one.
struct Check {
  Register at;
  std::uint16_t mask = 0xFFFF, equals = 0;
  std::string says;  // message if the value differs
};

struct Value {
  std::string name;  // the `input` of a channel
  Register at;
  Type type = Type::u16;
  bool low_word_first = false;
  double scale = 1, offset = 0;    // value = raw * scale + offset
  Unit unit = Unit::other;         // of the value; `other`: a count that is converted to µm
  double um_per_count = 0;         // if the channel does not give it; 0: the channel must
  bool incremental = false;        // counts from the position at which it was switched on
  int ring_bits = 0;               // the counter wraps at 2^bits; 0: it does not
  std::vector<double> over_range;  // raw numbers at the ends of the range
  std::optional<Check> check;      // checked if the value is used
};

// If any of these status bits is set, the quality of the values is `makes` or worse.
struct StatusBits {
  Register at;
  std::uint16_t mask = 0;
  Quality makes = Quality::suspect;  // suspect, over_range, missing
  std::vector<std::string> values;   // by name; empty: all
};

struct Profile {
  std::string name;  // "Lika SMAX"
  Framing framing = Framing::tcp;
  int port = 502, unit = 1;
  SerialSettings serial;
  double poll_ms = 100, response_timeout_ms = 100;
  int join_gap = 0;  // highest number of unused registers that are read between two values
  std::vector<Value> values;
  std::vector<StatusBits> statuses;
  std::vector<Check> checks;
};

Result<Profile> parse_profile(std::string_view text, const std::string& source_name);
// Loads a built-in profile by its name, or a file if the name contains a slash or ends in ".toml"
// (relative to `base_path`). Errors: no such profile (the message names the nearest and all
// others), no such file, invalid contents.
Result<Profile> load_profile(const std::string& name_or_path, const std::string& base_path);

struct BuiltInProfile {
  const char* name;  // "lika-smax"
  const char* text;
};
std::span<const BuiltInProfile> built_in_profiles();

}  // namespace mdof::drivers::modbus
