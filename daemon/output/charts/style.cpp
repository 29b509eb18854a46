#include "daemon/output/charts/style.h"

#include <array>

namespace mdof::charts {
namespace {

constexpr std::array<Colour, 17> kColours = {{
    {"paper", "fill", "#ffffff", "#0d1117"},
    {"text", "fill", "#1f2328", "#e6edf3"},
    {"quiet", "fill", "#59636e", "#9aa4af"},
    {"grid", "stroke", "#e1e5ea", "#252c35"},
    {"rule", "stroke", "#6e7781", "#7d8590"},
    {"ink", "stroke", "#1f2328", "#e6edf3"},
    {"ink-dot", "fill", "#1f2328", "#e6edf3"},
    {"blue", "stroke", "#0066a8", "#56b4e9"},
    {"blue-dot", "fill", "#0066a8", "#56b4e9"},
    {"orange", "stroke", "#b84a00", "#f0a030"},
    {"orange-dot", "fill", "#b84a00", "#f0a030"},
    {"edge", "stroke", "#6e7781", "#7d8590"},
    {"wide", "fill", "#d9e9f5", "#12324a"},
    {"wide", "stroke", "#0066a8", "#56b4e9"},
    {"narrow", "fill", "#a3cbe8", "#1f5d8a"},
    {"narrow", "stroke", "#0066a8", "#56b4e9"},
    {"halo", "stroke", "#ffffff", "#0d1117"},
}};

// The rules that do not depend on the theme. The classes "dash" and "dot" are line styles. An
// element of Svg::dot() has only a colour class, such as "ink-dot".
constexpr const char* kShapes =
    ".mdof text{font-family:system-ui,'DejaVu Sans',Arial,sans-serif;font-size:12px}"
    ".mdof .title{font-size:17px;font-weight:600}"
    ".mdof .head{font-weight:600}"
    ".mdof .tick{font-size:11px}"
    ".mdof line,.mdof polyline{fill:none}"
    ".mdof .grid,.mdof .rule{stroke-width:1}"
    ".mdof .ink,.mdof .blue,.mdof .orange{stroke-width:1.6}"
    ".mdof .edge{stroke-width:1.2}"
    ".mdof .wide,.mdof .narrow{stroke-width:.8}"
    ".mdof .halo{stroke-width:4;paint-order:stroke}"
    ".mdof .dash{stroke-dasharray:6 3}"
    ".mdof .dot{stroke-dasharray:1.5 3}";

constexpr const char* kMarksOfRuns =
    ".mdof .hollow{fill:#ffffff}"
    ".mdof rect.orange,.mdof polygon.ink{stroke-width:1.2}"
    ".mdof .thin{stroke-width:1}"
    ".mdof .cross{stroke:#1f2328;stroke-width:1.4}"
    ".mdof .forward-band{fill:#0066a8;fill-opacity:.16;stroke:#0066a8;stroke-width:.6}"
    ".mdof .reverse-band{fill:#b84a00;fill-opacity:.16;stroke:#b84a00;stroke-width:.6;"
    "stroke-dasharray:4 2}"
    ".mdof .grey-band{fill:#6e7781;fill-opacity:.16;stroke:#6e7781;stroke-width:.6}"
    ".mdof .alarm{fill:#b3261e;font-weight:600}";

// The colours of heights, from dark (low) to light (high), so that a print without colours also
// shows the heights.
constexpr const char* kHeights =
    ".mdof .height-0{fill:#440154}.mdof .height-1{fill:#482878}.mdof .height-2{fill:#3e49"
    "89}.mdof .height-3{fill:#31688e}.mdof .height-4{fill:#26828e}.mdof .height-5{fill:#1"
    "f9e89}.mdof .height-6{fill:#35b779}.mdof .height-7{fill:#6ece58}.mdof .height-8{fill"
    ":#b5de2b}.mdof .height-9{fill:#fde725}";

void append_rules(std::string& css, const char* Colour::*shade) {
  for (const Colour& c : kColours)
    css += std::string(".mdof .") + c.mark + "{" + c.property + ":" + c.*shade + "}";
}

}  // namespace

std::span<const Colour> colours() {
  return kColours;
}

std::string style_sheet() {
  std::string css = kShapes;
  append_rules(css, &Colour::light);
  css += "@media (prefers-color-scheme:dark){";
  append_rules(css, &Colour::dark);
  return css + "}";
}

std::string printed_style_sheet() {
  std::string css = kShapes;
  append_rules(css, &Colour::light);
  return css + kMarksOfRuns + kHeights;
}

}  // namespace mdof::charts
