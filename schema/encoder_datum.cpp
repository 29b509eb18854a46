#include "schema/encoder_datum.h"

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof {
namespace {

using Kind = EncoderDatum::Kind;

constexpr int kDigits = 9;  // number of significant digits: 1 nm for a position of up to 1 m

constexpr Kind kKinds[] = {Kind::absolute, Kind::none, Kind::configured, Kind::set, Kind::index};

std::string mm_text(double position_m) {
  return plain_number(to_mm(position_m), kDigits) + " mm";
}

}  // namespace

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::absolute:
      return "absolute";
    case Kind::none:
      return "none";
    case Kind::configured:
      return "configured";
    case Kind::set:
      return "set";
    case Kind::index:
      return "index";
  }
  return "";
}

bool datum_kind_from(const std::string& name, Kind& kind) {
  for (const Kind each : kKinds) {
    if (name != to_string(each)) continue;
    kind = each;
    return true;
  }
  return false;
}

Notices datum_notices(const EncoderDatum& datum) {
  if (datum.kind != Kind::none) return {};
  return {notice(NoticeCode::datum_missing, datum.device)};
}

std::string datum_text(const EncoderDatum& datum) {
  switch (datum.kind) {
    case Kind::configured:
      return "offset_mm of the configuration, " + mm_text(datum.offset_m);
    case Kind::set:
      return "set on " + datum.utc + " by " + datum.by + ", offset " + mm_text(datum.offset_m);
    case Kind::index:
      return "reference mark at " + mm_text(datum.offset_m) + ", passed on " + datum.utc;
    default:
      return "";
  }
}

std::string setting_text(const DatumSetting& setting) {
  return std::string(1, letter(setting.axis)) + " set to " + mm_text(setting.position_m) +
         "; the position before was " + mm_text(setting.before_m);
}

}  // namespace mdof
