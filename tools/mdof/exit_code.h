// The exit status of mdof, as man mdof describes it.
#pragma once

#include "schema/base/result.h"

namespace mdof::tools {

enum ExitCode { kOk = 0, kFailedCheck = 1, kUsage = 2, kBadInput = 3, kDeviceOrIo = 4 };

inline ExitCode exit_code_for(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return kUsage;
    case ErrorCode::bad_input:
    case ErrorCode::not_found:
    case ErrorCode::conflict:
    case ErrorCode::changed:
      return kBadInput;
    case ErrorCode::check:
      return kFailedCheck;
    case ErrorCode::io:
      break;
  }
  return kDeviceOrIo;
}

}  // namespace mdof::tools
