#include "schema/base/toml/toml_reader.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "schema/base/toml/toml_depth.h"

namespace mdof {

struct TomlTable::Document {
  toml::table root;
  std::string source;
  std::optional<Error> error;
};

// A table of the tree, with the keys that were read and the sub-tables that were returned to
// callers.
struct TomlTable::Node {
  const toml::table* table = nullptr;
  std::string path;  // "probe[2]."
  std::set<std::string, std::less<>> asked;
  // Keys that has() was called for; used in hints, they do not count as read.
  std::set<std::string, std::less<>> queried_keys;
  std::vector<std::shared_ptr<Node>> children;
  std::map<const toml::table*, std::shared_ptr<Node>> child_of;

  // All callers get the same node, because each caller may read other keys of it.
  std::shared_ptr<Node> child(const toml::table* of, std::string its_path) {
    auto& known = child_of[of];
    if (known) return known;
    known = std::make_shared<Node>();
    known->table = of;
    known->path = std::move(its_path);
    children.push_back(known);
    return known;
  }
};

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_before, before(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    two_before = std::exchange(before, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({before[j] + 1, row[j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], two_before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

namespace {

std::optional<double> as_number(const toml::node& node) {
  if (const auto* x = node.as_floating_point()) return x->get();
  if (const auto* i = node.as_integer()) return static_cast<double>(i->get());
  return std::nullopt;
}

}  // namespace

std::string nearest_candidate(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2) + 1;
  for (const auto& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

TomlTable::TomlTable(std::shared_ptr<Document> document, std::shared_ptr<Node> node)
    : document_(std::move(document)), node_(std::move(node)) {}

Result<TomlTable> TomlTable::parse(std::string_view text, const std::string& source_name) {
  if (const auto line = toml_line_over_depth(text, kMaxTomlDepth))
    return bad_input(source_name + ":" + std::to_string(*line) +
                     ": this line is nested more than " + std::to_string(kMaxTomlDepth) +
                     " levels deep (with dotted keys or brackets); use fewer levels");
  auto document = std::make_shared<Document>();
  document->source = source_name;
  try {
    document->root = toml::parse(text);
  } catch (const toml::parse_error& e) {
    std::ostringstream message;
    message << source_name << ":" << e.source().begin.line
            << ": not valid TOML: " << e.description() << "; correct this line";
    return bad_input(message.str());
  }
  auto node = std::make_shared<Node>();
  node->table = &document->root;
  return TomlTable(std::move(document), std::move(node));
}

std::string TomlTable::content(const std::string& text,
                               const std::vector<std::string_view>& without) {
  const auto table = parse(text, "");
  if (!table) return text;
  for (const std::string_view name : without) table->document_->root.erase(name);
  std::ostringstream content;
  content << table->document_->root;
  return content.str();
}

std::string TomlTable::where(std::string_view key) const {
  std::string place = document_->source;
  const auto* node = node_->table->get(key);
  const auto line = node ? node->source().begin.line : node_->table->source().begin.line;
  if (line > 0) place += ":" + std::to_string(line);
  return place + ": " + node_->path + std::string(key);
}

void TomlTable::reject(std::string_view key, const std::string& why, Remedy remedy,
                       const std::string& remedy_for) {
  if (!document_->error)
    document_->error = Error{ErrorCode::bad_input, where(key) + ": " + why, remedy, remedy_for};
}

// A key that was not read may be a misspelt form of the missing key.
void TomlTable::missing(std::string_view key, const char* form) {
  std::vector<std::string> others;
  for (const auto& [name, value] : *node_->table) {
    if (!node_->asked.contains(name.str())) others.emplace_back(name.str());
  }
  const std::string near = nearest_candidate(key, others);
  const std::string hint = near.empty() ? "" : " (or rename \"" + near + "\")";
  reject(key, "is missing; add " + std::string(key) + " = " + form + hint);
}

bool TomlTable::has(std::string_view key) {
  node_->queried_keys.emplace(key);
  return node_->table->contains(key);
}

bool TomlTable::is_array(std::string_view key) {
  const auto* node = node_->table->get(key);
  return node && node->is_array();
}

bool TomlTable::is_table(std::string_view key) {
  const auto* node = node_->table->get(key);
  return node && node->is_table();
}

bool TomlTable::is_boolean(std::string_view key) {
  const auto* node = node_->table->get(key);
  return node && node->is_boolean();
}

bool TomlTable::is_string(std::string_view key) {
  const auto* node = node_->table->get(key);
  return node && node->is_string();
}

std::string TomlTable::string(std::string_view key, const std::optional<std::string>& fallback) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) {
    if (!fallback) missing(key, "\"...\"");
    return fallback.value_or("");
  }
  if (const auto* s = node->as_string()) return s->get();
  reject(key, "must be a string in quotes");
  return "";
}

double TomlTable::number(std::string_view key, std::optional<double> fallback) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) {
    if (!fallback) missing(key, "<number>");
    return fallback.value_or(0);
  }
  const auto x = as_number(*node);
  if (x && std::isfinite(*x)) return *x;
  reject(key, node->is_string() ? "must be a finite number, not a text; remove the quotes"
                                : "must be a finite number");
  return 0;
}

std::int64_t TomlTable::integer(std::string_view key, std::optional<std::int64_t> fallback) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) {
    if (!fallback) missing(key, "<whole number>");
    return fallback.value_or(0);
  }
  if (const auto* i = node->as_integer()) return i->get();
  reject(key, "must be a whole number");
  return 0;
}

