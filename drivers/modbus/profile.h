// Profile of a Modbus device, from a TOML file: its connection, its values and its status bits.
// drivers/README.md describes the format. The files in drivers/modbus/profiles are built into the
// program.
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
  int address = 0;  // address in the request: 0 is the register that manuals call 40001 or 30001
  bool operator==(const Register&) const = default;
};

// A register that must contain this value. Otherwise the device is not the intended device.
struct Check {
  Register at;
  std::uint16_t mask = 0xFFFF, equals = 0;
  std::string says;  // error message if the register contains another value
};

struct Value {
  std::string name;  // name of the value = `input` of a channel
  Register at;
  Type type = Type::u16;
  bool low_word_first = false;
  double scale = 1, offset = 0;  // value = raw * scale + offset
  Unit unit = Unit::other;       // unit of the value; `other`: counts, which are converted to µm
  double um_per_count = 0;   // used if the channel does not state it; 0: the channel must state it
  bool incremental = false;  // true: counts from the position at which the encoder was switched on
  int ring_bits = 0;         // the counter overflows at 2^ring_bits; 0: it does not overflow
  std::vector<double> over_range;  // raw numbers that mean an end of the range
  std::optional<Check> check;      // checked only if a channel uses this value
};

// If any of these status bits is set, the quality of the values is set to `makes`, unless it is
// already worse.
struct StatusBits {
  Register at;
  std::uint16_t mask = 0;
  Quality makes = Quality::suspect;  // suspect, over_range, missing
  std::vector<std::string> values;   // names of the values that the bits affect; empty: all values
};

struct Profile {
  std::string name;  // "Lika SMAX"
  Framing framing = Framing::tcp;
  int port = 502, unit = 1;
  SerialSettings serial;
  double poll_ms = 100, response_timeout_ms = 100;
  // largest number of unused registers that may be read between two used registers
  int join_gap = 0;
  std::vector<Value> values;
  std::vector<StatusBits> statuses;
  std::vector<Check> checks;
};

Result<Profile> parse_profile(std::string_view text, const std::string& source_name);
// Loads a built-in profile by its name. If the name contains a slash or ends in ".toml", loads a
// file; its path is relative to `base_path`. Errors: no such profile (the message names the most
// similar profile and all others); no such file; invalid contents.
Result<Profile> load_profile(const std::string& name_or_path, const std::string& base_path);

struct BuiltInProfile {
  const char* name;  // "lika-smax"
  const char* text;
};
std::span<const BuiltInProfile> built_in_profiles();

}  // namespace mdof::drivers::modbus
