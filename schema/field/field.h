// A list of all names of members and columns in the JSON and CSV documents that mdof and mdofd
// write. Each row states the type of a name, the meaning of null and the meaning of the name. A
// name has the same meaning in JSON and CSV. If the meaning depends on the document, the row states
// each meaning. The result schemas of rpc.discover and the list of fields in the manual are
// generated from these rows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mdof {

// A name ends with its unit. A group in a name stands for one of several texts:
// - {linear}: X, Y or Z
// - {angular}: A, B or C
// - {axis}: one of these six letters
// - {small}: x, y or z
// - {approach}: forward, reverse or mean
// - {probe}: the id of a probe (A, B2)
// - {number}: a number
// - {field}, at the end: the name of another row
// - {figure}: the name of a result (EYX_straightness_um)
struct Field {
  std::string_view name;
  std::string_view type;  // JSON type: "number", "[string]" (array), "number|object" (either)
  std::string_view null;  // meaning of null; empty: never null
  std::string_view meaning;
};

// The row of a name, and the meaning of this name.
struct KnownField {
  const Field* row;
  std::string meaning;
};

std::span<const Field> fields();  // in the order of field.cpp

// Finds the row of a name in a document ("u_EYX_um"), or the row with this name ("u_{field}").
std::optional<KnownField> find_field(std::string_view name);

// Returns an ECMAScript regular expression, as in JSON Schema, for a name without {field}.
std::string field_regex(std::string_view name);

}  // namespace mdof
