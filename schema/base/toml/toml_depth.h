// Finds the nesting depth of a TOML document from its text, before the document is parsed. The
// parser limits the depth of nested values, but not of the tables in a dotted key. The parser and
// the destructor of its tree are recursive: each level needs stack memory.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace mdof {

inline constexpr std::size_t kMaxTomlDepth = 32;  // deeper than any document that mdof reads

// Number (1, 2, ...) of the first line in which the depth exceeds `bound`; nullopt: no such line.
// The depth is the number of open brackets and braces, plus the number of dots in the keys before a
// value.
std::optional<std::size_t> toml_line_over_depth(std::string_view text, std::size_t bound);

}  // namespace mdof
