// Checks whether a text is well-formed XML. Supports only the XML that SVG plots need.
#pragma once

#include <simdjson.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mdof {

// Checks a text between tags or the value of an attribute. Returns the error, or "" if there is no
// error.
inline std::string text_fault(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 && text[i] != '\n') return "control character";
    if (text[i] == '<') return "raw <";
    if (text[i] != '&') continue;
    const std::string_view entity = text.substr(i, text.find(';', i) - i + 1);
    static const std::set<std::string_view> kKnown = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    if (!kKnown.contains(entity)) return "entity " + std::string(entity.substr(0, 10));
  }
  return "";
}

// Checks the pairs ` name="value"` of one tag; each name may occur only once. Returns the error or
// "".
inline std::string attributes_fault(std::string_view text) {
  std::set<std::string_view> names;
  while (!text.empty()) {
    const std::size_t equals = text.find("=\""), end = text.find('"', equals + 2);
    if (text[0] != ' ' || equals == text.npos || end == text.npos) return "attribute malformed";
    if (!names.insert(text.substr(1, equals - 1)).second) return "attribute twice";
    if (text.substr(1, equals - 1).find_first_of(" \"'<>&") != text.npos) return "attribute name";
    if (auto fault = text_fault(text.substr(equals + 2, end - equals - 2)); !fault.empty())
      return "attribute: " + fault;
    text.remove_prefix(end + 1);
  }
  return "";
}

// Checks one tag and updates the list of open tags. Returns the error or "".
inline std::string tag_fault(std::string_view tag, std::vector<std::string>& open) {
  if (tag.starts_with('/')) {
    if (open.empty() || open.back() != tag.substr(1)) return "ends " + std::string(tag);
    open.pop_back();
    return "";
  }
  const bool empty = tag.ends_with('/');
  if (empty) tag.remove_suffix(1);
  const std::string_view name = tag.substr(0, tag.find(' '));
  if (name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyz") != name.npos)
    return "tag name " + std::string(name);
  if (!empty) open.emplace_back(name);
  return attributes_fault(tag.substr(name.size()));
}

// Checks a whole document, which must contain exactly one <svg>. Returns the error or "".
inline std::string xml_fault(std::string_view text) {
  constexpr std::string_view kDeclaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  if (!simdjson::validate_utf8(text.data(), text.size())) return "not UTF-8";
  if (!text.starts_with(kDeclaration)) return "no declaration";
  if (text.find("\xef\xbf\xbe") != text.npos || text.find("\xef\xbf\xbf") != text.npos)
    return "a character that is none";
  text.remove_prefix(kDeclaration.size());
  if (!text.starts_with("<svg ")) return "no svg";
  std::vector<std::string> open;
  while (text.starts_with('<')) {
    const std::size_t end = text.find('>');
    if (end == text.npos) return "a tag without end";
    if (auto fault = tag_fault(text.substr(1, end - 1), open); !fault.empty()) return fault;
    text.remove_prefix(end + 1);
    if (open.empty()) return text == "\n" ? "" : "something after the end";
    const std::string_view words = text.substr(0, text.find('<'));
    if (auto fault = text_fault(words); !fault.empty()) return fault;
    text.remove_prefix(words.size());
  }
  return "without end";
}

}  // namespace mdof
