#include "schema/volumetric/volumetric_table.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "schema/base/canonical.h"
#include "schema/base/number/number_text.h"
#include "schema/base/sha256.h"
#include "schema/notice/notice_json.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof {

Vec3 VolumetricTable::command_at(std::size_t node) const {
  const std::size_t nx = command_m[0].size(), ny = command_m[1].size();
  return {command_m[0][node % nx], command_m[1][node / nx % ny], command_m[2][node / (nx * ny)]};
}

Vec3 remaining_u(const Vec3& u_m, const Vec3& part_m) {
  Vec3 rest{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double square = u_m[k] * u_m[k] - part_m[k] * part_m[k];
    rest[k] = square < 0 ? 0 : std::sqrt(square);  // negative only because of rounding
  }
  return rest;
}

Vec3 VolumetricTable::u_independent_at(std::size_t node) const {
  return u_independent_m.empty() ? Vec3{kNaN, kNaN, kNaN} : u_independent_m[node];
}

Vec3 VolumetricTable::u_common_at(std::size_t node) const {
  return remaining_u(u_m[node], u_independent_at(node));
}

bool VolumetricTable::has_u_between() const {
  return std::any_of(u_between_m.begin(), u_between_m.end(),
                     [](const auto& axis) { return !axis.empty(); });
}

namespace {

// Calls `take` for each number in `noise`, in the order of noise_numbers().
template <class Noise, class Take>
void for_each_number(Noise& noise, Take take) {
  for (auto& axis : noise)
    for (auto& node : axis)
      for (auto* forms : {&node.variance, &node.covariance_with_next})
        for (auto& form : *forms)
          for (auto& number : form) take(number);
}

}  // namespace

std::vector<double> noise_numbers(const VolumetricTable& table) {
  std::vector<double> numbers;
  for_each_number(table.noise, [&](double x) { numbers.push_back(x); });
  return numbers;
}

bool set_noise(VolumetricTable& table, const std::vector<double>& numbers) {
  table.noise = {};
  if (numbers.empty()) return true;
  std::size_t count = 0, next = 0;
  for (std::size_t k = 0; k < table.noise.size(); ++k)
    if (table.command_m[k].size() > 1) table.noise[k].resize(table.command_m[k].size());
  for_each_number(table.noise, [&](double) { ++count; });
  if (count != numbers.size()) return false;
  for_each_number(table.noise, [&](double& x) { x = numbers[next++]; });
  return true;
}

std::vector<double> u_between_numbers(const VolumetricTable& table) {
  std::vector<double> numbers;
  for (const auto& axis : table.u_between_m)
    for (const Vec3& cell : axis) numbers.insert(numbers.end(), cell.begin(), cell.end());
  return numbers;
}

bool set_u_between(VolumetricTable& table, const std::vector<double>& numbers) {
  table.u_between_m = {};
  if (numbers.empty()) return true;
  std::size_t count = 0, next = 0;
  for (const auto& commands : table.command_m) count += 3 * (commands.size() - 1);
  if (count != numbers.size()) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    table.u_between_m[k].resize(table.command_m[k].size() - 1);
    for (Vec3& cell : table.u_between_m[k])
      for (double& number : cell) number = numbers[next++];
  }
  return true;
}

std::string volumetric_sha256(const VolumetricTable& t) {
  using canonical::put;
  std::string bytes;
  const auto put_text = [&](std::string_view text) { put(bytes, text); };
  const auto put_vector = [&](const Vec3& v) { put(bytes, std::span<const double>(v)); };
  const std::vector<double> noise = noise_numbers(t);
  const bool reversal = t.reversal_m != Vec3{};
  put_text(std::string(!noise.empty()              ? "mdof volumetric table 3"
                       : t.u_independent_m.empty() ? "mdof volumetric table 1"
                                                   : "mdof volumetric table 2") +
           (reversal ? ", reversal" : "") + (t.doubtful.empty() ? "" : ", doubtful") +
           (t.has_u_between() ? ", between" : ""));
  put_text(t.name);
  put_text(t.machine.text);
  put_text(chain_travels_text(t.machine));
  put_text(t.description);
  put(bytes, std::uint64_t{t.runs.size()});
  for (const std::int64_t run : t.runs) put(bytes, run);
  put(bytes, t.simulated ? 1 : 0);
  put(bytes, static_cast<int>(t.noise_only));
  put_text(t.approach);
  put_vector(t.tool_m);
  put_vector(t.rotary_rad);
  for (const auto& commands : t.command_m) canonical::put_counted(bytes, commands);
  for (const auto* nodes : {&t.correction_m, &t.u_m, &t.u_independent_m})
    for (const Vec3& v : *nodes) put_vector(v);
  put(bytes, std::span<const double>(noise));
  put_vector(t.interpolation_m);
  put(bytes, t.place_left_m);
  put(bytes, t.turn_left_rad);
  for (const auto* names : {&t.not_measured, &t.u_not_declared, &t.beyond_tables}) {
    put(bytes, std::uint64_t{names->size()});
    for (const std::string& name : *names) put_text(name);
  }
  if (reversal) put_vector(t.reversal_m);
  if (!t.doubtful.empty()) put_text(notices_json(t.doubtful));
  put(bytes, std::span<const double>(u_between_numbers(t)));
  return sha256_hex(bytes);
}

std::string rotary_text(const VolumetricTable& table) {
  constexpr std::string_view kRotary = "ABC";
  std::string text;
  for (std::size_t k = 0; k < 3; ++k)
    if (table.machine.find(kRotary[k]))
      text += (text.empty() ? "" : ", ") + std::string(1, kRotary[k]) + " = " +
              plain_number(to_deg(table.rotary_rad[k]), 9) + " deg";
  return text;
}

std::string covers_text(const VolumetricTable& table) {
  std::string text = error_covers_text(table.noise_only, !table.u_not_declared.empty());
  if (!table.u_independent_m.empty())
    text +=
        "; u_independent is the part of u that comes from noise and differs between the positions "
        "of an axis; u_common is the rest of u";
  text += "; between the nodes, u also contains the interpolation error";
  return text + (table.has_u_between()
                     ? " and the uncertainty of the errors between their measured positions"
                     : ", but not the uncertainty of the errors between their measured positions, "
                       "because an older version of mdof built this table; build the table again");
}

}  // namespace mdof
