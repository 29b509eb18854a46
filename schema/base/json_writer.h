// Writes JSON text directly into a string; it uses neither a tree nor a locale. A double is written
// with the fewest digits from which the same bits can be read back (std::to_chars). A number that
// is not finite is written as null. Bytes that are not UTF-8 are written as U+FFFD, so that the
// text is always valid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace mdof {

class JsonWriter {
 public:
  // `reserve_bytes`: expected size of the text; avoids reallocation.
  explicit JsonWriter(std::size_t reserve_bytes = 0) { text_.reserve(reserve_bytes); }
  JsonWriter& begin_object();
  JsonWriter& end_object();
  JsonWriter& begin_array();
  JsonWriter& end_array();
  JsonWriter& key(std::string_view name);
  JsonWriter& value(double x);
  JsonWriter& value(std::int64_t x);
  JsonWriter& value(std::uint64_t x);
  JsonWriter& value(int x) { return value(static_cast<std::int64_t>(x)); }
  JsonWriter& value(bool x);
  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& null();
  JsonWriter& raw(std::string_view json);  // a value that is already JSON

  // Writes a key and its value.
  template <class T>
  JsonWriter& field(std::string_view name, const T& x) {
    key(name);
    return value(x);
  }

  const std::string& text() const { return text_; }
  std::string take() { return std::move(text_); }

 private:
  void separate();  // writes a comma if required
  std::string text_;
  bool need_comma_ = false;
};

}  // namespace mdof
