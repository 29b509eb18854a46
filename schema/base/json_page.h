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
// page. `to_json` turns the index of one, from `begin` to `end` - 1, into JSON text.
template <class ToJson>
std::size_t append_page_of(JsonWriter& json, std::size_t begin, std::size_t end, ToJson to_json,
                           std::size_t max_bytes = kPageBytes) {
  std::size_t taken = 0;
  for (std::size_t i = begin; i < end; ++i, ++taken) {
    const std::string text = to_json(i);
    if (taken > 0 && json.text().size() + text.size() > max_bytes) break;
    json.raw(text);
  }
  return taken;
}

// The same of a vector or span, of which `to_json` turns an item into JSON text.
template <class Items, class ToJson>
std::size_t append_page(JsonWriter& json, const Items& items, ToJson to_json,
                        std::size_t max_bytes = kPageBytes) {
  return append_page_of(
      json, 0, items.size(), [&](std::size_t i) { return to_json(items[i]); }, max_bytes);
}

}  // namespace mdof
