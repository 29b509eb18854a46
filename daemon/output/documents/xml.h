// Writes an XML document with escaped texts, correctly nested elements and indentation by one
// space.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mdof::documents {

class Xml {
 public:
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  void open(std::string_view element, Attributes attributes = {});
  void close();
  void leaf(std::string_view element, std::string_view text, Attributes attributes = {});

  // The document with its declaration; all elements must be closed.
  std::string take();

 private:
  void begin(std::string_view element, Attributes attributes);
  std::string text_;
  std::vector<std::string> open_;
};

// A user's text without white space at its ends and with single spaces inside; "not stated" if it
// is empty, because neither DCC nor QIF allows an empty text.
std::string stated(std::string_view text);

}  // namespace mdof::documents
