// An XML document as a tree. libxml2 reads it without network access and without a DTD.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

struct XmlElement {
  // For example "dcc:item", "si:real". The prefix depends on the namespace and not on the prefixes
  // of the document.
  std::string name;
  std::string text;  // text of this element without the text of its children
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  long line = 0;

  // Returns the first child with this name, or nullptr.
  const XmlElement* child(std::string_view of) const;
  // Returns the first descendant along a path such as "dcc:contact/dcc:name", or nullptr.
  const XmlElement* at(std::string_view path) const;
  std::string_view attribute(std::string_view of) const;  // empty if the attribute does not exist
};

// Errors: text that is not well-formed (the error states the line); a DTD; elements that are nested
// deeper than libxml2 allows (256).
Result<XmlElement> parse_xml(std::string_view text, const std::string& source);

}  // namespace mdof
