// The error codes of the RPC interface. Server and client convert codes with the same table.
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
inline constexpr int kBusy = -32000;  // too many connections; the server closes this connection
// The generation has changed; the client must read the data again.
inline constexpr int kChanged = -32001;
// Not possible now, for example because a run is in progress.
inline constexpr int kConflict = -32002;
inline constexpr int kForbidden = -32003;      // the client may only read over this transport
inline constexpr int kNotFound = -32004;       // the run, table or device does not exist
inline constexpr int kBadInput = -32010;       // a file, or a value in a file, is invalid
inline constexpr int kIo = -32011;             // a device, the file system or the database failed
inline constexpr int kCheck = -32012;          // the result does not pass a check
inline constexpr int kReplyTooLarge = -32013;  // the client must request less: "offset", "count"

// An error code as rpc.discover describes it.
struct CodeMeaning {
  const char* name;
  int code;
  const char* message;
};
std::span<const CodeMeaning> code_meanings();

int code_of(ErrorCode code);
ErrorCode error_code_of(int code);  // the ErrorCode that Client::call() returns for this code

}  // namespace mdof::rpc
