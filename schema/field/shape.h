// The shape of a result: a short text with the members of an object, next to the code that writes
// it. With the rows of field.h it becomes a JSON Schema.
//
//   {run, axis, note?, points: [point], E{linear}{axis}_um, u: errors, ...header}
//
// A member has the type of its row or the type after the colon: an object, an array [...], a named
// shape of shapes.inc, or several with "|". "?": the member may be absent. "!": the member is never
// null, although its row states a null that other documents have. A name with groups stands for one
// or more members. "...header": the members of this shape; "...header?": they may be absent. "*":
// other members are allowed; "*: number": other members of this type.
#pragma once

#include <string>
#include <string_view>

namespace mdof {

// A draft 7 schema as JSON text. An invalid shape or a name without a row is a bug.
std::string json_schema(std::string_view shape);

}  // namespace mdof
