#include "daemon/rpc/params/list_page.h"

namespace mdof::rpc {

Param offset_param() {
  return {"offset", ParamType::integer, "number of items to skip", false, "0", {.least = 0}};
}

Param count_param(std::int64_t most) {
  return {"count",
          ParamType::integer,
          "largest number of items; mdofd sends fewer items if the reply line is full",
          false,
          std::to_string(most),
          {.least = 1, .most = static_cast<double>(most)}};
}

ListPage read_list_page(const Params& params, std::int64_t most) {
  return {params.integer("offset", 0), params.integer("count", most)};
}

}  // namespace mdof::rpc
