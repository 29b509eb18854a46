// The text of an error for users. It consists of the message and the remedy.
#pragma once

#include <string>

#include "daemon/words/words.h"
#include "schema/base/result.h"

namespace mdof::words {

// The text of the remedy, without a full stop. `what_for` replaces {subject}. Remedy::none has the
// text "".
std::string remedy(Remedy remedy, const std::string& what_for = "",
                   Language language = Language::english);

// The complete text, "rig_X.toml:3: … is wrong; take …". The message is always in English; the
// remedy is in `language`.
std::string text(const Error& error, Language language = Language::english);

}  // namespace mdof::words
