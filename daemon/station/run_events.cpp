#include "daemon/station/run_events.h"

#include "algo/uncertainty/run_uncertainty.h"
#include "daemon/words/words.h"
#include "schema/base/json_page.h"
#include "schema/base/number/number_text.h"
#include "schema/notice/notice.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// A run with the first point and then the new points. The first point is needed, because the drift
// of the run is counted from it.
Run first_and_new(std::int64_t run, const Rig& rig, Model model,
                  const std::vector<MeasuredPoint>& points, std::size_t first_row) {
  Run part;
  part.header.id = run;
  part.header.axis = rig.axis;
  part.header.sides = rig.sides;
  part.header.stated = kAtFixture;
  part.header.provenance.model = to_string(model);
  part.points.push_back(points.front());
  part.points.insert(part.points.end(), points.begin() + static_cast<std::ptrdiff_t>(first_row),
                     points.end());
  return part;
}

// Writes the points from index `next`, as many as a line can contain, and increases `next` by their
// number. Index 0 is the first point of the run.
std::string points_json(const Run& part, const RunUncertainty& uncertainty, std::size_t first_row,
                        std::size_t& next) {
  JsonWriter json;
  json.begin_object()
      .field("type", "points")
      .field("run", part.header.id)
      .field("axis", std::string(1, letter(part.header.axis)))
      .field("offset", static_cast<std::uint64_t>(first_row + next - 1))
      .field("reference", to_string(part.header.stated.reference));
  write_covers(json, uncertainty);
  json.key("points").begin_array();
  next += append_page_by_index(json, next, part.points.size(), [&](std::size_t j) {
    JsonWriter item;
    write_point(item, part.header.moving(), part.points[j], uncertainty.points[j]);
    return item.take();
  });
  json.end_array().end_object();
  return json.take();
}

}  // namespace

std::vector<std::string> points_messages(std::int64_t run, const Rig& rig, Model model,
                                         const std::vector<MeasuredPoint>& points,
                                         std::size_t first_row) {
  std::vector<std::string> messages;
  if (first_row >= points.size()) return messages;
  const Run part = first_and_new(run, rig, model, points, first_row);
  const RunUncertainty uncertainty = algo::stop_uncertainty(rig, part);
  for (std::size_t next = 1; next < part.points.size();)
    messages.push_back(points_json(part, uncertainty, first_row, next));
  return messages;
}

std::string left_out_message(std::int64_t run, Axis axis, double position_m) {
  const double mm = to_mm(position_m);
  const Notice left_out = notice(NoticeCode::stop_near_no_target, "",
                                 {{"stops", 1}, {"positions_mm", plain_number(mm, 9)}});
  JsonWriter json;
  json.begin_object()
      .field("type", "left_out")
      .field("run", run)
      .field("axis", std::string(1, letter(axis)))
      .field("position_mm", mm)
      .field("code", to_string(left_out.code))
      .field("text", words::text(left_out))
      .end_object();
  return json.take();
}

}  // namespace mdof::daemon
