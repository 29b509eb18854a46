#include "schema/imported/imported_json.h"

#include "schema/recording/run_options.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof {

void write_imported_point(JsonWriter& json, const MeasuredPoint& point, const std::string& key) {
  json.begin_object().field("target", point.target).field("run", point.run).key("direction");
  point.point.direction == 0 ? json.null() : json.value(point.point.direction);
  json.field("position_mm", to_mm(point.point.position_m));
  json.field(key, to_key_unit(deviation(point)));
  json.key("u").begin_object().field(key, to_key_unit(deviation_uncertainty(point))).end_object();
  json.end_object();
}

void write_imported_members(JsonWriter& json, const RunHeader& header, NoticeWords words) {
  write_header_members(json, header, words);
  json.field("imported", true).field("error", header.provenance.model);
  json.field("sense", "actual minus nominal, as in the file");
  if (header.provenance.model != positioning_name(header.axis)) return;
  json.field("positioning_sense", to_string(run_options(header).imported.sense));
}

}  // namespace mdof
