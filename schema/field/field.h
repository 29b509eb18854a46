// The names that results use: one row a name says its type, what null means and what it means. A
// name has one meaning in JSON and CSV; where an older name has two, its row says both. From these
// rows come the result schemas of rpc.discover and the manual's list of fields.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mdof {

// A name ends in its unit. Groups stand for letters: {linear} is X, Y or Z; {angular} is A, B or
// C; {axis} is any of the six; {small} is x, y or z; {approach} is forward, reverse or mean;
// {probe} is the id of a probe (A, B2), {number} a number; {field} at the end is the name of
// another row; {figure} is the name of a result (EYX_straightness_um).
struct Field {
  std::string_view name;
  std::string_view type;  // of JSON: "number", "[string]" (array), "number|object" (either)
  std::string_view null;  // what null means; empty: it is never null
  std::string_view meaning;
};

// The row of a name, with the name in place of {field}.
struct KnownField {
  const Field* row;
  std::string meaning;
};

std::span<const Field> fields();  // by topic

// Of a name as it stands in a document, "u_EYX_um", or of a row itself, "u_{field}".
std::optional<KnownField> find_field(std::string_view name);

// ECMAScript, as JSON Schema has it; without {field}.
std::string regex_of(std::string_view name);

}  // namespace mdof
