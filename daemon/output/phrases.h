// Labels of charts and reports in each language that they are written in: one row a label in
// phrases.inc. Pure.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "daemon/words/words.h"
#include "schema/run.h"

namespace mdof::output {

using words::Language;

// "en" or "de"; false: it is neither.
bool language_from(std::string_view name, Language& language);
const char* code_of(Language language);

enum class Phrase {
#define PHRASE(key, english, german) key,
#include "daemon/output/phrases.inc"
#undef PHRASE
};

const char* phrase(Phrase phrase, Language language);
// With {0}, {1} ... replaced.
std::string phrase(Phrase phrase, Language language, std::initializer_list<std::string> values);

const char* state_text(RunState state, Language language);

}  // namespace mdof::output
