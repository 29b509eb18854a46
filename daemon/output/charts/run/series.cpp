#include "daemon/output/charts/run/series.h"

#include <algorithm>
#include <array>
#include <map>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/style.h"

namespace mdof::charts {
namespace {

using output::Phrase;
using output::phrase;

constexpr double kMarkPx = 3.6;  // half the width of a symbol
constexpr double kDiscPx = 2.3;  // radius of a disc; it is smaller than kMarkPx so that it is
                                 // visible inside a square at the same place
constexpr double kNoteLinePx = 17;
constexpr double kMarksLinePx = 18;  // line height of a warning below the title
constexpr std::size_t kMostHeadMarks = 3, kLongestMark = 118;
constexpr std::array kDirections = {0, -1, 1};  // order of drawing: discs (1) last

const char* name_of(int direction) {
  return direction > 0 ? "forward" : direction < 0 ? "reverse" : "unknown";
}

const char* band_of(int direction) {
  return direction > 0 ? "forward-band" : direction < 0 ? "reverse-band" : "grey-band";
}

void draw_shape(Svg& svg, Place c, int direction) {
  if (direction > 0) {
    svg.dot("blue-dot", c, kDiscPx);
  } else if (direction < 0) {
    svg.rect("orange hollow", {c.x - kMarkPx, c.y - kMarkPx}, 2 * kMarkPx, 2 * kMarkPx);
  } else {
    const double r = kMarkPx + 1;
    const std::array<Place, 4> corners = {
        {{c.x, c.y - r}, {c.x + r, c.y}, {c.x, c.y + r}, {c.x - r, c.y}}};
    svg.polygon("ink hollow", corners);
  }
}

void draw_cross(Svg& svg, Place c) {
  const double r = kMarkPx + 1.4;
  svg.line("cross", {c.x - r, c.y - r}, {c.x + r, c.y + r});
  svg.line("cross", {c.x - r, c.y + r}, {c.x + r, c.y - r});
}

std::vector<Mark> with_direction(std::span<const Mark> marks, int direction) {
  std::vector<Mark> found;
  for (const Mark& mark : marks)
    if (mark.direction == direction && std::isfinite(mark.y)) found.push_back(mark);
  return found;
}

long column_of(const Panel& panel, const Mark& mark) {
  return static_cast<long>(panel.x.fraction(mark.x) * panel.width);
}

struct Column {
  double x = 0, low = 0, high = 0;
  std::size_t n = 0;
  void include(double from, double to, double at) {
    low = n == 0 ? from : std::min(low, from);
    high = n == 0 ? to : std::max(high, to);
    x += at;
    ++n;
  }
};

void draw_columns(Svg& svg, const Panel& panel, const std::vector<Mark>& marks, int direction) {
  std::map<long, Column> columns;
  for (const Mark& mark : marks) columns[column_of(panel, mark)].include(mark.y, mark.y, mark.x);
  for (const auto& [at, column] : columns) {
    const double x = column.x / static_cast<double>(column.n);
    const Place high = panel.at(x, column.high), low = panel.at(x, column.low);
    svg.data("x", x).data("low", column.low).data("high", column.high);
    svg.data("n", static_cast<double>(column.n)).data("approach", name_of(direction));
    svg.line(direction > 0   ? "blue"
             : direction < 0 ? "orange"
                             : "ink",
             high, {low.x, std::max(low.y, high.y + 1)});
  }
}

// Divides a text into lines at blanks. A word that is longer than a line is cut.
std::vector<std::string> lines_within(const std::string& text, double room_px) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    std::string word = text.substr(at, end - at);
    at = end + 1;
    for (std::size_t n = word.size(); n > 1 && text_width(word, kTextPx) > room_px; --n)
      word = shortened(word, n);
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && text_width(longer, kTextPx) > room_px) {
      lines.push_back(line);
      line = word;
    } else {
      line = longer;
    }
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

void draw_band_of(Svg& svg, const Panel& panel, const std::vector<Mark>& marks, int direction) {
  const bool columns = marks.size() > kMostMarks;
  std::map<long, Column> places;
  for (const Mark& mark : marks)
    if (std::isfinite(mark.U))
      places[columns ? column_of(panel, mark) : mark.target].include(mark.y - mark.U,
                                                                     mark.y + mark.U, mark.x);
  std::vector<Column> band;
  for (auto& [key, place] : places) {
    place.x /= static_cast<double>(place.n);
    band.push_back(place);
  }
  std::stable_sort(band.begin(), band.end(),
                   [](const Column& a, const Column& b) { return a.x < b.x; });
  if (band.empty()) return;
  std::vector<Place> outline;
  const double half_band_width_px =
      band.size() == 1 ? 2 * kMarkPx : 0;  // a band of one target gets a width
  for (const Column& c : band) {
    const Place at = panel.at(c.x, c.high);
    if (half_band_width_px > 0) outline.push_back({at.x - half_band_width_px, at.y});
    outline.push_back({at.x + half_band_width_px, at.y});
  }
  for (auto c = band.rbegin(); c != band.rend(); ++c) {
    const Place at = panel.at(c->x, c->low);
    outline.push_back({at.x + half_band_width_px, at.y});
    if (half_band_width_px > 0) outline.push_back({at.x - half_band_width_px, at.y});
  }
  svg.data("band", name_of(direction));
  svg.polygon(band_of(direction), outline);
}

}  // namespace

