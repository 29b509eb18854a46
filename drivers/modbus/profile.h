// What a Modbus device looks like, in a TOML file: its line, its values, what its status bits mean.
// The form is described in drivers/README.md; those of drivers/modbus/profiles are built in.
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
  int address = 0;                   // as on the wire: 0 is 40001 or 30001 of manuals
  bool operator==(const Register&) const = default;
};

// A register that must read so, or the device is not the one that was meant.
struct Check {
  Register at;
  std::uint16_t mask = 0xFFFF, equals = 0;
  std::string says;  // what it means where it differs
};

struct Value {
  std::string name;  // the `input` of a channel
  Register at;
  Type type = Type::u16;
  bool low_word_first = false;
  double scale = 1, offset = 0;    // value = raw * scale + offset
  Unit unit = Unit::other;         // of the value; `other` is a count, to become µm
  double um_per_count = 0;         // where the channel does not say; 0: it must
  bool incremental = false;        // counts from where it was switched on
  int ring_bits = 0;               // the counter wraps at 2^bits; 0: it does not
  std::vector<double> over_range;  // raw numbers at the ends of the range
  std::optional<Check> check;      // when the value is used
};

// Bits of which any that is set spoils values.
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
  int join_gap = 0;  // registers between two that may be read along with them
  std::vector<Value> values;
  std::vector<StatusBits> statuses;
  std::vector<Check> checks;
};

Result<Profile> parse_profile(std::string_view text, const std::string& source_name);
// A built-in profile by its name, or a file: whatever has a slash or ends in ".toml", relative to
// `base_path`. Errors: no such profile (with the nearest, and all), no such file, its contents.
Result<Profile> load_profile(const std::string& name_or_path, const std::string& base_path);

struct BuiltInProfile {
  const char* name;  // "lika-smax"
  const char* text;
};
std::span<const BuiltInProfile> built_in_profiles();

}  // namespace mdof::drivers::modbus
