// Codes for the remedy of an error. The code that finds an error does not know whether the error is
// displayed by a command, by another program or in a report. The texts are in daemon/words.
#pragma once

#include <cstddef>

namespace mdof {

enum class Remedy {
  none,  // the message contains the remedy, or there is no remedy
#define REMEDY(code) code,
#include "schema/base/remedy/remedies.inc"
#undef REMEDY
};

// "set_encoder"
inline const char* to_string(Remedy remedy) {
  constexpr const char* kNames[] = {
      "none",
#define REMEDY(code) #code,
#include "schema/base/remedy/remedies.inc"
#undef REMEDY
  };
  return kNames[static_cast<std::size_t>(remedy)];
}

}  // namespace mdof
