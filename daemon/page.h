// Lists on the RPC: a page holds as many items as fit into a reply line, and never more than asked
// for.
#pragma once

#include <cstdint>
#include <string>

#include "daemon/rpc/method_table.h"
#include "schema/base/json_writer.h"
#include "schema/run.h"

namespace mdof::daemon {

// Of a reply's line, with room for what stands around the list (rpc::ServerOptions).
inline constexpr std::size_t kPageBytes = 44 * 1024;

// "offset" and "count" of a method that lists: at most `most` items are looked at for a page.
rpc::Param offset_param();
rpc::Param count_param(std::int64_t most);

struct Page {
  std::int64_t offset = 0, count = 0;
};
Page page_of(const rpc::Params& params, std::int64_t most);

// Appends an item to the array that is open in `json`. False: the page is full without it. The
// first item is always taken: whoever makes items keeps them under a page.
bool add_to_page(JsonWriter& json, bool first, const std::string& item);

// The header as JSON, under a page: of one that is longer the note and the warnings are cut, its
// options are null, and "shortened" says so.
std::string header_item(const RunHeader& header);
RunHeader shortened(RunHeader header);

}  // namespace mdof::daemon
