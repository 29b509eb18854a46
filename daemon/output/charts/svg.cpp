#include "daemon/output/charts/svg.h"

#include <simdjson.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "daemon/output/charts/style.h"

namespace mdof::charts {
namespace {

constexpr const char* kReplacement = "\xef\xbf\xbd";

std::string_view escape_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\t':
    case '\n':
    case '\r':
      return " ";
    default:
      return static_cast<unsigned char>(c) < 0x20 ? kReplacement : std::string_view();
  }
}

// The shortest text of a coordinate, rounded to 0.01 px. Non-finite and very large values are
// errors of the caller; they are replaced so that the SVG stays valid.
std::string px(double x) {
  if (!std::isfinite(x)) x = 0;
  char buffer[32];
  const double near = std::clamp(x, -1e5, 1e5);
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, near, std::chars_format::fixed, 2);
  std::string text(buffer, end.ptr);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string attribute(std::string_view name, std::string_view value) {
  return ' ' + std::string(name) + "=\"" + std::string(value) + '"';
}

std::string attribute(std::string_view name, double value) {
  return attribute(name, px(value));
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  const bool utf8 = simdjson::validate_utf8(text.data(), text.size());
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view escape = escape_of(text[i]);
    const std::string_view three = text.substr(i, 3);
    if (!escape.empty()) {
      out += escape;
    } else if (!utf8 && static_cast<unsigned char>(text[i]) >= 0x80) {
      out += kReplacement;
    } else if (three == "\xef\xbf\xbe" || three == "\xef\xbf\xbf") {
      out += kReplacement;
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string exact_text(double x) {
  if (!std::isfinite(x)) return "";
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x + 0.0).ptr};
}

Svg::Svg(double width, double height, std::string_view title, std::string_view description,
         Theme theme) {
  text_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"";
  text_ += attribute("class", "mdof") + attribute("role", "img") + attribute("width", width) +
           attribute("height", height) +
           attribute("viewBox", "0 0 " + px(width) + ' ' + px(height)) + ">\n";
  text_ += "<title>" + xml_escaped(title) + "</title>\n";
  text_ += "<desc>" + xml_escaped(description) + "</desc>\n";
  text_ +=
      "<style>" + (theme == Theme::light ? printed_style_sheet() : style_sheet()) + "</style>\n";
  rect("paper", {0, 0}, width, height);
}

void Svg::rect(std::string_view mark, Place corner, double width, double height) {
  text_ += "<rect" + attribute("class", mark) + attribute("x", corner.x) +
           attribute("y", corner.y) + attribute("width", std::max(width, 0.0)) +
           attribute("height", std::max(height, 0.0)) + data_of_next() + "/>\n";
}

void Svg::line(std::string_view mark, Place from, Place to) {
  text_ += "<line" + attribute("class", mark) + attribute("x1", from.x) + attribute("y1", from.y) +
           attribute("x2", to.x) + attribute("y2", to.y) + data_of_next() + "/>\n";
}

void Svg::points(std::string_view element, std::string_view mark, std::span<const Place> places) {
  std::string list;
  for (const Place& p : places) list += (list.empty() ? "" : " ") + px(p.x) + ',' + px(p.y);
  text_ += '<' + std::string(element) + attribute("class", mark) + attribute("points", list) +
           data_of_next() + "/>\n";
}

void Svg::polyline(std::string_view mark, std::span<const Place> places) {
  points("polyline", mark, places);
}

void Svg::polygon(std::string_view mark, std::span<const Place> places) {
  points("polygon", mark, places);
}

void Svg::dot(std::string_view mark, Place centre, double radius) {
  text_ += "<circle" + attribute("class", mark) + attribute("cx", centre.x) +
           attribute("cy", centre.y) + attribute("r", radius) + data_of_next() + "/>\n";
}

void Svg::text(std::string_view mark, Place base, Anchor anchor, std::string_view text) {
  if (text.empty()) return;
  text_ += "<text" + attribute("class", mark) + attribute("x", base.x) + attribute("y", base.y);
  if (anchor == Anchor::middle) text_ += attribute("text-anchor", "middle");
  if (anchor == Anchor::end) text_ += attribute("text-anchor", "end");
  text_ += data_of_next() + '>' + xml_escaped(text) + "</text>\n";
}

Svg& Svg::data(std::string_view name, double value) {
  const std::string number = exact_text(value);
  return number.empty() ? *this : data(name, number);
}

Svg& Svg::data(std::string_view name, std::string_view value) {
  data_ += attribute("data-" + std::string(name), xml_escaped(value));
  return *this;
}

std::string Svg::data_of_next() {
  return std::exchange(data_, "");
}

void Svg::begin_group(std::string_view tooltip) {
  text_ += "<g" + data_of_next() + "><title>" + xml_escaped(tooltip) + "</title>\n";
}

void Svg::begin_group() {
  text_ += "<g" + data_of_next() + ">\n";
}

void Svg::end_group() {
  text_ += "</g>\n";
}

std::string Svg::take() {
  text_ += "</svg>\n";
  return std::move(text_);
}

}  // namespace mdof::charts
