// Writes an SVG 1.1 document. The document needs no other files, its texts can be searched, and
// coordinates have a resolution of 0.01 px. Any text makes valid XML. Positions are in px, with y
// downwards.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace mdof::charts {

struct Place {
  double x = 0, y = 0;
};

enum class Anchor { start, middle, end };

// Escapes & < > " ' for XML text and attributes. Characters that XML 1.0 does not allow (control
// characters, U+FFFE, U+FFFF) become U+FFFD. If the text is not UTF-8, every byte that is not ASCII
// becomes U+FFFD.
std::string xml_escaped(std::string_view text);

// A decimal text that programs read as exactly this double; "" for a non-finite number.
std::string exact_text(double x);

// adaptive: light or dark colours, as the screen requests. light: always light colours, as in a
// print.
enum class Theme { adaptive, light };

class Svg {
 public:
  // A browser shows `title` as the name of the plot. `description` describes the plot in words for
  // users who cannot see it.
  Svg(double width, double height, std::string_view title, std::string_view description,
      Theme theme = Theme::adaptive);

  // `mark`: CSS classes from style.h, separated by spaces.
  void rect(std::string_view mark, Place corner, double width, double height);
  void line(std::string_view mark, Place from, Place to);
  void polyline(std::string_view mark, std::span<const Place> places);
  void polygon(std::string_view mark, std::span<const Place> places);
  void dot(std::string_view mark, Place centre, double radius);
  // Writes no element for an empty text.
  void text(std::string_view mark, Place base, Anchor anchor, std::string_view text);
  // Adds the attribute data-NAME to the next element, for programs that read the document. A number
  // is written by exact_text(); a non-finite number adds no attribute.
  Svg& data(std::string_view name, double value);
  Svg& data(std::string_view name, std::string_view value);
  // All elements until end_group() show this tooltip.
  void begin_group(std::string_view tooltip);
  void begin_group();  // without a tooltip
  void end_group();

  // Ends and returns the document; do not call other functions after it.
  std::string take();

 private:
  void points(std::string_view element, std::string_view mark, std::span<const Place> places);
  std::string data_of_next();
  std::string text_, data_;
};

}  // namespace mdof::charts