bool TomlTable::boolean(std::string_view key, std::optional<bool> fallback) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) {
    if (!fallback) missing(key, "true or false");
    return fallback.value_or(false);
  }
  if (const auto* b = node->as_boolean()) return b->get();
  reject(key, "must be true or false");
  return false;
}

std::vector<double> TomlTable::numbers(std::string_view key,
                                       const std::optional<std::vector<double>>& fallback) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) {
    if (!fallback) missing(key, "[<numbers>]");
    return fallback.value_or(std::vector<double>{});
  }
  std::vector<double> out;
  const auto* array = node->as_array();
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const auto x = as_number((*array)[i]);
    if (!x || !std::isfinite(*x)) {
      array = nullptr;
    } else {
      out.push_back(*x);
    }
  }
  if (!array) reject(key, "must be a list of finite numbers");
  return out;
}

std::array<double, 3> TomlTable::vector3(std::string_view key) {
  const auto list = numbers(key);
  if (list.size() != 3) {
    reject(key, "must be three numbers, [x, y, z]");
    return {};
  }
  return {list[0], list[1], list[2]};
}

std::vector<std::vector<double>> TomlTable::matrix(std::string_view key) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) return {};
  std::vector<std::vector<double>> rows;
  const auto* array = node->as_array();
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const auto* row = (*array)[i].as_array();
    rows.emplace_back();
    for (std::size_t j = 0; row && j < row->size(); ++j) {
      const auto x = as_number((*row)[j]);
      if (!x || !std::isfinite(*x)) {
        row = nullptr;
      } else {
        rows.back().push_back(*x);
      }
    }
    if (!row) array = nullptr;
  }
  if (!array) reject(key, "must be a list of lists of finite numbers");
  return rows;
}

std::vector<std::string> TomlTable::strings(std::string_view key) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) return {};
  std::vector<std::string> out;
  const auto* array = node->as_array();
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const auto* s = (*array)[i].as_string();
    if (!s) {
      array = nullptr;
    } else {
      out.push_back(s->get());
    }
  }
  if (!array) reject(key, "must be a list of strings in quotes");
  return out;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) return {};
  std::vector<TomlTable> out;
  const auto* array = node->as_array();
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const auto* table = (*array)[i].as_table();
    if (!table) {
      array = nullptr;
      break;
    }
    out.push_back(TomlTable(document_, node_->child(table, node_->path + std::string(key) + "[" +
                                                               std::to_string(i + 1) + "].")));
  }
  if (!array) reject(key, "must be written as [[" + std::string(key) + "]] tables");
  return out;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  node_->asked.emplace(key);
  const auto* node = node_->table->get(key);
  if (!node) return std::nullopt;
  const auto* table = node->as_table();
  if (!table) {
    reject(key, "must be a table, [" + std::string(key) + "]");
    return std::nullopt;
  }
  return TomlTable(document_, node_->child(table, node_->path + std::string(key) + "."));
}

Status TomlTable::finish() {
  std::vector<std::shared_ptr<Node>> open = {node_};
  while (!open.empty()) {
    const auto node = open.back();
    open.pop_back();
    for (const auto& [key, value] : *node->table) {
      if (node->asked.contains(key.str())) continue;
      std::vector<std::string> known(node->asked.begin(), node->asked.end());
      for (const auto& queried : node->queried_keys)
        if (!node->asked.contains(queried)) known.push_back(queried);
      const std::string near = nearest_candidate(key.str(), known);
      std::string why = "unknown key";
      if (!near.empty()) {
        why += "; did you mean \"" + near + "\"?";
      } else {
        why += "; known keys:";
        for (const auto& k : known) why += " " + k;
      }
      TomlTable(document_, node).reject(key.str(), why);
    }
    open.insert(open.end(), node->children.rbegin(), node->children.rend());
  }
  if (document_->error) return tl::unexpected(*document_->error);
  return {};
}

}  // namespace mdof
