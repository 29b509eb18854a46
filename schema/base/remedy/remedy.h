// What a person can do about an error, as a code: the code that finds an error does not know
// whether a command line, a program or a report shows it. daemon/words has the words.
#pragma once

#include <cstddef>

namespace mdof {

enum class Remedy {
  none,  // the message says it, or there is none
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
