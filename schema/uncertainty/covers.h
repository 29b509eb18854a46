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

// Facts about the u of results that a fixture measured.
struct CoverFacts {
  bool noise_only = false, declares = false;
  bool repeated = true;  // false: no target of a run was visited twice from the same side
};
Covers covers(const CoverFacts& of);

// One English sentence without a full stop: "u_covers" of documents. The German text is in
// daemon/words/words.h.
std::string covers_text(const Covers& covers);
// For a budget, a run or a table: any type with covers().
template <class Stated>
requires requires(const Stated& stated) {
  Covers(covers(stated));
}
std::string covers_text(const Stated& stated) {
  return covers_text(covers(stated));
}

}  // namespace mdof
