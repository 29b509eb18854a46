// The text of an error for users: its message and its remedy.
#pragma once

#include <string>

#include "daemon/words/words.h"
#include "schema/base/result.h"

namespace mdof::words {

// The remedy without a full stop; {subject} becomes `what_for`. "" for Remedy::none.
std::string remedy(Remedy remedy, const std::string& what_for = "",
                   Language language = Language::english);

// "rig_X.toml:3: … is wrong; take …". The message itself is always English.
std::string text(const Error& error, Language language = Language::english);

}  // namespace mdof::words
