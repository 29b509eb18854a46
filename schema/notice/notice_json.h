// Notices as JSON: {"code", "severity", "subject", "source", named values, "text"}, the second
// pair where there is one. Databases and recordings keep them without text.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/json_writer.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof {

// The words of a notice for a reader, without its severity; daemon/words has them.
using NoticeWords = std::string (*)(const Notice&);

// "key": [...] of an open object. Without words there is no "text".
void write_notices(JsonWriter& json, const char* key, const Notices& notices, NoticeWords words);
// The array alone, as it is stored.
std::string notices_json(const Notices& notices);

// Of an array of such objects, or of the sentences that were stored before: "information: ..." has
// that severity. A code that is not known (of a newer mdof) is read as `legacy` with its name.
Result<Notices> read_notices(std::string_view json_array);

}  // namespace mdof
