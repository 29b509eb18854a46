// Strict reader of TOML documents: the caller reads each key by name and type. A key that is not
// read is an error, which names the nearest known key. Messages contain file and line.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

// One table of a document. The first error is kept; later calls do nothing and return their
// default, so that a reader can call repeatedly and check once at the end.
class TomlTable {
 public:
  // `source_name` is the name of the document in messages.
  static Result<TomlTable> parse(std::string_view text, const std::string& source_name);

  // has() only gives a hint for misspelt keys; a key must be read to be known.
  bool has(std::string_view key);
  bool is_array(std::string_view key);  // [[key]], or key = [...]
  bool is_table(std::string_view key);  // [key], or key = {...}
  bool is_string(std::string_view key);
  bool is_boolean(std::string_view key);
  std::string string(std::string_view key,
                     const std::optional<std::string>& fallback = std::nullopt);
  double number(std::string_view key, std::optional<double> fallback = std::nullopt);
  std::int64_t integer(std::string_view key, std::optional<std::int64_t> fallback = std::nullopt);
  bool boolean(std::string_view key, std::optional<bool> fallback = std::nullopt);
  std::vector<double> numbers(std::string_view key,
                              const std::optional<std::vector<double>>& fallback = std::nullopt);
  std::array<double, 3> vector3(std::string_view key);
  std::vector<std::vector<double>> matrix(std::string_view key);  // absent: empty
  std::vector<std::string> strings(std::string_view key);         // absent: empty
  std::vector<TomlTable> tables(std::string_view key);            // [[key]]; absent: none
  std::optional<TomlTable> table(std::string_view key);           // [key]

  // Records an error of the caller at this key ("position_mm: outside the target").
  void reject(std::string_view key, const std::string& why, Remedy remedy = Remedy::none,
              const std::string& remedy_for = "");
  // Ok, or the first error of this document, including unknown keys of this table and its
  // sub-tables. Call it once, after all keys were read.
  Status finish();
  std::string where(std::string_view key) const;  // "rig.toml:12: probe.range_um"

 private:
  struct Document;
  struct Node;
  TomlTable(std::shared_ptr<Document> document, std::shared_ptr<Node> node);
  void missing(std::string_view key, const char* form);
  std::shared_ptr<Document> document_;  // shared by the tables of one document
  std::shared_ptr<Node> node_;
};

// Number of letters to add, remove or change and of neighbours to swap ("slove").
std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate with the smallest edit distance to `word`; empty if none is near.
std::string nearest_candidate(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace mdof