Range range_of_marks(std::span<const Mark> marks) {
  Range range;
  for (const Mark& mark : marks) {
    if (!std::isfinite(mark.y)) continue;
    range.include(mark.y);
    if (!std::isfinite(mark.U)) continue;
    range.include(mark.y - mark.U);
    range.include(mark.y + mark.U);
  }
  return range;
}

Range with_room(const Range& range) {
  return padded(range, 0.05);
}

void draw_mark(Svg& svg, const Panel& panel, const Mark& mark) {
  const bool known = std::isfinite(mark.y);
  const Place at = known ? panel.at(mark.x, mark.y) : Place{panel.px_x(mark.x), panel.corner.y + 6};
  svg.data("x", mark.x).data("y", mark.y).data(mark.is_standard ? "u" : "U", mark.U);
  svg.data("row", static_cast<double>(mark.row)).data("approach", name_of(mark.direction));
  if (!mark.flags.empty()) svg.data("flags", mark.flags);
  if (!known) svg.data("reason", mark.reason);
  svg.begin_group();
  if (known) draw_shape(svg, at, mark.direction);
  if (!known || !mark.flags.empty()) draw_cross(svg, at);
  svg.end_group();
}

bool are_drawn_as_columns(std::span<const Mark> marks) {
  for (const int direction : kDirections)
    if (with_direction(marks, direction).size() > kMostMarks) return true;
  return false;
}

void draw_marks(Svg& svg, const Panel& panel, std::span<const Mark> marks) {
  for (const int direction : kDirections) {
    const std::vector<Mark> these = with_direction(marks, direction);
    if (these.size() > kMostMarks) {
      draw_columns(svg, panel, these, direction);
      continue;
    }
    for (const Mark& mark : these) draw_mark(svg, panel, mark);
  }
  std::size_t unknown = 0;
  for (const Mark& mark : marks)
    if (!std::isfinite(mark.y) && ++unknown <= kMostMarks) draw_mark(svg, panel, mark);
}

void draw_U_bands(Svg& svg, const Panel& panel, std::span<const Mark> marks) {
  for (const int direction : kDirections)
    draw_band_of(svg, panel, with_direction(marks, direction), direction);
}

