// How deep a TOML document nests, found from its text before anything is built from it: the parser
// bounds values within values, but not the tables that a dotted key makes, and both it and the
// destructor of its tree go down a level of the stack for each.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace mdof {

inline constexpr std::size_t kMaxTomlDepth = 32;  // deeper than anything that mdof reads

// The line (1, 2, ...) where the document goes deeper than `bound`; nothing where it never does.
// Counted are brackets and braces that are open and the dots of the keys before a value.
std::optional<std::size_t> toml_line_deeper_than(std::string_view text, std::size_t bound);

}  // namespace mdof
