#include "daemon/output/controllers/series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "algo/compensation/thinning.h"
#include "schema/base/number/number_text.h"
#include "schema/imported/series.h"
#include "schema/rig/correction.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

bool any_value(const std::vector<double>& x) {
  return std::any_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); });
}

bool has_value(const Series& s, std::size_t i) {
  return std::isfinite(s.forward[i]) && std::isfinite(s.reverse[i]);
}

std::string place_text(double position_m) {
  return plain_number(to_mm(position_m), 9) + " mm";
}

// The longest range of positions at which both values (forward and reverse) are known: its first
// index, and its last index + 1.
std::pair<std::size_t, std::size_t> longest_range(const Series& s) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  for (std::size_t i = 0, begin = 0; i <= s.position_m.size(); ++i) {
    if (i < s.position_m.size() && has_value(s, i)) continue;
    if (i - begin > best.second - best.first) best = {begin, i};
    begin = i + 1;
  }
  return best;
}

Series part_of(const Series& s, const std::vector<std::size_t>& kept) {
  Series part = s;
  part.position_m.clear();
  part.forward.clear();
  part.reverse.clear();
  for (const std::size_t i : kept) {
    part.position_m.push_back(s.position_m[i]);
    part.forward.push_back(s.forward[i]);
    part.reverse.push_back(s.reverse[i]);
  }
  return part;
}

Series range_of(const Series& s, std::pair<std::size_t, std::size_t> range) {
  std::vector<std::size_t> kept;
  for (std::size_t i = range.first; i < range.second; ++i) kept.push_back(i);
  return part_of(s, kept);
}

// The beginning of an error message: "table 3, EXX".
std::string of_table(const Series& s, std::int64_t table) {
  return "table " + std::to_string(table) + ", " + s.error;
}

// The first position without a value: "table 3, EXX: no reverse value at 0.9 mm". Needs such a
// position.
std::string hole_text(const Series& s, std::int64_t table) {
  std::size_t hole = 0;
  while (has_value(s, hole)) ++hole;
  return of_table(s, table) + ": no " + (std::isfinite(s.forward[hole]) ? "reverse" : "forward") +
         " value at " + place_text(s.position_m[hole]);
}

std::string range_text(const Series& s, std::pair<std::size_t, std::size_t> range) {
  return place_text(s.position_m[range.first]) + " to " +
         place_text(s.position_m[range.second - 1]);
}

Result<Series> without_holes(const Series& s, std::int64_t table, bool cut) {
  const auto range = longest_range(s);
  if (range.second - range.first == s.position_m.size()) return s;
  if (range.second - range.first < 2)
    return bad_input(hole_text(s, table) +
                     ". An export needs at least two neighbouring positions with both values "
                     "(forward and reverse); measure both approaches");
  if (!cut) return bad_input(hole_text(s, table), Remedy::cut_range, range_text(s, range));
  return range_of(s, range);
}

Result<Series> short_enough(const Series& s, std::int64_t table, std::size_t most,
                            const ExportOptions& options, Export& out) {
  const std::vector<std::vector<double>> columns{s.forward, s.reverse};
  auto thin = algo::thinned(s.position_m, columns, options.tolerance_m);
  if (!thin) return in_context(of_table(s, table), std::move(thin.error()));
  if (thin->kept.size() > most) {
    MDOF_TRY(const double enough, algo::tolerance_for(s.position_m, columns, most));
    return bad_input(of_table(s, table) + ": " + std::to_string(thin->kept.size()) +
                         " points, but the controller accepts at most " + std::to_string(most),
                     Remedy::raise_tolerance, plain_number(to_um(enough * 1.01), 3));
  }
  out.written.push_back({s.error, thin->kept.size(), s.position_m.size(), thin->largest_deviation});
  return part_of(s, thin->kept);
}

}  // namespace

std::vector<Series> series_of(const CompensationTable& table) {
  const CorrectionSigns signs =
      correction_signs(table.machine, table.axis, table.sides, table.stated.reference);
  std::vector<Series> all;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const ErrorName& name = error_names(table.axis)[k];
    if (!any_value(table.forward[k]) && !any_value(table.reverse[k])) continue;
    all.push_back({name.name, letter(table.axis), corrected_by(name), name.angle, signs.factor[k],
                   signs.gap[k], table.position_m, table.forward[k], table.reverse[k]});
  }
  const char axis = letter(table.axis);
  if (table.has_positioning())
    all.push_back({positioning_name(table.axis), axis, axis, false, -1, "", table.position_m,
                   table.positioning.forward, table.positioning.reverse});
  return all;
}

const Series* find_series(const std::vector<Series>& series, const std::string& error) {
  for (const Series& s : series)
    if (s.error == error) return &s;
  return nullptr;
}

