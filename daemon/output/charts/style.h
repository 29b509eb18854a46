// Style of the plots: colours for light and dark screens, and sizes.
#pragma once

#include <span>
#include <string>

namespace mdof::charts {

inline constexpr double kWidthPx = 800;  // width of every plot
inline constexpr double kTitlePx = 17, kTextPx = 12, kTickPx = 11;

// The colour of one kind of mark: `mark` is the class of the SVG element.
struct Colour {
  const char* mark;
  const char* property;  // "fill" or "stroke"
  const char* light;     // "#rrggbb"
  const char* dark;
};
// Blue and orange are distinguishable for every kind of colour blindness. Marks also differ by
// dashes, widths or positions, never by colour alone. Against the background, text has a contrast
// of at least 4.5 and a data line of at least 3 (WCAG 2.1, 1.4.3 and 1.4.11).
std::span<const Colour> colours();

// The style sheet. It has plain colours, with dark ones in a media query, and no CSS variables.
// librsvg, Inkscape and LibreOffice do not support CSS variables; they show the light colours.
std::string style_sheet();
// Style sheet with light colours only, and with the marks of runs, whose shapes and dashes stay
// distinguishable in a black-and-white print.
std::string printed_style_sheet();

}  // namespace mdof::charts
