#include "daemon/station/run_events.h"

#include "algo/uncertainty/run_uncertainty.h"
#include "schema/base/json_page.h"
#include "schema/run_json.h"

namespace mdof::daemon {
namespace {

// The points to be announced, behind the run's first one: its drift counts from there.
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

// As many points as a line holds, from the index `next` on, which is moved on. The index 0 is the
// run's first point.
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
  next += append_page_of(json, next, part.points.size(), [&](std::size_t j) {
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
  const RunUncertainty uncertainty = algo::uncertainty_of_stops(rig, part);
  for (std::size_t next = 1; next < part.points.size();)
    messages.push_back(points_json(part, uncertainty, first_row, next));
  return messages;
}

}  // namespace mdof::daemon
