// Lists that are sent in pages, weighed in bytes: one way for all of them.
#pragma once

#include <cstddef>
#include <string>

#include "schema/base/json_writer.h"

namespace mdof {

// Of a line of 48 KiB, with room for what stands around the list.
inline constexpr std::size_t kPageBytes = 44 * 1024;

// Appends items to the array that is open in `json` until its text would be longer than
// `max_bytes`; gives how many. The first is always taken: whoever makes items keeps them under a
// page. `to_json` turns one into JSON text.
template <class Items, class ToJson>
std::size_t append_page(JsonWriter& json, const Items& items, ToJson to_json,
                        std::size_t max_bytes = kPageBytes) {
  std::size_t taken = 0;
  for (const auto& item : items) {
    const std::string text = to_json(item);
    if (taken > 0 && json.text().size() + text.size() > max_bytes) break;
    json.raw(text);
    ++taken;
  }
  return taken;
}

}  // namespace mdof
