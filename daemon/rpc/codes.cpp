#include "daemon/rpc/codes.h"

#include <array>

namespace mdof::rpc {
namespace {

struct Row {
  ErrorCode error;
  int code;
};

// If an ErrorCode has several rows, the server sends the code in the first of these rows.
constexpr std::array<Row, 13> kTable{{
    {ErrorCode::usage, kInvalidParams},
    {ErrorCode::changed, kChanged},
    {ErrorCode::conflict, kConflict},
    {ErrorCode::not_found, kNotFound},
    {ErrorCode::bad_input, kBadInput},
    {ErrorCode::io, kIo},
    {ErrorCode::check, kCheck},
    {ErrorCode::usage, kParseError},
    {ErrorCode::usage, kInvalidRequest},
    {ErrorCode::usage, kMethodNotFound},
    {ErrorCode::usage, kForbidden},
    {ErrorCode::usage, kReplyTooLarge},
    {ErrorCode::io, kBusy},
}};

constexpr CodeMeaning kMeanings[] = {
    {"busy", kBusy, "too many connections"},
    {"changed", kChanged, "the generation changed: read the data again"},
    {"conflict", kConflict,
     "not possible now, for example because a run is in progress or an axis "
     "moves"},
    {"forbidden", kForbidden, "this client may only read"},
    {"not_found", kNotFound, "no such run, table or device"},
    {"bad_input", kBadInput, "an error in a file, a document or a value"},
    {"io", kIo, "an error of a device, a file or the database"},
    {"check", kCheck, "a result fails its check"},
    {"reply_too_large", kReplyTooLarge, "read the result in pages"},
};

}  // namespace

std::span<const CodeMeaning> code_meanings() {
  return kMeanings;
}

int code_of(ErrorCode code) {
  for (const Row& row : kTable)
    if (row.error == code) return row.code;
  return kInternalError;
}

ErrorCode error_code_of(int code) {
  for (const Row& row : kTable)
    if (row.code == code) return row.error;
  return ErrorCode::io;
}

}  // namespace mdof::rpc
