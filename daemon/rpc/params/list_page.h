// The parameters "offset" and "count" of methods that return a list in pages.
// schema/base/json_page.h writes the page.
#pragma once

#include <cstdint>

#include "daemon/rpc/method_table.h"

namespace mdof::rpc {

// `most`: largest number of items in a page.
Param offset_param();
Param count_param(std::int64_t most);

struct ListPage {
  std::int64_t offset = 0, count = 0;
};
ListPage read_list_page(const Params& params, std::int64_t most);

}  // namespace mdof::rpc
