// The catalogue: what a reader sees of a notice, in plain English (CONTRIBUTING.md) or German.
// The only place below the tools that may name a command or an option of mdof.
#pragma once

#include <string>

#include "schema/notice/notice.h"
#include "schema/uncertainty/contributor_name.h"
#include "schema/uncertainty/covers.h"

namespace mdof::words {

// German is for reports. Numbers keep their decimal point in both. Sentences that a notice carries
// as a value (a device's or another program's own words) stay as they are.
enum class Language { english, german };

// "run 3: probe \"B\" no longer changes …": without its severity.
std::string text(const Notice& notice);
std::string text(const Notice& notice, Language language);

// With it where it is not doubtful: "information: the axis was parked …".
std::string line(const Notice& notice, Language language = Language::english);

// `pattern` with the values of the notice put for its fields:
//   {key}          a name, or a number of four digits; digits before the point are all shown
//   {key:6}        a number of six digits
//   {key:+.3f}     a number as of printf
//   {key:?a|b}     a where the number is 1 or the name is not empty, else b
//   {subject}
// A key that the notice lacks, as one of another version's database, reads "unknown".
std::string filled(const char* pattern, const Notice& notice,
                   Language language = Language::english);

// The pattern of a code.
const char* pattern(NoticeCode code, Language language = Language::english);

// One sentence, without a full stop.
std::string text(const Covers& covers, Language language);
// "X, probe A: sensitivity".
std::string text(const ContributorName& name, Language language);

}  // namespace mdof::words