double draw_notes(Svg& svg, double top, const std::vector<std::string>& notes) {
  double y = top;
  for (const std::string& note : notes)
    for (const std::string& line : lines_within(note, kWidthPx - 2 * kMarginPx)) {
      svg.text("quiet", {kMarginPx, y + 12}, Anchor::start, line);
      y += kNoteLinePx;
    }
  return y;
}

double notes_height(const std::vector<std::string>& notes) {
  double height = 0;
  for (const std::string& note : notes)
    height +=
        kNoteLinePx * static_cast<double>(lines_within(note, kWidthPx - 2 * kMarginPx).size());
  return height;
}

const char* line_of(int direction) {
  return direction > 0 ? "blue thin" : direction < 0 ? "orange dash thin" : "ink thin";
}

double run_head_height(const std::vector<std::string>& marks) {
  return kHeadPx + kMarksLinePx * static_cast<double>(std::min(marks.size(), kMostHeadMarks));
}

double draw_run_head(Svg& svg, const std::string& title, const std::string& subtitle,
                     const std::vector<std::string>& marks, Language language) {
  draw_head(svg, title, subtitle);
  for (std::size_t i = 0; i < std::min(marks.size(), kMostHeadMarks); ++i) {
    const std::size_t left_out = marks.size() - kMostHeadMarks;
    const bool last = i + 1 == kMostHeadMarks && marks.size() > kMostHeadMarks;
    const std::string text = shortened(marks[i], last ? kLongestMark - 14 : kLongestMark);
    svg.data("mark", marks[i]);
    svg.text("alarm", {kMarginPx, 50 + kMarksLinePx * static_cast<double>(i + 1)}, Anchor::start,
             last ? phrase(Phrase::more_marks, language, {text, std::to_string(left_out)}) : text);
  }
  return run_head_height(marks);
}

double draw_marks_legend(Svg& svg, double top, const Legend& legend,
                         std::span<const LegendItem> lines, Language language) {
  constexpr double kSignPx = 26, kGapPx = 22, kRowPx = 20;
  struct Item {
    enum { shape, cross, area, line } sign;
    int direction;
    const char* mark;
    std::string text;
  };
  std::vector<Item> items;
  const auto add = [&](bool wanted, auto sign, int direction, Phrase text) {
    if (wanted) items.push_back({sign, direction, "", phrase(text, language)});
  };
  add(legend.forward, Item::shape, 1, Phrase::forward);
  add(legend.reverse, Item::shape, -1, Phrase::reverse);
  add(legend.unknown, Item::shape, 0, Phrase::no_approach);
  for (const LegendItem& line : lines) items.push_back({Item::line, 0, line.mark, line.text});
  if (legend.band)
    items.push_back({Item::area, 0,
                     legend.forward   ? "forward-band"
                     : legend.reverse ? "reverse-band"
                                      : "grey-band",
                     phrase(legend.band_is_u ? Phrase::band_u : Phrase::band_U, language)});
  add(legend.flagged, Item::cross, 1, Phrase::flagged);
  add(legend.unsolved, Item::cross, 2, Phrase::unsolved);
  Place place{kMarginPx, top + 14};
  for (const Item& item : items) {
    const double width = kSignPx + text_width(item.text, kTextPx);
    if (place.x > kMarginPx && place.x + width > kWidthPx - kMarginPx)
      place = {kMarginPx, place.y + kRowPx};
    const Place sign{place.x + 10, place.y - 4};
    if (item.sign == Item::shape || (item.sign == Item::cross && item.direction == 1))
      draw_shape(svg, sign, item.direction);
    if (item.sign == Item::cross) draw_cross(svg, sign);
    if (item.sign == Item::area) svg.rect(item.mark, {place.x, sign.y - 5}, 20, 10);
    if (item.sign == Item::line) svg.line(item.mark, {place.x, sign.y}, {place.x + 20, sign.y});
    svg.text("text", {place.x + kSignPx, place.y}, Anchor::start, item.text);
    place.x += width + kGapPx;
  }
  return place.y + 6;
}

}  // namespace mdof::charts
