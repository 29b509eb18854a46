// An XML document as a tree, read by libxml2 without network and without a DTD.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

struct XmlElement {
  // "dcc:item", "si:real": the prefix is from the namespace, independent of the document's
  // prefixes.
  std::string name;
  std::string text;  // its own text, without that of its children
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  long line = 0;

  // The first child with this name, or nullptr.
  const XmlElement* child(std::string_view of) const;
  // The same along a path: "dcc:contact/dcc:name".
  const XmlElement* at(std::string_view path) const;
  std::string_view attribute(std::string_view of) const;  // absent: empty
};

// Errors: not well-formed (with the line), with a DTD, elements nested deeper than libxml2 allows
// (256).
Result<XmlElement> parse_xml(std::string_view text, const std::string& source);

}  // namespace mdof
