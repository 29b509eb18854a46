#include "drivers/modbus/profile.h"

#include <algorithm>
#include <filesystem>

#include "schema/base/files.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers::modbus {
namespace {

template <class T>
struct Word {
  const char* word;
  T means;
};

// Returns the value that belongs to the word at `key`. If the key is missing, returns the value of
// the first word.
template <class T, std::size_t N>
T choice(TomlTable& table, const char* key, const Word<T> (&words)[N]) {
  const std::string given = table.string(key, words[0].word);
  std::string known;
  for (const auto& [word, means] : words) {
    if (given == word) return means;
    known += std::string(known.empty() ? "" : ", ") + word;
  }
  table.reject(key, "\"" + given + "\" is not one of " + known);
  return words[0].means;
}

int whole(TomlTable& table, const char* key, int fallback, int min, int max) {
  const auto value = table.integer(key, fallback);
  if (value < min || value > max)
    table.reject(key, "must be from " + std::to_string(min) + " to " + std::to_string(max));
  return static_cast<int>(value);
}

double milliseconds_of(TomlTable& table, const char* key, double fallback) {
  const double value = table.number(key, fallback);
  if (!(value >= 1 && value <= 60'000)) table.reject(key, "must be from 1 to 60000");
  return value;
}

Register read_register(TomlTable& table, Function function) {
  constexpr Word<Function> kFunctions[] = {{"holding", kReadHolding}, {"input", kReadInput}};
  if (table.has("registers")) function = choice(table, "registers", kFunctions);
  if (!table.has("address"))
    table.reject("address", "is missing; give the address of a register, from 0 to 65535");
  return {function, whole(table, "address", 0, 0, kLastAddress)};
}

Check read_check(TomlTable& table) {
  Check check;
  check.at = read_register(table, kReadHolding);
  check.mask = static_cast<std::uint16_t>(whole(table, "mask", 0xFFFF, 1, 0xFFFF));
  check.equals = static_cast<std::uint16_t>(whole(table, "equals", 0, 0, 0xFFFF));
  check.says = table.string("says");
  return check;
}

Value read_value(TomlTable& table) {
  constexpr Word<Type> kTypes[] = {{"u16", Type::u16},
                                   {"i16", Type::i16},
                                   {"u32", Type::u32},
                                   {"i32", Type::i32},
                                   {"f32", Type::f32}};
  constexpr Word<bool> kOrders[] = {{"high-first", false}, {"low-first", true}};
  constexpr Word<Unit> kUnits[] = {{"count", Unit::other},
                                   {"V", Unit::volt},
                                   {"um", Unit::um},
                                   {"mm", Unit::mm},
                                   {"C", Unit::deg_c}};
  Value value;
  value.name = table.string("name");
  value.at = read_register(table, kReadHolding);
  value.type = choice(table, "type", kTypes);
  value.low_word_first = choice(table, "words", kOrders);
  value.scale = table.number("scale", 1);
  if (value.scale == 0) table.reject("scale", "must not be 0");
  value.offset = table.number("offset", 0);
  value.unit = choice(table, "unit", kUnits);
  value.um_per_count = table.number("um_per_count", 0);
  value.ring_bits = whole(table, "ring_bits", 0, 0, 32);
  value.incremental = table.boolean("incremental", false);
  if (table.has("over_range")) value.over_range = table.numbers("over_range");
  if (auto check = table.table("check")) value.check = read_check(*check);
  if (value.ring_bits > 0 && value.type == Type::f32)
    table.reject("ring_bits", "applies to counters, not to the type \"f32\"; remove ring_bits");
  if (value.ring_bits > 16 * registers_of(value.type))
    table.reject("ring_bits", "must be at most " + std::to_string(16 * registers_of(value.type)) +
                                  " (the number of bits of the register)");
  if (value.at.address + registers_of(value.type) - 1 > kLastAddress)
    table.reject("address", "the value ends beyond register 65535");
  return value;
}

// A [[value]] with `count` becomes `count` values. In each name, "#" is replaced by a number.
void append_values(TomlTable& table, std::vector<Value>& values) {
  const Value one = read_value(table);
  const int count = whole(table, "count", 1, 1, 1000);
  const int first = whole(table, "first", 1, 0, 1000);
  const auto hash = one.name.find('#');
  if (count > 1 && hash == std::string::npos)
    table.reject("name",
                 "must contain \"#\", because the key \"count\" is given (the number of each value "
                 "replaces \"#\")");
  for (int i = 0; i < count; ++i) {
    Value value = one;
    if (hash != std::string::npos) value.name.replace(hash, 1, std::to_string(first + i));
    value.at.address += i * registers_of(one.type);
    if (value.check) value.check->at.address += i;
    if (value.at.address + registers_of(value.type) - 1 > kLastAddress)
      table.reject("count", "the last value ends beyond register 65535");
    values.push_back(std::move(value));
  }
}

StatusBits read_status(TomlTable& table, const std::vector<Value>& values) {
  constexpr Word<Quality> kQualities[] = {{"suspect", Quality::suspect},
                                          {"over-range", Quality::over_range},
                                          {"missing", Quality::missing}};
  StatusBits status;
  status.at = read_register(table, kReadHolding);
  status.mask = static_cast<std::uint16_t>(whole(table, "mask", 0, 0, 0xFFFF));
  if (status.mask == 0) table.reject("mask", "must have at least one bit set");
  status.makes = choice(table, "makes", kQualities);
  status.values = table.strings("values");
  for (const auto& name : status.values)
    if (std::none_of(values.begin(), values.end(), [&](auto& v) { return v.name == name; }))
      table.reject("values", "the profile has no value \"" + name + "\"");
  return status;
}

void read_line(TomlTable& table, Profile& profile) {
  constexpr Word<Framing> kFramings[] = {{"tcp", Framing::tcp}, {"rtu", Framing::rtu}};
  constexpr Word<char> kParities[] = {{"none", 'N'}, {"even", 'E'}, {"odd", 'O'}};
  profile.framing = choice(table, "protocol", kFramings);
  profile.port = whole(table, "port", 502, 1, 65535);
  profile.unit = whole(table, "unit", 1, 1, 255);
  profile.serial.baud = whole(table, "baud", 19200, 1, 10'000'000);
  profile.serial.parity = table.has("parity") ? choice(table, "parity", kParities) : 'E';
  profile.serial.stop_bits = whole(table, "stop_bits", 1, 1, 2);
  profile.poll_ms = milliseconds_of(table, "poll_ms", 100);
  profile.response_timeout_ms = milliseconds_of(table, "response_timeout_ms", 100);
  profile.join_gap = whole(table, "join_gap", 0, 0, kMostRegisters);
}

}  // namespace

Result<Profile> parse_profile(std::string_view text, const std::string& source_name) {
  MDOF_TRY(TomlTable table, TomlTable::parse(text, source_name));
  Profile profile;
  profile.name = table.string("name");
  read_line(table, profile);
  for (TomlTable& value : table.tables("value")) append_values(value, profile.values);
  if (profile.values.empty())
    table.reject("value", "is missing: a profile needs at least one [[value]]");
  for (TomlTable& status : table.tables("status"))
    profile.statuses.push_back(read_status(status, profile.values));
  for (TomlTable& check : table.tables("check")) profile.checks.push_back(read_check(check));
  for (std::size_t i = 0; i < profile.values.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (profile.values[i].name == profile.values[k].name)
        table.reject("value", "\"" + profile.values[i].name +
                                  "\" is given twice; give each value a different name");
  MDOF_CHECK(table.finish());
  return profile;
}

Result<Profile> load_profile(const std::string& name_or_path, const std::string& base_path) {
  std::vector<std::string> names;
  std::string known;
  for (const auto& [name, text] : built_in_profiles()) {
    if (name_or_path == name) return parse_profile(text, name + std::string(".toml"));
    names.emplace_back(name);
    known += std::string(known.empty() ? "" : ", ") + name;
  }
  if (name_or_path.find('/') == std::string::npos && !name_or_path.ends_with(".toml")) {
    const std::string nearest = nearest_candidate(name_or_path, names);
    return bad_input("unknown profile \"" + name_or_path + "\"" +
                     (nearest.empty() ? "." : "; did you mean \"" + nearest + "\"?") +
                     " Known profiles are " + known +
                     "; give one of these, or the path of your own profile");
  }
  const auto path = std::filesystem::path(base_path) / name_or_path;
  MDOF_TRY(const std::string text, read_text_file(path));
  return parse_profile(text, path.string());
}

}  // namespace mdof::drivers::modbus
