#include "daemon/output/documents/xml.h"

#include <algorithm>
#include <cassert>

#include "daemon/output/charts/svg.h"

namespace mdof::documents {

using charts::xml_escaped;

void Xml::begin(std::string_view element, Attributes attributes) {
  text_.append(open_.size(), ' ').append("<").append(element);
  for (const auto& [name, value] : attributes)
    text_.append(" ").append(name).append("=\"").append(xml_escaped(value)).append("\"");
  text_ += '>';
}

void Xml::open(std::string_view element, Attributes attributes) {
  begin(element, attributes);
  text_ += '\n';
  open_.emplace_back(element);
}

void Xml::close() {
  assert(!open_.empty());
  const std::string element = std::move(open_.back());
  open_.pop_back();
  text_.append(open_.size(), ' ').append("</").append(element).append(">\n");
}

void Xml::leaf(std::string_view element, std::string_view text, Attributes attributes) {
  begin(element, attributes);
  text_.append(xml_escaped(text)).append("</").append(element).append(">\n");
}

std::string Xml::take() {
  assert(open_.empty());
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + std::move(text_);
}

std::string stated(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n\f\v";
  std::string words;
  for (std::size_t at = text.find_first_not_of(kSpace); at != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    if (!words.empty()) words += ' ';
    words += text.substr(at, end - at);
    at = text.find_first_not_of(kSpace, end);
  }
  return words.empty() ? "not stated" : words;
}

}  // namespace mdof::documents
