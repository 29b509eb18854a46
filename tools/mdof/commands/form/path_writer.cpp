#include "tools/mdof/commands/form/path_writer.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;

}  // namespace

PathForm path_form(const std::string& file) {
  std::string lower;
  for (const char c : file) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* end : {".ngc", ".nc", ".gcode", ".tap"})
    if (lower.ends_with(end)) return PathForm::gcode;
  return PathForm::table;
}

// Converts x through an integer, which is fast. A path may have a hundred million numbers.
void PathWriter::word(const char* before, double x, int decimals) {
  text_ += before;
  static constexpr std::array<double, 10> kTens = {
      {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9}};
  const double scaled = std::nearbyint(std::abs(x) * kTens[static_cast<std::size_t>(decimals)]);
  if (!(scaled < 9e18)) {  // too large for a path
    text_ += plain_number(x, 17);
    return;
  }
  std::array<char, 32> digit;
  const auto end =
      std::to_chars(digit.data(), digit.data() + digit.size(), static_cast<std::uint64_t>(scaled));
  const auto size = static_cast<std::size_t>(end.ptr - digit.data());
  const auto behind = static_cast<std::size_t>(decimals);
  if (x < 0 && scaled > 0) text_ += '-';
  if (size > behind) {
    text_.append(digit.data(), size - behind);
  } else {
    text_ += '0';
  }
  text_ += '.';
  if (size < behind) text_.append(behind - size, '0');
  text_.append(digit.data() + (size > behind ? size - behind : 0), std::min(size, behind));
}

Status PathWriter::begin() {
  MDOF_TRY(number_, out_.add(file_));
  text_.reserve(kPiece + 256);
  if (form_ == PathForm::table) {
    text_ = "t_s,rho_mm,theta_deg,z_um,on_part\n";
  } else {
    text_ =
        "(mdof form path: X is the radius in mm, Z points towards +z)\n"
        "(C is the angle on the part from +X towards +Y: seen from +z, the part turns clockwise)\n"
        "(before you start this program, move the tool to the Z of the first move)\n"
        "G21 G90\n";
  }
  return {};
}

Status PathWriter::add(const algo::PathPoint& point) {
  if (form_ == PathForm::table) {
    word("", rates_.t_s(point.index));
    word(",", to_mm(point.rho_m));
    word(",", rates_.theta_deg(point.index));
    word(",", to_um(point.z_m));
    text_ += ',';
    text_ += static_cast<char>('0' + static_cast<int>(point.on_part));
    text_ += '\n';
  } else {
    const double x_mm = to_mm(point.rho_m), c_deg = rates_.theta_deg(point.index);
    if (is_first_) {
      word("G0 X", x_mm);
      word(" C", c_deg);
      text_ += "\nG93\n";
    }
    word("G1 X", x_mm);
    word(" C", c_deg);
    word(" Z", to_mm(point.z_m));
    word(" F", rates_.speed_rpm * static_cast<double>(rates_.points_per_turn), 3);
    text_ += '\n';
    is_first_ = false;
  }
  return text_.size() < kPiece ? Status() : flush();
}

Status PathWriter::flush() {
  MDOF_CHECK(out_.write(number_, text_));
  text_.clear();
  return {};
}

Status PathWriter::finish() {
  if (form_ == PathForm::gcode) text_ += "G94\nM2\n";
  MDOF_CHECK(flush());
  return out_.publish();
}

}  // namespace mdof::tools
