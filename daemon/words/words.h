// The catalogue of notice texts, in plain English (CONTRIBUTING.md) and German. Below the tools,
// only this folder may name commands or options of mdof.
#pragma once

#include <string>

#include "schema/notice/notice.h"
#include "schema/uncertainty/contributor_name.h"
#include "schema/uncertainty/covers.h"

namespace mdof::words {

// German is for reports. Numbers have a decimal point in both languages. Sentences that a notice
// contains as a value (from a device or another program) are not translated.
enum class Language { english, german };

// "run 3: probe \"B\" no longer changes …", without the severity.
std::string text(const Notice& notice);
std::string text(const Notice& notice, Language language);

// With the severity if it is not doubtful: "information: the axis was parked …".
std::string line(const Notice& notice, Language language = Language::english);

// Replaces the fields of `pattern` by the values of the notice:
//   {key}          a name, or a number with four digits; all digits before the point are shown
//   {key:6}        a number with six digits
//   {key:+.3f}     a number in the format of printf
//   {key:?a|b}     a if the number is 1 or the name is not empty, otherwise b
//   {subject}
// A key that the notice lacks (for example, in the database of another version) becomes "unknown".
std::string filled(const char* pattern, const Notice& notice,
                   Language language = Language::english);

// The pattern of a notice code.
const char* pattern(NoticeCode code, Language language = Language::english);

// One sentence, without a full stop.
std::string text(const Covers& covers, Language language);
// "X, probe A: sensitivity".
std::string text(const ContributorName& name, Language language);

}  // namespace mdof::words
