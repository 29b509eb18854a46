// The texts of all notices, in plain English (CONTRIBUTING.md) and German. Apart from the folder
// tools and the reports, only this folder may name commands or options of mdof.
#pragma once

#include <string>

#include "schema/notice/notice.h"
#include "schema/uncertainty/contributor_name.h"
#include "schema/uncertainty/covers.h"

namespace mdof::words {

// German is used in reports. Numbers have a decimal point in both languages. If a value of a notice
// is a sentence (from a device or another program), it is not translated.
enum class Language { english, german };

// The text of a notice without its severity: "run 3: probe \"B\" no longer changes …".
std::string text(const Notice& notice);
std::string text(const Notice& notice, Language language);

// The text of a notice. If the severity is not "doubtful", the text begins with the severity:
// "information: the axis was parked …".
std::string line(const Notice& notice, Language language = Language::english);

// Replaces the fields of `pattern` by the values of the notice:
//   {key}          a name, or a number with four digits; all digits before the point are shown
//   {key:6}        a number with six digits
//   {key:+.3f}     a number in the format of printf
//   {key:?a|b}     a if the number is 1 or the name is not empty, otherwise b
//   {subject}
// If the notice has no value with this key, the field becomes "unknown". This can happen with a
// database of another version.
std::string filled(const char* pattern, const Notice& notice,
                   Language language = Language::english);

// The pattern of the text for a notice code.
const char* pattern(NoticeCode code, Language language = Language::english);

// The contributions that an uncertainty includes, as one sentence without a full stop.
std::string text(const Covers& covers, Language language);
// The name of a contributor to an uncertainty, "X, probe A: sensitivity".
std::string text(const ContributorName& name, Language language);

}  // namespace mdof::words
