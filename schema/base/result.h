// Errors of input and environment are values: Result<T> with a message that a user can act on. Bugs
// are assert()s; no input fails an assertion.
#pragma once

#include <cassert>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "schema/base/remedy/remedy.h"

namespace mdof {

enum class ErrorCode {
  usage,      // the call itself is wrong: unknown option, method or parameter
  bad_input,  // a file, a document or a value in it is invalid
  not_found,  // the named run, table, device does not exist
  check,      // a result exists and fails its check
  io,         // error of a device, the file system or the database
  conflict,   // not possible now: a run is in progress, the axis moves, a table is active
  changed,    // the data have changed since the caller read them: the generation differs
};

// `message` names the place (file, line, key, device, register), the error there and, if the remedy
// is not a command or option of mdof, the remedy. Otherwise `remedy` is its code and `remedy_for`
// its object (a run, a kind, a value); daemon/words contains the text.
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

// Passes an error on with the place in front: "rig.toml: probe \"A\": ...".
inline tl::unexpected<Error> in_context(const std::string& place, Error error) {
  error.message = place + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace mdof

// `lhs` may be a declaration, which must not be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
// Evaluates a Result expression; returns its error to the caller, or assigns its value.
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
