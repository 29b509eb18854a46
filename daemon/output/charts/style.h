// How plots look: colours for light and dark, sizes.
#pragma once

#include <span>
#include <string>

namespace mdof::charts {

inline constexpr double kWidthPx = 800;  // of every plot
inline constexpr double kTitlePx = 17, kTextPx = 12, kTickPx = 11;

// One colour of one kind of mark: `mark` is the class of the SVG element.
struct Colour {
  const char* mark;
  const char* property;  // "fill" or "stroke"
  const char* light;     // "#rrggbb"
  const char* dark;
};
// Blue and orange stay apart for every kind of colour blindness, and no two marks differ by colour
// alone: dashes, widths and places distinguish them as well. Against the paper text has a contrast
// of at least 4.5 and a line that carries data one of at least 3 (WCAG 2.1, 1.4.3 and 1.4.11).
std::span<const Colour> colours();

// The style sheet. Plain colours with those for dark in a media query, and no CSS variables, which
// librsvg, Inkscape and LibreOffice do not know. They show the light ones.
std::string style_sheet();
// In light colours alone, with the marks of runs: shapes and dashes that a black-and-white print
// distinguishes.
std::string printed_style_sheet();

}  // namespace mdof::charts
