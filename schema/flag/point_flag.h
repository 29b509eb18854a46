// Flags of a point. A flag states an event of the point or of one of its channels.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

enum class Flag {
#define FLAG(flag) flag,
#include "schema/flag/point_flags.inc"
#undef FLAG
};
const char* to_string(Flag flag);  // "spike"

struct PointFlag {
  Flag flag{};
  std::string channel = {};  // id of a probe, or "encoder"; empty: the whole point
  bool operator==(const PointFlag&) const = default;
};
std::string to_string(const PointFlag& flag);  // "spike:A"; this text is stored and shown
std::string to_string(const std::vector<PointFlag>& flags);  // with a space between two flags
std::vector<std::string> flag_texts(const std::vector<PointFlag>& flags);
Result<PointFlag> point_flag_from(std::string_view text);  // error (bad_input): unknown flag

}  // namespace mdof
