// Style of the plots: colours for light and dark screens, and sizes.
#pragma once

#include <span>
#include <string>

namespace mdof::charts {

inline constexpr double kWidthPx = 800;  // width of every plot
inline constexpr double kTitlePx = 17, kTextPx = 12, kTickPx = 11;

// The colour of one kind of SVG element.
struct Colour {
  const char* mark;
  const char* property;  // "fill" or "stroke"
  const char* light;     // "#rrggbb"
  const char* dark;
};
// Readers with any kind of colour blindness can distinguish blue and orange. Two kinds of element
// never differ by colour alone, but also by dashes, width or position. Contrast to the background
// (WCAG 2.1, 1.4.3 and 1.4.11): at least 4.5 for text, at least 3 for a line of data.
std::span<const Colour> colours();

// The style sheet: light colours, and dark colours in a media query. It contains no CSS variables,
// because librsvg, Inkscape and LibreOffice do not support them. These programs show the light
// colours.
std::string style_sheet();
// A style sheet with light colours only, for charts of runs. In a black-and-white print, shapes and
// dashes distinguish the symbols and lines.
std::string printed_style_sheet();

}  // namespace mdof::charts
