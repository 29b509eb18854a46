#include "schema/dcc/xml_element.h"

#include <libxml/parser.h>

#include <limits>
#include <memory>

namespace mdof {
namespace {

struct FreeContext {
  void operator()(xmlParserCtxt* context) const { xmlFreeParserCtxt(context); }
};
struct FreeDocument {
  void operator()(xmlDoc* document) const { xmlFreeDoc(document); }
};

std::string string_of(const xmlChar* text) {
  return text ? reinterpret_cast<const char*>(text) : "";  // NOLINT(*-reinterpret-cast): UTF-8
}

std::string name_of(const xmlNode& node) {
  const std::string space = node.ns ? string_of(node.ns->href) : "";
  const std::string name = string_of(node.name);
  if (space == "https://ptb.de/dcc") return "dcc:" + name;
  if (space == "https://ptb.de/si") return "si:" + name;
  return space.empty() ? name : space + ":" + name;
}

XmlElement element_of(xmlNode& node) {
  XmlElement element;
  element.name = name_of(node);
  element.line = xmlGetLineNo(&node);
  for (const xmlAttr* a = node.properties; a != nullptr; a = a->next)
    if (a->children)
      element.attributes.emplace_back(string_of(a->name), string_of(a->children->content));
  for (xmlNode* child = node.children; child != nullptr; child = child->next) {
    if (child->type == XML_ELEMENT_NODE) element.children.push_back(element_of(*child));
    if (child->type == XML_TEXT_NODE || child->type == XML_CDATA_SECTION_NODE)
      element.text += string_of(child->content);
  }
  return element;
}

std::string reason_of(xmlParserCtxt& context) {
  const xmlError* error = xmlCtxtGetLastError(&context);
  if (!error || !error->message) return ": is not XML";
  std::string message = error->message;
  while (!message.empty() && message.back() == '\n') message.pop_back();
  return ":" + std::to_string(error->line) + ": is not well-formed XML: " + message;
}

}  // namespace

const XmlElement* XmlElement::child(std::string_view of) const {
  for (const XmlElement& one : children)
    if (one.name == of) return &one;
  return nullptr;
}

const XmlElement* XmlElement::at(std::string_view path) const {
  const std::size_t end = path.find('/');
  const XmlElement* next = child(path.substr(0, end));
  return !next || end == path.npos ? next : next->at(path.substr(end + 1));
}

std::string_view XmlElement::attribute(std::string_view of) const {
  for (const auto& [name_, value] : attributes)
    if (name_ == of) return value;
  return {};
}

Result<XmlElement> parse_xml(std::string_view text, const std::string& source) {
  if (text.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    return bad_input(source + ": is too large for an XML document");
  const std::unique_ptr<xmlParserCtxt, FreeContext> context(xmlNewParserCtxt());
  const std::unique_ptr<xmlDoc, FreeDocument> document(xmlCtxtReadMemory(
      context.get(), text.data(), static_cast<int>(text.size()), nullptr, nullptr,
      XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_BIG_LINES));
  if (!document) return bad_input(source + reason_of(*context));
  if (document->intSubset || document->extSubset)
    return bad_input(
        source +
        ": has a document type declaration (<!DOCTYPE), but a DCC has no such declaration; remove "
        "the declaration, or ask the laboratory for the original file");
  return element_of(*xmlDocGetRootElement(document.get()));
}

}  // namespace mdof
