// The parameters of methods that return lists; schema/base/json_page.h fills the page.
#pragma once

#include <cstdint>

#include "daemon/rpc/method_table.h"

namespace mdof::rpc {

// "offset" and "count". A page reads at most `most` items.
Param offset_param();
Param count_param(std::int64_t most);

struct ListPage {
  std::int64_t offset = 0, count = 0;
};
ListPage read_list_page(const Params& params, std::int64_t most);

}  // namespace mdof::rpc
