// A shape is a short text that lists the members of a JSON object. It is next to the code that
// writes the object. json_schema() converts it to a JSON Schema by means of the rows of field.h.
//
//   {run, axis, note?, points: [point], E{linear}{axis}_um, u: errors, ...header}
//
// Syntax:
// - name: a member with the type of its row; a name with groups stands for one or more members
// - name: type: a member with this type, which is an object {...}, an array [...], a named shape of
//   shapes.inc, or several of them with "|" between them
// - "?": the member may be absent
// - "!": the member is never null, although its row states a meaning of null, because other
//   documents can have null
// - "...header": all members of the named shape "header"; "...header?": these members may be absent
// - "*": other members are allowed; "*: number": other members of this type are allowed
#pragma once

#include <string>
#include <string_view>

namespace mdof {

// Returns a JSON Schema (draft 7) as text. An invalid shape or a name without a row is a bug.
std::string json_schema(std::string_view shape);

}  // namespace mdof
