#include "daemon/rpc/codes.h"

#include <array>

namespace mdof::rpc {
namespace {

struct Row {
  ErrorCode error;
  int code;
};

// The first row of an ErrorCode is the one that is sent.
constexpr std::array<Row, 12> kTable{{
    {ErrorCode::usage, kInvalidParams},
    {ErrorCode::conflict, kChanged},
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

}  // namespace

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
