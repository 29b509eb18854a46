// ISO 25178-71: a header with lines "key = value", then "*", the heights profile by profile, "*",
// and a trailer.
#include <cctype>
#include <cmath>
#include <map>

#include "schema/base/number/number.h"
#include "schema/base/number/number_text.h"
#include "schema/base/trimmed.h"
#include "schema/form/map_grid.h"
#include "schema/form/surface_files.h"

namespace mdof {
namespace {

class SdfReader {
 public:
  SdfReader(std::string_view text, const std::string& source) : rest_(text), source_(source) {}

  Result<SurfaceMap> read() {
    MDOF_CHECK(read_header());
    SurfaceMap map;
    map.name = source_;
    MDOF_TRY(map.nx, count("NumPoints"));
    MDOF_TRY(map.ny, count("NumProfiles"));
    if (map.nx > kMostPixels / map.ny)
      return bad_input(source_ + ": has more than " + std::to_string(kMostPixels) + " pixels");
    MDOF_TRY(map.dx_m, scale("Xscale"));
    if (map.ny == 1) {
      map.dy_m = map.dx_m;  // a single profile has no distance along y
    } else {
      MDOF_TRY(map.dy_m, scale("Yscale"));
    }
    MDOF_TRY(const double z_scale, scale("Zscale"));
    if (const auto found = keys_.find("compression");
        found != keys_.end() && found->second.text != "0")
      return bad_input(place(found->second.line) + "Compression = " + found->second.text +
                       "; export the map without compression");
    MDOF_CHECK(read_heights(map, z_scale));
    if (map.measured() == 0) return bad_input(source_ + ": no pixel has a height (all are BAD)");
    return map;
  }

 private:
  struct Value {
    std::string text;
    std::size_t line = 0;
  };

  std::string place(std::size_t line) const { return source_ + ":" + std::to_string(line) + ": "; }

  bool next_line(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    return true;
  }

  Status read_header() {
    std::string_view line;
    next_line(line);  // the first line is the name of the format
    while (next_line(line)) {
      if (line.starts_with('*')) return {};
      line = trimmed(line.substr(0, line.find(';')));  // text after ; is a comment
      if (line.empty()) continue;
      const std::size_t equals = line.find('=');
      if (equals == std::string_view::npos)
        return bad_input(place(line_) +
                         "the line must be \"key = value\", or \"*\" to end the header");
      std::string key;
      for (const char c : trimmed(line.substr(0, equals)))
        key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      keys_[key] = {std::string(trimmed(line.substr(equals + 1))), line_};
    }
    return bad_input(source_ + ": ends within the header; the header must end with the line \"*\"");
  }

  Result<Value> value(const std::string& name) const {
    std::string key;
    for (const char c : name) key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto found = keys_.find(key);
    if (found == keys_.end()) return bad_input(source_ + ": the header has no " + name);
    return found->second;
  }

  Result<double> number(const std::string& name, std::size_t& line) const {
    MDOF_TRY(const Value found, value(name));
    line = found.line;
    double x = 0;
    const char* const end = found.text.data() + found.text.size();
    const char* const begin = found.text.data() + (found.text.starts_with('+') ? 1 : 0);
    if (parse_double(begin, end, x) != end || !std::isfinite(x))
      return bad_input(place(found.line) + name + " is \"" + found.text +
                       "\", not a finite number");
    return x;
  }

  Result<std::size_t> count(const std::string& name) const {
    std::size_t line = 0;
    MDOF_TRY(const double x, number(name, line));
    if (x < 1 || x > static_cast<double>(kMostPixels) || x != std::floor(x))
      return bad_input(place(line) + name + " must be a whole number from 1 to " +
                       std::to_string(kMostPixels));
    return static_cast<std::size_t>(x);
  }

  Result<double> scale(const std::string& name) const {
    std::size_t line = 0;
    MDOF_TRY(const double x, number(name, line));
    if (!(x > 0)) return bad_input(place(line) + name + " must be above 0 (unit: metre)");
    if (name != "Zscale" && x > kLargestPixel_m)
      return bad_input(place(line) + name + " = " + plain_number(x) +
                       " m is too large for a pixel (limit " + plain_number(kLargestPixel_m) +
                       " m); state the distance of the points in metres");
    return x;
  }

  Status read_heights(SurfaceMap& map, double z_scale) {
    const std::size_t wanted = map.nx * map.ny;
    map.z_m.reserve(wanted);
    std::string_view line;
    while (next_line(line) && !line.starts_with('*'))
      while (!line.empty()) {
        const std::size_t end = line.find_first_of(" \t,");
        const std::string_view word = line.substr(0, end);
        line = end == std::string_view::npos ? "" : trimmed(line.substr(end + 1));
        if (word.empty()) continue;
        double z = SurfaceMap::kMissing;
        const char* const last = word.data() + word.size();
        const char* const first = word.data() + (word.starts_with('+') ? 1 : 0);
        if (word != "BAD" && (parse_double(first, last, z) != last || !std::isfinite(z)))
          return bad_input(place(line_) + "\"" + std::string(word.substr(0, 40)) +
                           "\" is neither a height nor BAD");
        if (map.z_m.size() == wanted)
          return bad_input(
              place(line_) +
              "the file has more heights than its header states (NumPoints times NumProfiles = " +
              std::to_string(wanted) + ")");
        if (std::abs(z * z_scale) > kFarthest_m)
          return bad_input(place(line_) + std::string(word.substr(0, 40)) +
                           " times Zscale is above 1000 m; check the height and Zscale (unit: "
                           "metre)");
        map.z_m.push_back(z * z_scale);
      }
    if (map.z_m.size() == wanted) return {};
    return bad_input(
        source_ + ": has " + std::to_string(map.z_m.size()) +
        " heights, but its header states NumPoints times NumProfiles = " + std::to_string(wanted));
  }

  std::string_view rest_;
  const std::string& source_;
  std::size_t line_ = 0;
  std::map<std::string, Value> keys_;
};

}  // namespace

bool is_sdf(std::string_view bytes) {
  return bytes.size() >= 8 && (bytes[0] == 'a' || bytes[0] == 'b') &&
         (bytes.substr(1, 4) == "ISO-" || bytes.substr(1, 4) == "BCR-");
}

Result<SurfaceMap> parse_sdf(std::string_view text, const std::string& source) {
  const std::string_view magic = trimmed(text.substr(0, text.find('\n')));
  if (magic == "aISO-1.0" || magic == "aISO-2.0" || magic == "aBCR-1.0")
    return SdfReader(text, source).read();
  return bad_input(source + ": has the .sdf format \"" + std::string(magic.substr(0, 8)) +
                   "\"; export the map as text (aISO-1.0, aISO-2.0 or aBCR-1.0)");
}

}  // namespace mdof