Result<Series> fitted(const Series& series, std::int64_t table, std::size_t most,
                      const ExportOptions& options, Export& out) {
  if (series.position_m.empty())
    return bad_input(of_table(series, table) + ": the table has no points");
  MDOF_TRY(const Series whole, without_holes(series, table, options.cut_range));
  return short_enough(whole, table, most, options, out);
}

std::vector<std::string> cut_range_texts(const CompensationTable& table) {
  std::vector<std::string> texts;
  for (const Series& s : series_of(table)) {
    const auto range = longest_range(s);
    const std::size_t kept = range.second - range.first;
    if (kept < 2 || kept == s.position_m.size()) continue;
    texts.push_back(
        hole_text(s, table.id) + "; only the range " + range_text(s, range) +
        " is exported; beyond this range, the controller uses the values at the ends of "
        "the range");
  }
  return texts;
}

Status check_no_error_twice(const std::vector<CompensationTable>& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i)
    for (const Series& s : series_of(tables[i]))
      for (std::size_t j = 0; j < i; ++j)
        if (find_series(series_of(tables[j]), s.error))
          return fail(ErrorCode::usage, "tables " + std::to_string(tables[j].id) + " and " +
                                            std::to_string(tables[i].id) + " both contain " +
                                            s.error + "; give one of these tables");
  return {};
}

Status check_one_table_an_axis(const std::vector<CompensationTable>& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (tables[i].axis == tables[j].axis)
        return fail(ErrorCode::usage, "tables " + std::to_string(tables[j].id) + " and " +
                                          std::to_string(tables[i].id) + " are both for axis " +
                                          letter(tables[i].axis) + "; give one table per axis");
  return {};
}

// A warning can contain text of a user. In a file, this text must not begin a new line or contain a
// character that the controller does not support.
std::string plain_ascii_line(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> kPlain[] = {
      {"µ", "u"}, {"±", "+-"}, {"°", " deg"}};
  std::string line;
  for (std::size_t i = 0; i < text.size();) {
    const auto* known = std::find_if(std::begin(kPlain), std::end(kPlain), [&](const auto& p) {
      return text.substr(i).starts_with(p.first);
    });
    const bool plain = text[i] >= 0x20 && text[i] < 0x7f;
    line += known != std::end(kPlain) ? known->second : plain ? text.substr(i, 1) : "?";
    i += known != std::end(kPlain) ? known->first.size() : 1;
  }
  return line;
}

std::string commented(const std::vector<std::string>& lines, const std::string& sign) {
  std::string text;
  for (const std::string& line : lines) text += sign + " " + line + "\n";
  return text;
}

std::vector<std::string> head_lines(const CompensationTable& table, const ExportOptions& options,
                                    const std::string& sense) {
  std::vector<std::string> lines{"mdof compensation table " + std::to_string(table.id) + ", axis " +
                                     letter(table.axis) + ", made " + table.created_utc,
                                 "sha256 of the table " + table.sha256, "sense: " + sense,
                                 "positions are as measured; they must be equal to the machine "
                                 "coordinates after homing"};
  if (!table.has_positioning())
    lines.push_back("valid at the " + reference_point_text(table.stated));
  for (const std::string& mark : options.marks) lines.push_back(plain_ascii_line(mark));
  return lines;
}

std::string reference_point_text(const StatedAt& at) {
  if (at.reference == Reference::carriage)
    return "origin of the carriage, a point that moves with the carriage";
  const auto mm = [&at](std::size_t k) { return plain_number(to_mm(at.point_m[k]), 6); };
  return std::string(to_string(at.reference)) + ": X, Y, Z = " + mm(0) + ", " + mm(1) + ", " +
         mm(2) + " mm from the origin of the measuring fixture";
}

double mean_error_at(const Series& s, double position_m) {
  const auto& x = s.position_m;
  const auto mean = [&](std::size_t k) { return 0.5 * (s.forward[k] + s.reverse[k]); };
  if (!(position_m > x.front())) return mean(0);
  if (!(position_m < x.back())) return mean(x.size() - 1);
  const auto i =
      static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), position_m) - x.begin());
  return mean(i - 1) + (mean(i) - mean(i - 1)) * ((position_m - x[i - 1]) / (x[i] - x[i - 1]));
}

std::string zeroed_at_home_note(const Series& s, const std::string& each, double taken_m,
                                double home_m) {
  return s.error + ": " + plain_number(to_um(taken_m)) + " um was subtracted from every " + each +
         ", so the mean " + each + " of both approaches is 0 at home (" +
         plain_number(to_mm(home_m)) + " mm) and the zero of the axis moves by this amount";
}

std::string fixed(double x, int decimals) {
  std::array<char, 400> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, x);
  std::string out(text.data(), static_cast<std::size_t>(std::max(size, 0)));
  if (out.starts_with("-") && out.find_first_not_of("-0.") == out.npos) out.erase(0, 1);
  return out;
}

}  // namespace mdof::controllers
