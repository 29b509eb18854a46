// The names in the documents that mdof and mdofd write. Each row has the type of a name, the
// meaning of null and the meaning of the name. A name has one meaning in JSON and CSV; if the
// meaning depends on the document, its row states each meaning. The result schemas of rpc.discover
// and the manual's list of fields are made from these rows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mdof {

// A name ends with its unit. Groups stand for letters: {linear} is X, Y or Z; {angular} is A, B or
// C; {axis} is any of the six; {small} is x, y or z; {approach} is forward, reverse or mean;
// {probe} is the id of a probe (A, B2), {number} a number; {field} at the end is the name of
// another row; {figure} is the name of a result (EYX_straightness_um).
struct Field {
  std::string_view name;
  std::string_view type;  // JSON type: "number", "[string]" (array), "number|object" (either)
  std::string_view null;  // meaning of null; empty: never null
  std::string_view meaning;
};

// The row of a name, with its meaning for this name.
struct KnownField {
  const Field* row;
  std::string meaning;
};

std::span<const Field> fields();  // in the order of topics

// Finds the row of a name in a document, "u_EYX_um", or of a row itself, "u_{field}".
std::optional<KnownField> find_field(std::string_view name);

// A regular expression of ECMAScript, as in JSON Schema; without {field}.
std::string field_regex(std::string_view name);

}  // namespace mdof
