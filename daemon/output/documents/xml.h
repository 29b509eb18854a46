// Writes an XML document: texts escaped, elements closed in their order, indented by one space.
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

  // With its declaration; all elements must be closed.
  std::string take();

 private:
  void begin(std::string_view element, Attributes attributes);
  std::string text_;
  std::vector<std::string> open_;
};

// Of a user's text: white space at the ends left out, inside a single space; "not stated" where
// nothing is left, since neither DCC nor QIF takes an empty text.
std::string stated(std::string_view text);

}  // namespace mdof::documents
