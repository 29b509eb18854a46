// Errors of input and of the environment are values: Result<T> contains a message with which the
// user can correct the error. Errors in the program are detected by assert(); no input can cause an
// assertion to fail.
#pragma once

#include <cassert>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "schema/base/remedy/remedy.h"

namespace mdof {

enum class ErrorCode {
  usage,      // the call itself is wrong: an unknown option, method or parameter
  bad_input,  // a file, a document or a value in it is invalid
  not_found,  // a run, table or device with this name does not exist
  check,      // there is a result, but it did not pass its check
  io,         // error of a device, the file system or the database
  conflict,   // not possible at present: a run is in progress, the axis moves, a table is active
  changed,    // the data have changed after the caller read them: their generation differs
};

// `message` states the place (file, line, key, device, register) and what is wrong there. If the
// remedy is a command or option of mdof, `remedy` is the code of the remedy and `remedy_for` its
// object (a run, a kind, a value); daemon/words contains the texts. Any other remedy is part of
// `message`.
struct Error {
  ErrorCode code = ErrorCode::bad_input;
  std::string message;
  Remedy remedy = Remedy::none;
  std::string remedy_for = {};
};

template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

inline tl::unexpected<Error> fail(ErrorCode code, std::string message, Remedy remedy = Remedy::none,
                                  std::string remedy_for = "") {
  return tl::unexpected<Error>(Error{code, std::move(message), remedy, std::move(remedy_for)});
}
inline tl::unexpected<Error> bad_input(std::string message, Remedy remedy = Remedy::none,
                                       std::string remedy_for = "") {
  return fail(ErrorCode::bad_input, std::move(message), remedy, std::move(remedy_for));
}
inline tl::unexpected<Error> io_error(std::string message, Remedy remedy = Remedy::none,
                                      std::string remedy_for = "") {
  return fail(ErrorCode::io, std::move(message), remedy, std::move(remedy_for));
}

// Returns the error with the place before its message: "rig.toml: probe \"A\": ...".
inline tl::unexpected<Error> in_context(const std::string& place, Error error) {
  error.message = place + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace mdof

// `lhs` may be a declaration, which must not be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
// MDOF_TRY and MDOF_CHECK evaluate a Result expression. If the result is an error, the calling
// function returns this error. MDOF_TRY also assigns the value to `lhs`.
#define MDOF_CONCAT_INNER(a, b) a##b
#define MDOF_CONCAT(a, b) MDOF_CONCAT_INNER(a, b)
#define MDOF_TRY_IMPL(tmp, lhs, expr)                      \
  auto tmp = (expr);                                       \
  if (!tmp) return tl::unexpected(std::move(tmp.error())); \
  lhs = std::move(*tmp)
#define MDOF_TRY(lhs, expr) MDOF_TRY_IMPL(MDOF_CONCAT(mdof_try_, __LINE__), lhs, expr)
#define MDOF_CHECK(expr)                                     \
  do {                                                       \
    if (auto mdof_status = (expr); !mdof_status)             \
      return tl::unexpected(std::move(mdof_status.error())); \
  } while (false)
// NOLINTEND(bugprone-macro-parentheses)
