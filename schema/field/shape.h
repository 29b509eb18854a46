// The shape of a result: which members an object has, as a short text beside the code that writes
// it. With the rows of field.h it becomes a JSON Schema.
//
//   {run, axis, note?, points: [point], E{linear}{axis}_um, u: errors, ...header}
//
// A member has the type of its row, or the one behind the colon: an object, an array [...], a named
// shape of shapes.inc, or several with "|". "?": it may be absent. A name with groups stands for
// one member or more. "...header": the members of that shape; "...header?": they may be absent.
// "*": other members, too; "*: number": of that type.
#pragma once

#include <string>
#include <string_view>

namespace mdof {

// A draft 7 schema as JSON text. A shape that cannot be read, or a name without a row, is a bug.
std::string json_schema(std::string_view shape);

}  // namespace mdof
