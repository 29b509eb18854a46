// Strict reader of TOML documents. The caller reads each key by its name and type. A key that was
// not read is an error; the message contains the most similar known key, the file and the line.
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

// A table of a document. Only the first error is stored. After an error, all functions do nothing
// and return their default. Therefore the caller can read all keys and check for an error once, in
// finish().
class TomlTable {
 public:
  // `source_name` is the name of the document in messages.
  static Result<TomlTable> parse(std::string_view text, const std::string& source_name);

  // True if the table has the key. has() does not count as reading: finish() reports the key as
  // unknown unless another function reads it. Hints for misspelt keys may propose the key.
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
  std::vector<std::vector<double>> matrix(std::string_view key);  // empty if the key is absent
  std::vector<std::string> strings(std::string_view key);         // empty if the key is absent
  // [[key]]; empty if the key is absent
  std::vector<TomlTable> tables(std::string_view key);
  std::optional<TomlTable> table(std::string_view key);  // [key]

  // Records an error that the caller has found at this key ("position_mm: outside the target").
  void reject(std::string_view key, const std::string& why, Remedy remedy = Remedy::none,
              const std::string& remedy_for = "");
  // Returns the first error of this document. A key of this table and its sub-tables that was not
  // read is also an error. Call it once, after all keys were read.
  Status finish();
  std::string where(std::string_view key) const;  // "rig.toml:12: probe.range_um"

  // The keys and values of the document in a canonical form, without comments. Two documents with
  // the same content give the same text. Tables of the document whose name is in `without` are left
  // out. If `text` is not a TOML document, returns `text`.
  static std::string content(const std::string& text,
                             const std::vector<std::string_view>& without = {});

 private:
  struct Document;
  struct Node;
  TomlTable(std::shared_ptr<Document> document, std::shared_ptr<Node> node);
  void missing(std::string_view key, const char* form);
  std::shared_ptr<Document> document_;  // shared by the tables of one document
  std::shared_ptr<Node> node_;
};

// Number of letters to add, remove or change, plus number of pairs of neighbouring letters to
// exchange ("slove").
std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate with the smallest edit distance to `word`; empty if no candidate is similar.
std::string nearest_candidate(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace mdof
