#include "tools/mdof/commands/compensation/home_positions.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include "schema/units.h"

namespace mdof::tools {
namespace {

constexpr std::string_view kHomeAxes = "XYZ";

bool read_number(std::string_view text, double& mm) {
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, mm);
  return read.ec == std::errc() && read.ptr == end && std::isfinite(mm);
}

// Joins the names as "X and Y" or "X, Y and Z".
std::string listed(std::string_view axes) {
  std::string text;
  for (std::size_t k = 0; k < axes.size(); ++k)
    text += (k == 0 ? "" : k + 1 == axes.size() ? " and " : ", ") + std::string(1, axes[k]);
  return text;
}

}  // namespace

Result<Homes> home_positions(const std::string& text) {
  Homes homes;
  double mm = 0;
  if (read_number(text, mm)) return Homes{{0, from_mm(mm)}};
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const bool names_axis =
        word.size() > 2 && kHomeAxes.find(word[0]) != std::string_view::npos && word[1] == '=';
    if (!names_axis || !read_number(std::string_view(word).substr(2), mm))
      return fail(ErrorCode::usage, "--home-mm \"" + word +
                                        "\" must be an axis and its home position in mm, such as "
                                        "X=10,Y=-20, or one number if there is one table");
    for (const auto& home : homes)
      if (home.axis == word[0])
        return fail(ErrorCode::usage, "--home-mm names axis " + std::string(1, word[0]) +
                                          " twice; give each axis once");
    homes.push_back({word[0], from_mm(mm)});
  }
  return homes;
}

Status assign_home_axes(std::string_view axes, Homes& homes) {
  for (auto& home : homes) {
    if (home.axis == 0 && axes.size() == 1) home.axis = axes.front();
    if (home.axis == 0)
      return fail(ErrorCode::usage,
                  "--home-mm: one number is not enough for the axes " + listed(axes) +
                      "; give the home position of each axis, such as X=10,Y=-20");
    if (axes.find(home.axis) == std::string_view::npos)
      return fail(ErrorCode::usage, "--home-mm gives a position of axis " +
                                        std::string(1, home.axis) +
                                        ", but the exported tables are tables of " + listed(axes) +
                                        "; leave out axis " + std::string(1, home.axis));
  }
  return {};
}

}  // namespace mdof::tools
