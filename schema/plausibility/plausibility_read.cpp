#include <simdjson.h>

#include <limits>

#include "schema/plausibility/plausibility_json.h"
#include "schema/units.h"

namespace mdof {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;

constexpr std::int64_t kMostCount = std::numeric_limits<int>::max();

// A JSON object. `wrong` is set to the name of the last member that is missing or has a wrong type.
class Row {
 public:
  Row(element object, std::string& wrong) : object_(object), wrong_(wrong) {}

  // A null is read as NaN.
  double number(const char* key) const {
    const element found = take(key, element());
    double x = std::numeric_limits<double>::quiet_NaN();
    if (wrong_.empty() && !found.is_null() && found.get(x)) wrong_ = key;
    return x;
  }
  // A member that older documents do not contain: NaN.
  double newer_number(const char* key) const {
    element found;
    return object_[key].get(found) ? std::numeric_limits<double>::quiet_NaN() : number(key);
  }
  std::int64_t integer(const char* key) const { return take(key, std::int64_t{0}); }
  std::uint64_t natural(const char* key) const { return take(key, std::uint64_t{0}); }
  int count(const char* key) const { return as_count(integer(key), key); }
  std::string text(const char* key) const { return std::string(take(key, std::string_view())); }
  std::vector<int> counts(const char* key) const {
    std::vector<int> found;
    each_item(key, [&](element item) {
      std::int64_t n = -1;
      if (item.get(n)) n = -1;
      found.push_back(as_count(n, key));
    });
    return found;
  }
  template <class Read>
  void each(const char* key, Read read) const {
    each_item(key, [&](element item) {
      if (item.is_object())
        read(Row(item, wrong_));
      else
        wrong_ = key;
    });
  }

 private:
  template <class T>
  T take(const char* key, T fallback) const {
    T found = fallback;
    if (!object_[key].get(found)) return found;
    wrong_ = key;
    return fallback;
  }
  template <class Visit>
  void each_item(const char* key, Visit visit) const {
    array items;
    if (object_[key].get(items))
      wrong_ = key;
    else
      for (const element item : items) visit(item);
  }
  int as_count(std::int64_t n, const char* key) const {
    if (n >= 0 && n <= kMostCount) return static_cast<int>(n);
    wrong_ = key;
    return 0;
  }

  element object_;
  std::string& wrong_;
};

std::vector<TargetVisits> visits_of(const Row& root) {
  std::vector<TargetVisits> n_ij;
  root.each("n_ij", [&](const Row& row) {
    n_ij.push_back(
        {from_mm(row.number("target_mm")), row.counts("forward"), row.counts("reverse")});
  });
  return n_ij;
}

std::vector<StopLeftOut> left_out_of(const Row& root) {
  std::vector<StopLeftOut> left_out;
  root.each("left_out", [&](const Row& row) {
    left_out.push_back(
        {from_mm(row.number("position_mm")), row.integer("begin_ns"), row.text("reason")});
  });
  return left_out;
}

std::vector<ProbeFigures> probes_of(const Row& root) {
  std::vector<ProbeFigures> probes;
  root.each("probes", [&](const Row& row) {
    probes.push_back({row.text("id"), row.natural("points"), from_um(row.number("sd_um")),
                      from_um(row.number("travel_um")), from_um(row.number("min_um")),
                      from_um(row.number("max_um"))});
  });
  return probes;
}

}  // namespace

Result<Plausibility> read_plausibility_json(const std::string& json) {
  simdjson::dom::parser parser;
  element root;
  if (parser.parse(simdjson::padded_string(json)).get(root) || !root.is_object())
    return bad_input("the text is not a JSON object");
  std::string wrong;
  const Row row(root, wrong);
  Plausibility p;
  p.cycle = row.text("cycle");
  p.runs = row.count("runs");
  p.n_ij = visits_of(row);
  p.left_out = left_out_of(row);
  p.short_stops = row.natural("short_stops");
  p.rate_hz = row.number("rate_hz");
  p.encoder_min_m = from_mm(row.number("encoder_min_mm"));
  p.encoder_max_m = from_mm(row.number("encoder_max_mm"));
  p.scans = row.natural("scans");
  p.scans_lost = row.natural("scans_lost");
  p.gaps = row.natural("gaps");
  p.duration_s = row.newer_number("duration_s");
  p.probes = probes_of(row);
  if (!wrong.empty()) return bad_input("the value of \"" + wrong + "\" cannot be read");
  return p;
}

}  // namespace mdof
