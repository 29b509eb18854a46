// Contributions that a stated u includes or omits, as data. The texts in English and German are in
// covers.inc. Pure functions.
#pragma once

#include <string>
#include <vector>

namespace mdof {

enum class Covered {
#define COVERED(code, english, german) code,
#include "schema/uncertainty/covers.inc"
#undef COVERED
};
using Covers = std::vector<Covered>;

// Facts about the standard uncertainty u of results that were measured with a fixture.
struct CoverFacts {
  bool noise_only = false, declares = false;
  bool repeated = true;  // false: in a run, no target was visited twice from the same side
};
Covers covers(const CoverFacts& of);

// One English sentence without a full stop, for the member "u_covers" of documents.
// daemon/words/words.h has the German text.
std::string covers_text(const Covers& covers);
// As above, for a budget, a run or a table: any type for which covers() exists.
template <class Stated>
requires requires(const Stated& stated) {
  Covers(covers(stated));
}
std::string covers_text(const Stated& stated) {
  return covers_text(covers(stated));
}

}  // namespace mdof
