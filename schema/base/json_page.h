// Divides long lists into pages with a limited number of bytes.
#pragma once

#include <cstddef>
#include <string>

#include "schema/base/json_writer.h"

namespace mdof {

// A message has at most 48 KiB. The other 4 KiB are for the members around the list.
inline constexpr std::size_t kPageBytes = 44 * 1024;

// Appends items to the open array in `json` until the text would be longer than `max_bytes`.
// Returns the number of appended items. The first item is always appended; each item must therefore
// be shorter than a page. `to_json` converts an index (`begin` ... `end` - 1) to JSON text.
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

// As append_page_by_index(), for a vector or span. `to_json` converts an item to JSON text.
template <class Items, class ToJson>
std::size_t append_page(JsonWriter& json, const Items& items, ToJson to_json,
                        std::size_t max_bytes = kPageBytes) {
  return append_page_by_index(
      json, 0, items.size(), [&](std::size_t i) { return to_json(items[i]); }, max_bytes);
}

}  // namespace mdof
