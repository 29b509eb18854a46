// An error as a person reads it: its message and the words of its remedy.
#pragma once

#include <string>

#include "daemon/words/words.h"
#include "schema/base/result.h"

namespace mdof::words {

// What to do, without a full stop; {subject} is `what_for`. Of Remedy::none: "".
std::string remedy(Remedy remedy, const std::string& what_for = "",
                   Language language = Language::english);

// "rig_X.toml:3: … is wrong; take …". The message itself is English in any language.
std::string text(const Error& error, Language language = Language::english);

}  // namespace mdof::words
