#include "daemon/output/charts/form/height_map_chart.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "algo/form/map_figures.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Language;
using output::Phrase;
using output::phrase;

constexpr double kCellsLongestPx = 600, kCellsLeftPx = 60, kScalePx = 16, kScaleTextPx = 64;
constexpr int kShades = 10;  // CSS classes height-0 (lowest) to height-9 in style.cpp

// The cells of the chart. Each cell contains `pixels` × `pixels` pixels; the last cells of a row or
// column may contain fewer.
struct Cells {
  std::size_t pixels = 1;  // along one side of a cell
  std::size_t nx = 0, ny = 0;
  // Lowest and highest height of each cell, ny rows of nx cells; NaN: no height.
  std::vector<double> low_m, high_m;
};

Cells cells_of(const SurfaceMap& map) {
  Cells cells;
  cells.pixels = (std::max(map.nx, map.ny) + kMostCells - 1) / kMostCells;
  cells.nx = (map.nx + cells.pixels - 1) / cells.pixels;
  cells.ny = (map.ny + cells.pixels - 1) / cells.pixels;
  cells.low_m.assign(cells.nx * cells.ny, SurfaceMap::kMissing);
  cells.high_m = cells.low_m;
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      const std::size_t k = j / cells.pixels * cells.nx + i / cells.pixels;
      // fmin and fmax ignore NaN.
      cells.low_m[k] = std::fmin(cells.low_m[k], map.at(i, j));
      cells.high_m[k] = std::fmax(cells.high_m[k], map.at(i, j));
    }
  return cells;
}

struct Shades {
  double low_um = 0, high_um = 0;
  double middle_um() const { return (low_um + high_um) / 2; }
  std::string mark(double z_um) const {
    const double span = high_um - low_um;
    const int shade = span > 0 ? static_cast<int>((z_um - low_um) / span * kShades) : kShades / 2;
    return "height-" + std::to_string(std::clamp(shade, 0, kShades - 1));
  }
};

Panel panel_of(const SurfaceMap& map, double top) {
  Range x, y;
  x.include(to_mm(map.x_m(0) - map.dx_m / 2));
  x.include(to_mm(map.x_m(map.nx - 1) + map.dx_m / 2));
  y.include(to_mm(map.y_m(0) - map.dy_m / 2));
  y.include(to_mm(map.y_m(map.ny - 1) + map.dy_m / 2));
  return panel_in_proportion({kMarginPx + kCellsLeftPx, top}, x, y, kCellsLongestPx);
}

void draw_cells(Svg& svg, const Panel& panel, const SurfaceMap& map, const Cells& cells,
                const Shades& shades) {
  for (std::size_t j = 0; j < cells.ny; ++j)
    for (std::size_t i = 0; i < cells.nx; ++i) {
      const double low = to_um(cells.low_m[j * cells.nx + i]),
                   high = to_um(cells.high_m[j * cells.nx + i]);
      if (std::isnan(low)) continue;
      const std::size_t column = i * cells.pixels, row = j * cells.pixels,
                        last_column = std::min(column + cells.pixels, map.nx) - 1,
                        last_row = std::min(row + cells.pixels, map.ny) - 1;
      const Place corner =
          panel.at(to_mm(map.x_m(column) - map.dx_m / 2), to_mm(map.y_m(last_row) + map.dy_m / 2));
      const Place opposite =
          panel.at(to_mm(map.x_m(last_column) + map.dx_m / 2), to_mm(map.y_m(row) - map.dy_m / 2));
      const double middle = shades.middle_um();
      svg.data("x-mm", to_mm(map.x_m(column) + map.x_m(last_column)) / 2)
          .data("y-mm", to_mm(map.y_m(row) + map.y_m(last_row)) / 2)
          .data("low-um", low)
          .data("high-um", high);
      svg.rect(shades.mark(middle - low > high - middle ? low : high), corner,
               opposite.x - corner.x, opposite.y - corner.y);
    }
}

// Draws the colour scale with its heights; the lowest height is at the bottom.
void draw_scale(Svg& svg, const Panel& panel, const Shades& shades) {
  const double x = panel.corner.x + panel.width + 20,
               step = std::min(panel.height, 200.0) / kShades;
  const int decimals = std::clamp(1 - decimal_exponent(shades.high_um - shades.low_um), 0, 6);
  for (int k = 0; k < kShades; ++k)
    svg.rect("height-" + std::to_string(k), {x, panel.corner.y + (kShades - 1 - k) * step},
             kScalePx, step);
  for (int k = 0; k <= kShades; k += kShades / 2) {
    const double z = shades.low_um + (shades.high_um - shades.low_um) * k / kShades;
    svg.text("tick", {x + kScalePx + 5, panel.corner.y + (kShades - k) * step + 4}, Anchor::start,
             fixed_text(z, decimals));
  }
  svg.text("tick", {x, panel.corner.y - 8}, Anchor::start, "z / µm");
}

}  // namespace

std::string height_map_svg(const SurfaceMap& map, const std::string& title, Language language) {
  const Cells cells = cells_of(map);
  const auto figures = algo::figures_of(map);
  Range z;
  for (const double h : map.z_m) z.include(to_um(h));
  const Shades shades{z.low, z.high};
  const std::string about =
      phrase(Phrase::height_map_figures, language,
             {number_text(to_um(figures.pv_m)), number_text(to_um(figures.rms_m)),
              count_text(figures.pixels), count_text(map.nx * map.ny)});
  const std::vector<std::string> notes = {
      phrase(Phrase::height_map_cells, language, {count_text(cells.pixels * cells.pixels)})};
  const double top = run_head_height({}) + 34;
  const Panel panel = panel_of(map, top);
  const double bottom = top + std::max(panel.height, 60.0) + 50;
  Svg svg(std::max(kWidthPx, panel.corner.x + panel.width + kScalePx + kScaleTextPx + kMarginPx),
          bottom + notes_height(notes) + 12, title, about, Theme::light);
  draw_run_head(svg, title, about, {}, language);
  svg.data("panel", "height-map").data("pv-um", to_um(figures.pv_m));
  svg.data("rms-um", to_um(figures.rms_m));
  svg.begin_group();
  draw_axes(svg, panel, "x_mm");
  draw_y_title(svg, panel, "y_mm");
  draw_cells(svg, panel, map, cells, shades);
  draw_scale(svg, panel, shades);
  svg.end_group();
  draw_notes(svg, bottom, notes);
  return svg.take();
}

}  // namespace mdof::charts
