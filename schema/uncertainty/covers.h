// What a stated u contains and what it leaves out, as data. Its words in English and German:
// covers.inc. Pure.
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

// Of what a fixture measured.
struct MeasuredCovers {
  bool noise_only = false, declares = false;
  bool repeated = true;  // false: no target of a run was visited twice from the same side
};
Covers covers(const MeasuredCovers& of);

// One sentence in English, without a full stop: "u_covers" of documents. German is in
// daemon/words/words.h.
std::string covers_text(const Covers& covers);
// Of a budget, a run, a table: of all that states its u.
template <class Stated>
requires requires(const Stated& stated) {
  Covers(covers(stated));
}
std::string covers_text(const Stated& stated) {
  return covers_text(covers(stated));
}

}  // namespace mdof
