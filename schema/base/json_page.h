// Lists sent in pages of limited size in bytes.
#pragma once

#include <cstddef>
#include <string>

#include "schema/base/json_writer.h"

namespace mdof {

// The line limit is 48 KiB; the rest is for the members around the list.
inline constexpr std::size_t kPageBytes = 44 * 1024;

// Appends items to the open array of `json` until its text would be longer than `max_bytes`;
// returns their number. The first item is always appended, so each item must be shorter than a
// page. `to_json` converts an index, `begin` to `end` - 1, to JSON text.
template <class ToJson>
std::size_t append_page_by_index(JsonWriter& json, std::size_t begin, std::size_t end,
                                 ToJson to_json, std::size_t max_bytes = kPageBytes) {
  std::size_t taken = 0;
  for (std::size_t i = begin; i < end; ++i, ++taken) {
    const std::string text = to_json(i);
    if (taken > 0 && json.text().size() + text.size() > max_bytes) break;
    json.raw(text);
  }
  return taken;
}

// The same for a vector or span; `to_json` converts an item to JSON text.
template <class Items, class ToJson>
std::size_t append_page(JsonWriter& json, const Items& items, ToJson to_json,
                        std::size_t max_bytes = kPageBytes) {
  return append_page_by_index(
      json, 0, items.size(), [&](std::size_t i) { return to_json(items[i]); }, max_bytes);
}

}  // namespace mdof
