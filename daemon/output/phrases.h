// Labels of charts and reports in English and German. phrases.inc has one row for each label. Pure.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "daemon/words/words.h"
#include "schema/run.h"

namespace mdof::output {

using words::Language;

// Accepts "en" or "de"; returns false for other names.
bool language_from(std::string_view name, Language& language);
const char* code_of(Language language);

enum class Phrase {
#define PHRASE(key, english, german) key,
#include "daemon/output/phrases.inc"
#undef PHRASE
};

const char* phrase(Phrase phrase, Language language);
// Replaces {0}, {1} ... in the label by `values`.
std::string phrase(Phrase phrase, Language language, std::initializer_list<std::string> values);

const char* state_text(RunState state, Language language);

}  // namespace mdof::output
