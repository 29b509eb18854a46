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

  // Returns the document with the XML declaration. All elements must be closed.
  std::string take();

 private:
  void begin(std::string_view element, Attributes attributes);
  std::string text_;
  std::vector<std::string> open_;
};

// A user's text with white space removed at both ends and reduced to single spaces inside. An empty
// text becomes "not stated", because DCC and QIF do not allow empty texts.
std::string stated(std::string_view text);

}  // namespace mdof::documents
