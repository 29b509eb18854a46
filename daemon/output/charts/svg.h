// Writes an SVG 1.1 document: no external resource, text as text, coordinates to 0.01 px, valid
// XML whatever the texts contain. Places are in px, y downwards.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace mdof::charts {

struct Place {
  double x = 0, y = 0;
};

enum class Anchor { start, middle, end };

// As it may stand in XML text or an attribute: & < > " ' escaped, and what XML 1.0 does not allow
// (control characters, U+FFFE, U+FFFF), or every byte that is not ASCII where the text is not
// UTF-8, as U+FFFD.
std::string xml_escaped(std::string_view text);

// As it is read back to the same bits; "" for what is not finite.
std::string exact_text(double x);

// Light: dark screens show it in light colours too, as what will be printed.
enum class Theme { adaptive, light };

class Svg {
 public:
  // `title` is what a browser shows as its name, `description` the plot in words for whoever
  // cannot see it.
  Svg(double width, double height, std::string_view title, std::string_view description,
      Theme theme = Theme::adaptive);

  // `mark`: classes of style.h, separated by spaces.
  void rect(std::string_view mark, Place corner, double width, double height);
  void line(std::string_view mark, Place from, Place to);
  void polyline(std::string_view mark, std::span<const Place> places);
  void polygon(std::string_view mark, std::span<const Place> places);
  void dot(std::string_view mark, Place centre, double radius);
  void text(std::string_view mark, Place base, Anchor anchor, std::string_view text);  // "": none
  // The next element carries it as data-NAME, for programs: a number as exact_text(), left out
  // where that is empty.
  Svg& data(std::string_view name, double value);
  Svg& data(std::string_view name, std::string_view value);
  // What follows, up to end_group, has this as its tooltip.
  void begin_group(std::string_view tooltip);
  void begin_group();  // without one
  void end_group();

  // The document with its end; nothing may follow.
  std::string take();

 private:
  void points(std::string_view element, std::string_view mark, std::span<const Place> places);
  std::string data_of_next();
  std::string text_, data_;
};

}  // namespace mdof::charts
