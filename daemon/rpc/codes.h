// The error codes of the RPC interface: one table, used in both directions.
#pragma once

#include <span>

#include "schema/base/result.h"

namespace mdof::rpc {

// Codes of the JSON-RPC 2.0 specification.
inline constexpr int kParseError = -32700;
inline constexpr int kInvalidRequest = -32600;
inline constexpr int kMethodNotFound = -32601;
inline constexpr int kInvalidParams = -32602;
inline constexpr int kInternalError = -32603;
// Codes of this server.
inline constexpr int kBusy = -32000;  // too many connections; the connection is closed after this
                                      // line
inline constexpr int kChanged = -32001;    // generation changed: read again, then decide
inline constexpr int kConflict = -32002;   // not possible now: a run is in progress, the axis moves
inline constexpr int kForbidden = -32003;  // this transport allows only reading
inline constexpr int kNotFound = -32004;   // the named run, table, device does not exist
inline constexpr int kBadInput = -32010;   // a file, a document or a value in it
inline constexpr int kIo = -32011;         // device, file system, database
inline constexpr int kCheck = -32012;      // a result exists but fails its check
inline constexpr int kReplyTooLarge = -32013;  // request pages: offset, count

// The codes that a client may distinguish, for rpc.discover.
struct CodeMeaning {
  const char* name;
  int code;
  const char* message;
};
std::span<const CodeMeaning> code_meanings();

int code_of(ErrorCode code);
ErrorCode error_code_of(int code);  // the ErrorCode that a client gets for it

}  // namespace mdof::rpc
