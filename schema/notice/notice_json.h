// Notices as JSON: {"code", "severity", "subject", "source", named values, "text"}. "subject" and
// "source" are written only if they are not empty. In databases and recordings, the notices have no
// "text".
#pragma once

#include <string>
#include <string_view>

#include "schema/base/json_writer.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof {

// Text of a notice for a reader, without its severity; implemented in daemon/words.
using NoticeWords = std::string (*)(const Notice&);

// Writes "key": [...] into an open object. `words` nullptr: without "text".
void write_notices(JsonWriter& json, const char* key, const Notices& notices, NoticeWords words);
// The array as it is stored in databases and recordings.
std::string notices_json(const Notices& notices);

// Reads an array of such objects, or of the sentences that older versions stored; a sentence that
// begins with "information: " has that severity. A code that this version does not know is read as
// `legacy`, with its name.
Result<Notices> read_notices(std::string_view json_array);

}  // namespace mdof
