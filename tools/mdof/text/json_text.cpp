#include "tools/mdof/text/json_text.h"

#include <simdjson.h>

#include <algorithm>
#include <vector>

#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

std::string compact(const element& e) {
  std::string_view text;
  if (!e.get_string().get(text)) return std::string(text);
  if (e.is_null()) return "-";
  array items;
  if (e.get_array().get(items)) return simdjson::to_string(e);
  std::vector<std::string> words;
  for (const element item : items) words.push_back(compact(item));
  return words.empty() ? "-" : joined(words);
}

bool is_table(const element& e) {
  array items;
  if (e.get_array().get(items) || items.size() == 0) return false;
  return std::all_of(items.begin(), items.end(), [](const element i) { return i.is_object(); });
}

std::string table(const array& items) {
  std::vector<std::string> keys;
  for (const auto [key, value] : object(items.at(0).get_object())) {
    if (!value.is_object() && !is_table(value)) keys.emplace_back(key);
  }
  TextTable out(keys);
  for (const element item : items) {
    std::vector<std::string> row;
    for (const auto& key : keys) {
      element cell;
      row.push_back(item.at_key(key).get(cell) ? "" : compact(cell));
    }
    out.add(std::move(row));
  }
  return out.text(terminal_columns());
}

std::string members(const object& of, const std::string& prefix) {
  std::string lines, tables;
  for (const auto [key, value] : of) {
    const std::string name = prefix + std::string(key);
    if (value.is_object()) {
      lines += members(value.get_object(), name + ".");
    } else if (is_table(value)) {
      tables += "\n" + name + "\n" + table(value.get_array());
    } else {
      lines += name + ": " + compact(value) + "\n";
    }
  }
  return lines + tables;
}

}  // namespace

std::string readable(std::string_view json) {
  simdjson::dom::parser parser;
  element root;
  if (parser.parse(simdjson::padded_string(json)).get(root)) return std::string(json) + "\n";
  if (root.is_object()) return members(root.get_object(), "");
  return is_table(root) ? table(root.get_array()) : compact(root) + "\n";
}

}  // namespace mdof::tools
