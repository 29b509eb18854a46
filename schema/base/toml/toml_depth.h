// Nesting depth of a TOML document, found from its text before it is parsed. The parser limits
// nested values, but not the tables of a dotted key, and both the parser and the destructor of its
// tree recurse once for each level.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace mdof {

inline constexpr std::size_t kMaxTomlDepth = 32;  // deeper than any document that mdof reads

// The first line (1, 2, ...) where the depth exceeds `bound`; nullopt: none. The depth is the
// number of open brackets and braces plus the dots of the keys before a value.
std::optional<std::size_t> toml_line_over_depth(std::string_view text, std::size_t bound);

}  // namespace mdof
